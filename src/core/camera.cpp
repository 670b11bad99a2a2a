// SPDX-License-Identifier: BSD-3-Clause
#include "mivo/core/camera.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>

#include "mivo/core/error.h"

namespace mivo {
namespace {

// Beyond three times the focal length no lens is described by the polynomial.
constexpr double kMaxRadius = 3.0;
constexpr double kRadiusStep = 1e-3;
// How far outside of the corners the polynomial is still trusted.
constexpr double kCornerMargin = 1.1;
constexpr int kInversionSteps = 20;

}  // namespace

bool Distortion::isZero() const {
  return k1 == 0.0 && k2 == 0.0 && p1 == 0.0 && p2 == 0.0 && k3 == 0.0;
}

void Camera::validate() const {
  const double numbers[] = {
      fx, fy, cx, cy, distortion.k1, distortion.k2, distortion.p1, distortion.p2, distortion.k3};
  const bool finite = std::all_of(std::begin(numbers), std::end(numbers),
                                  [](double number) { return std::isfinite(number); });
  if (width <= 0 || height <= 0 || !finite || fx <= 0.0 || fy <= 0.0) {
    std::ostringstream text;
    text << "camera: " << width << " x " << height << " pixels, fx " << fx << ", fy " << fy
         << ", cx " << cx << ", cy " << cy
         << ": sizes and focal lengths must be positive and all numbers finite";
    throw Error(text.str());
  }
}

Camera Camera::atLevel(int level) const {
  Camera camera = *this;
  for (int l = 0; l < level; ++l) {
    camera.width = (camera.width + 1) / 2;
    camera.height = (camera.height + 1) / 2;
    camera.fx *= 0.5;
    camera.fy *= 0.5;
    camera.cx *= 0.5;
    camera.cy *= 0.5;
  }
  return camera;
}

Eigen::Vector2d Camera::distort(const Eigen::Vector2d& undistorted,
                                Eigen::Matrix2d* derivative) const {
  const Distortion& d = distortion;
  const double x = undistorted.x();
  const double y = undistorted.y();
  const double r2 = x * x + y * y;
  const double radial = 1.0 + r2 * (d.k1 + r2 * (d.k2 + r2 * d.k3));
  if (derivative != nullptr) {
    const double slope = 2.0 * (d.k1 + r2 * (2.0 * d.k2 + r2 * 3.0 * d.k3));  // d radial / d r2 * 2
    const double mixed = slope * x * y + 2.0 * (d.p1 * x + d.p2 * y);
    *derivative << radial + slope * x * x + 2.0 * d.p1 * y + 6.0 * d.p2 * x, mixed, mixed,
        radial + slope * y * y + 6.0 * d.p1 * y + 2.0 * d.p2 * x;
  }
  return {x * radial + 2.0 * d.p1 * x * y + d.p2 * (r2 + 2.0 * x * x),
          y * radial + d.p1 * (r2 + 2.0 * y * y) + 2.0 * d.p2 * x * y};
}

double Camera::maxSquaredRadius() const {
  const double corner = kCornerMargin * Eigen::Vector2d(std::max(cx, width - 1.0 - cx) / fx,
                                                        std::max(cy, height - 1.0 - cy) / fy)
                                            .norm();
  double last = 0.0;
  for (double r = kRadiusStep; r < kMaxRadius; r += kRadiusStep) {
    const double r2 = r * r;
    const double distorted =
        r * (1.0 + r2 * (distortion.k1 + r2 * (distortion.k2 + r2 * distortion.k3)));
    if (distorted <= last || distorted > corner) return r2;
    last = distorted;
  }
  return kMaxRadius * kMaxRadius;
}

std::optional<Eigen::Vector2d> Camera::project(const Eigen::Vector3d& point) const {
  if (!(point.z() > 0.0)) return std::nullopt;
  Eigen::Vector2d normalised = point.head<2>() / point.z();
  if (!distortion.isZero()) {
    if (normalised.squaredNorm() > maxSquaredRadius()) return std::nullopt;
    normalised = distort(normalised);
  }
  return Eigen::Vector2d(fx * normalised.x() + cx, fy * normalised.y() + cy);
}

Eigen::Vector3d Camera::ray(const Eigen::Vector2d& pixel) const {
  const Eigen::Vector2d distorted((pixel.x() - cx) / fx, (pixel.y() - cy) / fy);
  Eigen::Vector2d undistorted = distorted;
  if (!distortion.isZero()) {
    Eigen::Matrix2d derivative;
    for (int i = 0; i < kInversionSteps; ++i) {
      const Eigen::Vector2d error = distort(undistorted, &derivative) - distorted;
      const Eigen::Vector2d step = derivative.inverse() * error;
      undistorted -= step;
      if (step.squaredNorm() < 1e-28) break;
    }
  }
  return {undistorted.x(), undistorted.y(), 1.0};
}

bool operator==(const Camera& a, const Camera& b) {
  const Distortion& da = a.distortion;
  const Distortion& db = b.distortion;
  return a.width == b.width && a.height == b.height && a.fx == b.fx && a.fy == b.fy &&
         a.cx == b.cx && a.cy == b.cy && da.k1 == db.k1 && da.k2 == db.k2 && da.p1 == db.p1 &&
         da.p2 == db.p2 && da.k3 == db.k3;
}

}  // namespace mivo
