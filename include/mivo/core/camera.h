// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>

namespace mivo {

/// Lens distortion in OpenCV's order of "plumb_bob": radial k1, k2, k3 and tangential p1, p2,
/// acting on normalised coordinates. It does not change with the pyramid level.
struct Distortion {
  double k1 = 0.0;
  double k2 = 0.0;
  double p1 = 0.0;
  double p2 = 0.0;
  double k3 = 0.0;

  bool isZero() const;
};

/// Pinhole camera with distortion. Pixel centres lie at integer coordinates; x right, y down, z
/// forward (optical frame, REP 103).
struct Camera {
  int width = 0;
  int height = 0;
  double fx = 0.0;
  double fy = 0.0;
  double cx = 0.0;
  double cy = 0.0;
  Distortion distortion;

  /// Throws Error when a size or focal length is not positive, or a number is not finite.
  void validate() const;

  /// The camera of pyramid level `level` (0: this one). Levels are reduced by a Gaussian that keeps
  /// the even pixels (cv::pyrDown): pixel (x, y) of a level is centred on (2x, 2y) of the finer
  /// one, so focal lengths and principal point halve exactly, with no half pixel added.
  Camera atLevel(int level) const;

  /// Pixel of a point in the optical frame, metres; nothing for a point behind the camera or so far
  /// outside that the distortion polynomial is not valid. The pixel may lie outside of the image.
  std::optional<Eigen::Vector2d> project(const Eigen::Vector3d& point) const;

  /// Point at depth 1 m that projects to the pixel.
  Eigen::Vector3d ray(const Eigen::Vector2d& pixel) const;

  /// Largest squared radius (normalised, undistorted) at which the distortion is used: that of the
  /// image's corners and a tenth more, or where the polynomial turns back if that comes first.
  double maxSquaredRadius() const;

  /// Distorted from undistorted normalised coordinates, and the derivative.
  Eigen::Vector2d distort(const Eigen::Vector2d& undistorted,
                          Eigen::Matrix2d* derivative = nullptr) const;

  friend bool operator==(const Camera& a, const Camera& b);
  friend bool operator!=(const Camera& a, const Camera& b) { return !(a == b); }
};

}  // namespace mivo
