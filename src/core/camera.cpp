// SPDX-License-Identifier: BSD-3-Clause
#include "mivo/core/camera.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <string>

#include "core/camera_doubt.h"
#include "mivo/core/error.h"

namespace mivo {
namespace {

// radius <= this: rays further out than 72 degrees; no lens that wide is described by the
// polynomial. Ends the scan of lensRange().
constexpr double kMaxRadius = 3.0;
// The same for equidistant lenses: 80 degrees. Near 90 a point's projection runs away.
constexpr double kMaxEquidistantRadius = 5.67;
// Of that scan. Between two of its radii the polynomial of a usable lens changes by a percent.
constexpr double kRadiusStep = 1.0 / 64.0;
// How far outside of the corners the polynomial is still trusted: points that the motion between
// two steps of the minimizer takes there and back.
constexpr double kCornerMargin = 1.1;
// stretch > this: the least factor by which the lens may shrink lengths. It is 0 where the
// polynomial folds; from 0.2 on Newton's method in floats finds every ray to a thousandth of a
// pixel (tested with random lenses).
constexpr double kMinStretch = 0.2;
// The kernels take six steps (point_formulas-inl.h): four must do without tangential distortion.
constexpr int kQuickSteps = 4;
// |radius found - radius| < this, normalized: two more steps leave nothing of it.
constexpr double kQuickTolerance = 1e-4;
// A lens that folds within this share of the way to the corners is no lens but an error.
constexpr double kInnerHalf = 0.5;
// Of a ray in doubles, from pixels where four nearly suffice, and the length of the last one.
constexpr int kInversionSteps = 20;
constexpr double kLastStep = 1e-14;

/// A lens without its tangential part: what lengths across the radius are multiplied by, and along.
struct Radial {
  double scale;
  double slope;
};

/// At the squared normalized radius r2.
Radial polynomialAt(const Distortion& d, double r2) {
  const double over = 1.0 + r2 * (d.k1 + r2 * (d.k2 + r2 * d.k3));
  if (!d.isRational()) {
    return {over, 1.0 + r2 * (3.0 * d.k1 + r2 * (5.0 * d.k2 + r2 * 7.0 * d.k3))};
  }
  const double under = 1.0 + r2 * (d.k4 + r2 * (d.k5 + r2 * d.k6));
  const double over_slope = d.k1 + r2 * (2.0 * d.k2 + r2 * 3.0 * d.k3);  // d over / d r2
  const double under_slope = d.k4 + r2 * (2.0 * d.k5 + r2 * 3.0 * d.k6);
  const double scale = over / under;
  return {scale, scale + 2.0 * r2 * (over_slope - scale * under_slope) / under};
}

/// Of an equidistant lens, at the angle a (rad): distorted radius over a, and its derivative.
Radial equidistantAt(const Distortion& d, double a) {
  const double a2 = a * a;
  return {1.0 + a2 * (d.k1 + a2 * (d.k2 + a2 * (d.k3 + a2 * d.k4))),
          1.0 + a2 * (3.0 * d.k1 + a2 * (5.0 * d.k2 + a2 * (7.0 * d.k3 + a2 * 9.0 * d.k4)))};
}

/// At the squared normalized radius r2.
Radial radialAt(const Distortion& d, double r2) {
  if (d.model == LensModel::kPolynomial) return polynomialAt(d, r2);
  if (r2 == 0.0) return {1.0, 1.0};
  const double r = std::sqrt(r2);
  const double angle = std::atan(r);
  const Radial lens = equidistantAt(d, angle);
  return {angle * lens.scale / r, lens.slope / (1.0 + r2)};
}

/// The angle that an equidistant lens takes to a distorted radius; NaN when it does not converge.
double equidistantAngle(const Distortion& d, double distorted, int steps) {
  double angle = distorted;
  for (int i = 0; i < steps; ++i) {
    const Radial lens = equidistantAt(d, angle);
    angle -= (angle * lens.scale - distorted) / lens.slope;
  }
  return angle;
}

/// The lens along a ray that leaves the optical axis in the direction in which the tangential
/// distortion does the most harm.
class LensProfile {
 public:
  explicit LensProfile(const Distortion& d) : d_(d), tangential_(std::hypot(d.p1, d.p2)) {}

  /// Lower bound of the distorted radius.
  double radius(double r) const {
    return r * radialAt(d_, r * r).scale - 3.0 * tangential_ * r * r;
  }

  /// The least factor by which lengths are multiplied, the exact minimum over all directions where
  /// the radial one is the shortest. The derivative of the distortion is symmetric, and where it is
  /// positive definite on a whole disc no two points of the disc share an image. Equidistant lenses
  /// shrink lengths of the plane by design: what counts is those of the sphere.
  double stretch(double r) const {
    if (d_.model == LensModel::kEquidistant) {
      const Radial lens = equidistantAt(d_, std::atan(r));
      return std::min(lens.slope, lens.scale);
    }
    const Radial lens = polynomialAt(d_, r * r);
    return std::min(lens.slope, lens.scale) - 6.0 * tangential_ * r;
  }

  /// Whether Newton's method comes from the distorted radius to this one within a few steps.
  bool isQuicklyInverted(double r) const {
    const double wanted = r * radialAt(d_, r * r).scale;
    double x = wanted;
    if (d_.model == LensModel::kEquidistant) {
      return std::abs(equidistantAngle(d_, wanted, kQuickSteps) - std::atan(r)) < kQuickTolerance;
    }
    for (int i = 0; i < kQuickSteps; ++i) {
      const Radial lens = polynomialAt(d_, x * x);
      x -= (x * lens.scale - wanted) / lens.slope;
    }
    return std::abs(x - r) < kQuickTolerance;  // false for NaN
  }

 private:
  Distortion d_;
  double tangential_;
};

/// Normalized distance of the corner that is the furthest from the principal point.
double cornerRadius(const Camera& c) {
  return std::hypot(std::max(c.cx, c.width - 1.0 - c.cx) / c.fx,
                    std::max(c.cy, c.height - 1.0 - c.cy) / c.fy);
}

void refuseFoldingLens(const Camera& camera) {
  const LensRange range = camera.lensRange();
  if (range.distorted >= kInnerHalf * cornerRadius(camera)) return;
  const Distortion& d = camera.distortion;
  std::ostringstream text;
  text << "camera: the distortion k1 " << d.k1 << ", k2 " << d.k2 << ", p1 " << d.p1 << ", p2 "
       << d.p2 << ", k3 " << d.k3;
  if (d.k4 != 0.0 || d.isRational()) {
    text << ", k4 " << d.k4 << ", k5 " << d.k5 << ", k6 " << d.k6;
  }
  text << " folds back: no pixel has one ray beyond the normalized radius " << range.undistorted
       << ", " << std::lround(range.distorted * std::min(camera.fx, camera.fy))
       << " pixels from the principal point, in the inner half of the image: calibrate again, and "
          "check order and model ("
       << (d.model == LensModel::kEquidistant ? "equidistant"
           : d.isRational()                   ? "rational_polynomial"
                                              : "plumb_bob")
       << ") of the coefficients";
  throw Error(text.str());
}

}  // namespace

bool Distortion::isZero() const {
  return *this == Distortion();
}

bool Distortion::isRational() const {
  return model == LensModel::kPolynomial && (k4 != 0.0 || k5 != 0.0 || k6 != 0.0);
}

bool operator==(const Distortion& a, const Distortion& b) {
  return a.model == b.model && a.k1 == b.k1 && a.k2 == b.k2 && a.p1 == b.p1 && a.p2 == b.p2 &&
         a.k3 == b.k3 && a.k4 == b.k4 && a.k5 == b.k5 && a.k6 == b.k6;
}

void Camera::validate() const {
  const Distortion& d = distortion;
  const double numbers[] = {fx, fy, cx, cy, d.k1, d.k2, d.p1, d.p2, d.k3, d.k4, d.k5, d.k6};
  const bool finite = std::all_of(std::begin(numbers), std::end(numbers),
                                  [](double number) { return std::isfinite(number); });
  if (width <= 0 || height <= 0 || !finite || fx <= 0.0 || fy <= 0.0) {
    std::ostringstream text;
    text << "camera: " << width << " x " << height << " pixels, fx " << fx << ", fy " << fy
         << ", cx " << cx << ", cy " << cy
         << ": sizes and focal lengths must be positive and all numbers finite";
    throw Error(text.str());
  }
  const std::string fault = findCameraFault(*this);
  if (!fault.empty()) throw Error("camera: " + fault);
  refuseFoldingLens(*this);
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
  const Radial lens = radialAt(d, r2);
  const double radial = lens.scale;
  if (derivative != nullptr) {
    const double slope = r2 > 0.0 ? (lens.slope - lens.scale) / r2 : 0.0;
    const double mixed = slope * x * y + 2.0 * (d.p1 * x + d.p2 * y);
    *derivative << radial + slope * x * x + 2.0 * d.p1 * y + 6.0 * d.p2 * x, mixed, mixed,
        radial + slope * y * y + 6.0 * d.p1 * y + 2.0 * d.p2 * x;
  }
  return {x * radial + 2.0 * d.p1 * x * y + d.p2 * (r2 + 2.0 * x * x),
          y * radial + d.p1 * (r2 + 2.0 * y * y) + 2.0 * d.p2 * x * y};
}

LensRange Camera::lensRange() const {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  if (distortion.isZero()) return {kInfinity, kInfinity};
  const LensProfile lens(distortion);
  const double enough = kCornerMargin * cornerRadius(*this);
  const double last =
      distortion.model == LensModel::kEquidistant ? kMaxEquidistantRadius : kMaxRadius;
  LensRange range{0.0, 0.0};
  for (double r = kRadiusStep; r <= last && range.distorted <= enough; r += kRadiusStep) {
    if (!(lens.stretch(r) > kMinStretch) || !lens.isQuicklyInverted(r)) break;
    range = {r, std::max(range.distorted, lens.radius(r))};
  }
  return range;
}

bool Camera::hasRay(const Eigen::Vector2d& pixel, const LensRange& range) const {
  return std::hypot((pixel.x() - cx) / fx, (pixel.y() - cy) / fy) <= range.distorted;
}

std::optional<Eigen::Vector3d> Camera::ray(const Eigen::Vector2d& pixel) const {
  return ray(pixel, lensRange());
}

std::optional<Eigen::Vector3d> Camera::ray(const Eigen::Vector2d& pixel,
                                           const LensRange& range) const {
  const Eigen::Vector2d distorted((pixel.x() - cx) / fx, (pixel.y() - cy) / fy);
  if (distortion.isZero()) return Eigen::Vector3d(distorted.x(), distorted.y(), 1.0);
  if (!hasRay(pixel, range)) return std::nullopt;
  if (distortion.model == LensModel::kEquidistant) {
    const double radius = distorted.norm();
    if (radius == 0.0) return Eigen::Vector3d(0.0, 0.0, 1.0);
    const double undistorted = std::tan(equidistantAngle(distortion, radius, kInversionSteps));
    if (!(undistorted <= range.undistorted)) return std::nullopt;
    return Eigen::Vector3d(distorted.x(), distorted.y(), 0.0) * (undistorted / radius) +
           Eigen::Vector3d::UnitZ();
  }
  Eigen::Vector2d undistorted = distorted;
  Eigen::Matrix2d derivative;
  for (int i = 0; i < kInversionSteps; ++i) {
    const Eigen::Vector2d error = distort(undistorted, &derivative) - distorted;
    const Eigen::Vector2d step = derivative.inverse() * error;
    undistorted -= step;
    if (!(step.norm() < kLastStep)) continue;
    if (undistorted.norm() > range.undistorted) break;
    return Eigen::Vector3d(undistorted.x(), undistorted.y(), 1.0);
  }
  return std::nullopt;
}

bool operator==(const Camera& a, const Camera& b) {
  return a.width == b.width && a.height == b.height && a.fx == b.fx && a.fy == b.fy &&
         a.cx == b.cx && a.cy == b.cy && a.distortion == b.distortion;
}

}  // namespace mivo
