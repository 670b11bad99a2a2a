// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>

namespace mivo {

/// How a ray's angle becomes a distance from the principal point.
enum class LensModel {
  /// OpenCV's and ROS' "plumb_bob" and "rational_polynomial", of the normalized radius r: r (1 +
  /// k1 r^2 + k2 r^4 + k3 r^6) / (1 + k4 r^2 + k5 r^4 + k6 r^6), and tangential p1, p2.
  kPolynomial,
  /// ROS' "equidistant", OpenCV's fisheye, of the angle a to the optical axis: a (1 + k1 a^2 +
  /// k2 a^4 + k3 a^6 + k4 a^8). The others are zero.
  kEquidistant
};

/// Lens distortion, in OpenCV's order, acting on normalized coordinates. It does not change with
/// the pyramid level.
struct Distortion {
  double k1 = 0.0;
  double k2 = 0.0;
  double p1 = 0.0;
  double p2 = 0.0;
  double k3 = 0.0;
  double k4 = 0.0;
  double k5 = 0.0;
  double k6 = 0.0;
  LensModel model = LensModel::kPolynomial;

  /// A pinhole: a polynomial of zeros. An equidistant lens is never one.
  bool isZero() const;
  /// A polynomial with a denominator.
  bool isRational() const;

  friend bool operator==(const Distortion& a, const Distortion& b);
  friend bool operator!=(const Distortion& a, const Distortion& b) { return !(a == b); }
};

/// Radius around the optical axis within which the lens model is invertible: each pixel has one
/// ray. Radii in normalized coordinates; both infinite for a lens without distortion.
struct LensRange {
  double undistorted;  ///< of rays
  double distorted;    ///< of pixels: (pixel - principal point) / focal length
};

/// Pinhole camera with distortion. Pixel centers lie at integer coordinates; x right, y down, z
/// forward (optical frame, REP 103).
struct Camera {
  int width = 0;
  int height = 0;
  double fx = 0.0;
  double fy = 0.0;
  double cx = 0.0;
  double cy = 0.0;
  Distortion distortion;

  /// Throws Error when a size or focal length is not positive, a number is not finite, the image
  /// would span less than 10 or more than 170 degrees, the principal point lies outside of it, or
  /// the lens' polynomial folds back in its inner half.
  void validate() const;

  /// The camera of pyramid level `level` (0: this one). Levels are reduced by a Gaussian that keeps
  /// the even pixels (cv::pyrDown): pixel (x, y) of a level is centered on (2x, 2y) of the finer
  /// one, so focal lengths and principal point halve exactly, with no half pixel added.
  Camera atLevel(int level) const;

  /// Radius up to which the lens is used: the corners of the image plus at least 10 %, or the
  /// radius at which the polynomial nearly folds back, if that is smaller.
  LensRange lensRange() const;

  /// Whether the pixel lies within the range of this camera's lens.
  bool hasRay(const Eigen::Vector2d& pixel, const LensRange& range) const;

  /// Point at depth 1 m that projects to the pixel; empty for a pixel outside of the lens' range.
  std::optional<Eigen::Vector3d> ray(const Eigen::Vector2d& pixel) const;

  /// The same for many pixels, with the range computed once. @param range lensRange() of this
  /// camera or of another level of it.
  std::optional<Eigen::Vector3d> ray(const Eigen::Vector2d& pixel, const LensRange& range) const;

  /// Distorted from undistorted normalized coordinates, and the derivative.
  Eigen::Vector2d distort(const Eigen::Vector2d& undistorted,
                          Eigen::Matrix2d* derivative = nullptr) const;

  friend bool operator==(const Camera& a, const Camera& b);
  friend bool operator!=(const Camera& a, const Camera& b) { return !(a == b); }
};

}  // namespace mivo
