// SPDX-License-Identifier: BSD-3-Clause
#include "session/camera_doubt.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <sstream>

namespace mivo {
namespace {

constexpr double kDegrees = 180.0 / M_PI;
constexpr double kFieldOfView[] = {10.0, 170.0};  // degrees, of lenses that there are
constexpr double kMaxEquidistantField = 360.0;    // degrees
constexpr double kScales[] = {0.25, 1.0 / 3.0, 0.5, 2.0, 3.0, 4.0};
// Of the image's size: how near the principal points of real cameras are to the middle, at least
// those that are taken for another resolution's.
constexpr double kNearMiddle = 0.04;

/// Degrees, over `pixels` of a focal length.
double fieldOfView(const Camera& camera, int pixels, double focal) {
  if (camera.distortion.model == LensModel::kEquidistant) return pixels / focal * kDegrees;
  return 2.0 * std::atan(0.5 * pixels / focal) * kDegrees;
}

/// Whether the principal point is where that of an image of `scale` times the size would be.
bool isCentredFor(const Camera& camera, double scale) {
  const auto isNear = [&](double centre, int size) {
    return std::abs(centre / size - 0.5 * scale) < kNearMiddle * scale;
  };
  return isNear(camera.cx, camera.width) && isNear(camera.cy, camera.height);
}

std::string size(double width, double height) {
  std::ostringstream text;
  text << std::lround(width) << " x " << std::lround(height);
  return text.str();
}

}  // namespace

std::string findCameraDoubt(const Camera& camera) {
  const bool is_equidistant = camera.distortion.model == LensModel::kEquidistant;
  const double most = is_equidistant ? kMaxEquidistantField : kFieldOfView[1];
  std::ostringstream text;
  const auto scale = std::find_if(std::begin(kScales), std::end(kScales),
                                  [&](double s) { return isCentredFor(camera, s); });
  const double horizontal = fieldOfView(camera, camera.width, camera.fx);
  const double vertical = fieldOfView(camera, camera.height, camera.fy);
  if (scale != std::end(kScales)) {
    text << "the calibration (fx " << camera.fx << ", cx " << camera.cx << ", cy " << camera.cy
         << ") is one for " << size(*scale * camera.width, *scale * camera.height)
         << " pixels, but the images have " << size(camera.width, camera.height)
         << ": calibrate at this size, or scale fx, fy, cx and cy";
  } else if (std::min(horizontal, vertical) < kFieldOfView[0] ||
             std::max(horizontal, vertical) > most) {
    text << "the focal lengths fx " << camera.fx << " and fy " << camera.fy
         << " mean a field of view of " << std::lround(horizontal) << " x " << std::lround(vertical)
         << " degrees for " << size(camera.width, camera.height)
         << " pixels, which no lens has: check the calibration";
  } else if (!(camera.cx >= 0.0 && camera.cx <= camera.width - 1.0 && camera.cy >= 0.0 &&
               camera.cy <= camera.height - 1.0)) {
    text << "the principal point cx " << camera.cx << ", cy " << camera.cy
         << " is outside of the image of " << size(camera.width, camera.height)
         << " pixels: check the calibration";
  }
  return text.str();
}

}  // namespace mivo
