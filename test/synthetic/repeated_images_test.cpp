// SPDX-License-Identifier: BSD-3-Clause
// A recording in which a tenth of the color images repeat the one before while the depth goes on,
// as some have it, is tracked nearly as precisely as its twin in which they are right.
#include <gtest/gtest.h>

#include "session/repeated_image.h"
#include "synthetic/twin_error.h"

namespace mivo {
namespace {

using testing::relativeErrorIn;

TEST(RepeatedImages, CostTheirFramesAndLittlePrecision) {
  const Camera camera = xtionCamera(320, 240);
  RepeatedImage repeated;
  cv::Mat before;
  int left_out = 0;
  const double error = relativeErrorIn(camera, [&](int i, Frame& frame) {
    if (i % 10 == 5) frame.image = before;
    before = frame.image.clone();
    const bool is_repeated = repeated.check(frame);
    EXPECT_EQ(is_repeated, i % 10 == 5) << i;
    left_out += is_repeated ? 1 : 0;
    return !is_repeated;
  });
  EXPECT_EQ(left_out, 8);  // of two paths of 40 frames
  EXPECT_LT(error, 1.2 * relativeErrorIn(camera));
}

}  // namespace
}  // namespace mivo
