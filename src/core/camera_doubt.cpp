// SPDX-License-Identifier: BSD-3-Clause
#include "core/camera_doubt.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace mivo {
namespace {

constexpr double kDegreesPerRadian = 180.0 / M_PI;
// degrees; no RGB-D camera sees less, or more: the longer side of the image, as a pinhole's.
constexpr double kLeastAngle = 10.0;
constexpr double kLargestAngle = 170.0;
// distance > this share of the image's side: a principal point this far from the center is that of
// a cropped image, or of one of another size. Half the size puts it at a quarter.
constexpr double kFarFromCenter = 0.2;
// |ratio of the two - 1| < this: principal points of the same relative place in x and y.
constexpr double kSameScale = 0.1;
// Focal lengths of one lens differ by a few percent at most.
constexpr double kLargestAspect = 1.5;
// pixels; with shorter focal lengths a pixel spans 2 cm and more at 2 m, and poses drift by 1 to 5
// cm within a second (doc/inputs.md, small images).
constexpr double kCoarse = 90.0;
constexpr double kRounding = 1e-3;  // pixels

/// How many times larger the images are whose center is the principal point.
double scaleOf(double principal_point, int size) {
  return (2.0 * principal_point + 1.0) / size;
}

/// A half, a third, twice, ..., where the scale is that but for the half pixel between conventions.
double plainScale(double scale) {
  constexpr double kNearlyPlain = 0.02;
  constexpr double kLargest = 8.0;
  for (double whole = 1.0; whole <= kLargest; ++whole) {
    for (const double plain : {whole, 1.0 / whole}) {
      if (std::abs(scale / plain - 1.0) < kNearlyPlain) return plain;
    }
  }
  return scale;
}

/// "is it for images of 320 x 240 pixels?" when the principal point would be their center.
std::string otherSize(const Camera& c) {
  const double x = scaleOf(c.cx, c.width);
  const double y = scaleOf(c.cy, c.height);
  if (!(x > 0.0) || !(y > 0.0) || std::abs(x / y - 1.0) > kSameScale) return {};
  std::ostringstream text;
  text << ": is the calibration for images of " << std::lround(plainScale(x) * c.width) << " x "
       << std::lround(plainScale(y) * c.height) << " pixels?";
  return text.str();
}

double angleOf(const Camera& c, double focal_length) {
  return 2.0 * kDegreesPerRadian * std::atan(0.5 * std::max(c.width, c.height) / focal_length);
}

}  // namespace

std::string findCameraFault(const Camera& c) {
  std::ostringstream text;
  for (const double focal_length : {c.fx, c.fy}) {
    const double angle = angleOf(c, focal_length);
    if (angle >= kLeastAngle && angle <= kLargestAngle) continue;
    text << "with a focal length of " << focal_length << " pixels images of " << c.width << " x "
         << c.height << " span " << angle << " degrees; " << kLeastAngle << " to " << kLargestAngle
         << " are possible";
    return text.str();
  }
  const bool is_inside =
      c.cx >= -0.5 && c.cx <= c.width - 0.5 && c.cy >= -0.5 && c.cy <= c.height - 0.5;
  if (is_inside) return {};
  text << "the principal point (" << c.cx << ", " << c.cy << ") lies outside of images of "
       << c.width << " x " << c.height << " pixels" << otherSize(c);
  return text.str();
}

std::string doubtOf(const Camera& c) {
  std::ostringstream text;
  if (std::abs(c.cx - 0.5 * (c.width - 1)) > kFarFromCenter * c.width ||
      std::abs(c.cy - 0.5 * (c.height - 1)) > kFarFromCenter * c.height) {
    text << "the principal point (" << c.cx << ", " << c.cy << ") is far from the center of images "
         << "of " << c.width << " x " << c.height << " pixels" << otherSize(c);
    return text.str();
  }
  if (std::max(c.fx / c.fy, c.fy / c.fx) > kLargestAspect) {
    text << "the focal lengths " << c.fx << " and " << c.fy << " differ by more than a lens' do";
  }
  return text.str();
}

std::string describeCoarseness(const Camera& c) {
  constexpr double kDistance = 2.0;  // m
  constexpr double kMillimeters = 1000.0;
  const double focal_length = std::max(c.fx, c.fy);
  if (!(focal_length < kCoarse)) return {};
  std::ostringstream text;
  text << "images of " << c.width << " x " << c.height << " pixels are small: a pixel spans "
       << std::lround(kMillimeters * kDistance / focal_length)
       << " mm at 2 m, and the pose drifts by centimeters within a second: record larger ones";
  return text.str();
}

bool isSameButForRounding(const Camera& a, const Camera& b) {
  if (a == b) return true;
  if (a.width != b.width || a.height != b.height) return false;
  constexpr int kSteps = 4;
  for (int i = 0; i <= kSteps; ++i) {
    for (int j = 0; j <= kSteps; ++j) {
      const Eigen::Vector2d pixel(i * (a.width - 1.0) / kSteps, j * (a.height - 1.0) / kSteps);
      const auto ray_a = a.ray(pixel);
      const auto ray_b = b.ray(pixel);
      if (!ray_a || !ray_b) continue;  // at the end of the lens' range
      if (!((*ray_a - *ray_b).norm() * std::max(a.fx, a.fy) < kRounding)) return false;
    }
  }
  return true;
}

}  // namespace mivo
