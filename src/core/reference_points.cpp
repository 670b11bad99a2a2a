// SPDX-License-Identifier: BSD-3-Clause
#include "mivo/core/reference_points.h"

#include <algorithm>

#include "mivo/core/image_view.h"

namespace mivo {
namespace {

/// The values that are compared, around a pixel.
class Neighbourhood {
 public:
  Neighbourhood(const ReferenceImage& image, const Pixel& p)
      : value_(sample(image, p.x, p.y)),
        left_(sample(image, p.x - 1, p.y)),
        right_(sample(image, p.x + 1, p.y)),
        above_(sample(image, p.x, p.y - 1)),
        below_(sample(image, p.x, p.y + 1)) {}

  double value() const { return value_; }
  Eigen::Vector2d gradient() const {
    return 0.5 * Eigen::Vector2d(right_ - left_, below_ - above_);
  }

  Eigen::Matrix2d hessian(const ReferenceImage& image, const Pixel& p) const {
    const double xy = 0.25 * (sample(image, p.x + 1, p.y + 1) - sample(image, p.x - 1, p.y + 1) -
                              sample(image, p.x + 1, p.y - 1) + sample(image, p.x - 1, p.y - 1));
    Eigen::Matrix2d hessian;
    hessian << right_ - 2.0 * value_ + left_, xy, xy, below_ - 2.0 * value_ + above_;
    return hessian;
  }

 private:
  static double sample(const ReferenceImage& image, int x, int y) {
    return static_cast<double>(image.contrast != nullptr
                                   ? normalisedIntensity(image.grey, *image.contrast, x, y)
                                   : intensityAt(image.grey, x, y));
  }

  double value_, left_, right_, above_, below_;
};

/// Rows: derivative of X/Z and Y/Z with respect to X, Y, Z.
Eigen::Matrix<double, 2, 3> projectionJacobian(const Eigen::Vector3d& point) {
  const double inverse = 1.0 / point.z();
  Eigen::Matrix<double, 2, 3> J;
  J << inverse, 0.0, -point.x() * inverse * inverse, 0.0, inverse, -point.y() * inverse * inverse;
  return J;
}

float median(std::vector<float> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

void resize(std::size_t n, bool with_second_derivative, ReferencePoints& points) {
  for (std::vector<float>* array :
       {&points.x, &points.y, &points.z, &points.intensity, &points.contrast}) {
    array->resize(n);
  }
  for (std::vector<float>& array : points.jacobian) array.resize(n);
  for (std::vector<float>& array : points.second_derivative) {
    array.resize(with_second_derivative ? n : 0);
  }
}

void storeUpperTriangle(const Matrix6& matrix, std::size_t i, ReferencePoints& points) {
  std::size_t entry = 0;
  for (int row = 0; row < 6; ++row) {
    for (int column = row; column < 6; ++column) {
      points.second_derivative[entry++][i] = static_cast<float>(matrix(row, column));
    }
  }
}

}  // namespace

PointDerivatives pointDerivatives(const Eigen::Vector3d& point,
                                  const Eigen::Vector2d& normalised_gradient,
                                  const Eigen::Matrix2d& normalised_hessian) {
  const Eigen::Matrix<double, 2, 3> projection = projectionJacobian(point);
  const Eigen::Vector3d g = projection.transpose() * normalised_gradient;  // d I / d (X, Y, Z)
  PointDerivatives result;
  result.jacobian << g, point.cross(g);

  // Second derivative with respect to (X, Y, Z): through the image, and through the projection.
  Eigen::Matrix3d Q = projection.transpose() * normalised_hessian * projection;
  const double inverse_square = 1.0 / (point.z() * point.z());
  const Eigen::Vector2d bend = normalised_gradient * inverse_square;
  Q.topRightCorner<2, 1>() -= bend;
  Q.bottomLeftCorner<1, 2>() -= bend.transpose();
  Q(2, 2) += 2.0 * bend.dot(point.head<2>()) / point.z();

  Eigen::Matrix<double, 3, 6> D;  // d (exp(w) X + v) / d (v, w)
  D << Eigen::Matrix3d::Identity(), -skew(point);
  result.second = D.transpose() * Q * D;
  // Second order of the rotation itself: exp(w) X = X + w x X + w x (w x X) / 2.
  result.second.bottomRightCorner<3, 3>() += 0.5 * (g * point.transpose() + point * g.transpose()) -
                                             g.dot(point) * Eigen::Matrix3d::Identity();
  return result;
}

void makeReferencePoints(const ReferenceImage& image, const cv::Mat& depth, const Camera& camera,
                         const RowMotion& rows, bool with_second_derivative,
                         ReferencePoints& points) {
  const std::vector<Pixel>& pixels = points.pixels;
  const std::size_t n = pixels.size();
  resize(n, with_second_derivative, points);
  points.pixel_motion.setZero();
  const Eigen::Vector2d focal(camera.fx, camera.fy);
  const bool is_distorted = !camera.distortion.isZero();
  for (std::size_t i = 0; i < n; ++i) {
    const Pixel& pixel = pixels[i];
    const double z = static_cast<double>(depth.at<float>(pixel.y, pixel.x));
    const Eigen::Vector3d ray = camera.ray({pixel.x, pixel.y});
    Eigen::Vector3d point = z * ray;
    point -= rows.displacement(point, pixel.y, camera.height);
    // d pixel / d normalised coordinates. The curvature of the distortion itself is left out of the
    // second derivatives: it is hundreds of times weaker than the image's.
    Eigen::Matrix2d scale = Eigen::Matrix2d::Identity();
    if (is_distorted) camera.distort(ray.head<2>(), &scale);
    scale = focal.asDiagonal() * scale;
    const Neighbourhood values(image, pixel);
    const double contrast =
        image.contrast != nullptr
            ? static_cast<double>(localContrast(*image.contrast, pixel.x, pixel.y))
            : 1.0;
    Eigen::Matrix2d hessian = Eigen::Matrix2d::Zero();
    if (with_second_derivative) hessian = values.hessian(image, pixel);
    const PointDerivatives derivatives =
        pointDerivatives(point, contrast * scale.transpose() * values.gradient(),
                         contrast * scale.transpose() * hessian * scale);
    points.x[i] = static_cast<float>(point.x());
    points.y[i] = static_cast<float>(point.y());
    points.z[i] = static_cast<float>(point.z());
    points.intensity[i] = static_cast<float>(contrast * values.value());
    points.contrast[i] = static_cast<float>(contrast);
    for (std::size_t k = 0; k < 6; ++k) {
      points.jacobian[k][i] = static_cast<float>(derivatives.jacobian[static_cast<int>(k)]);
    }
    if (with_second_derivative) storeUpperTriangle(derivatives.second, i, points);
    Eigen::Matrix<double, 3, 6> D;
    D << Eigen::Matrix3d::Identity(), -skew(point);
    const Eigen::Matrix<double, 2, 6> motion = scale * projectionJacobian(point) * D;
    points.pixel_motion += motion.transpose() * motion;
  }
  points.median_depth = n > 0 ? median(points.z) : 1.0F;
  if (n > 0) points.pixel_motion /= static_cast<double>(n);
}

}  // namespace mivo
