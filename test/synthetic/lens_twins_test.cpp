// SPDX-License-Identifier: BSD-3-Clause
// A sequence filmed through a lens is tracked as precisely as its twin without one: the same scene,
// path and noise, and for a wide lens the same field of view.
#include <gtest/gtest.h>

#include <cmath>

#include "synthetic/twin_error.h"

namespace mivo {
namespace {

using testing::relativeErrorIn;

/// @param degrees  horizontal field of view
Camera wideCamera(const Distortion& lens, double degrees) {
  Camera camera = xtionCamera(320, 240);
  camera.distortion = lens;
  const double edge = std::tan(0.5 * degrees * M_PI / 180.0);
  camera.fx = camera.fy = 0.5 * camera.width / camera.distort({edge, 0.0}).x();
  return camera;
}

TEST(LensTwins, EightCoefficientsAreAsPreciseAsAPinhole) {
  const Camera pinhole = xtionCamera(320, 240);
  Camera rational = pinhole;
  rational.distortion = {0.62, -2.74, 0.0005, -0.0002, 1.54, 0.49, -2.55, 1.46};  // Azure Kinect
  EXPECT_LT(relativeErrorIn(rational), 1.1 * relativeErrorIn(pinhole));
}

TEST(LensTwins, AFisheyeOf120DegreesIsAsPreciseAsAPinhole) {
  const Distortion fisheye = {
      0.03, -0.01, 0.0, 0.0, 0.002, -0.0005, 0.0, 0.0, LensModel::kEquidistant};
  EXPECT_LT(relativeErrorIn(wideCamera(fisheye, 120.0)),
            1.1 * relativeErrorIn(wideCamera({}, 120.0)));
}

}  // namespace
}  // namespace mivo
