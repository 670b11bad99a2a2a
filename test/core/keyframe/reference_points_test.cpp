// SPDX-License-Identifier: BSD-3-Clause
#include "core/keyframe/reference_points.h"

#include <gtest/gtest.h>

#include "support/analytic_points.h"
#include "support/numeric_derivative.h"
#include "support/projection.h"
#include "support/random_pose.h"

namespace mivo {
namespace {

using testing::analyticCamera;
using testing::AnalyticImage;
using testing::Random;

constexpr double kStep = 2e-3;

Camera lensCamera() {
  Camera camera = analyticCamera();
  camera.distortion = {0.2, -0.35, 0.001, -0.002, 0.1};
  return camera;
}

/// Eight coefficients, as an Azure Kinect's: large ones that nearly cancel each other.
Camera rationalCamera() {
  Camera camera = analyticCamera();
  camera.distortion = {0.62, -2.74, 0.0005, -0.0002, 1.54, 0.49, -2.55, 1.46};
  return camera;
}

/// 120 degrees wide.
Camera equidistantCamera() {
  Camera camera = analyticCamera();
  camera.fx = 46.0;
  camera.fy = 45.0;
  camera.distortion = {0.03, -0.01, 0.0, 0.0, 0.002, -0.0005, 0.0, 0.0, LensModel::kEquidistant};
  return camera;
}

std::vector<Camera> allCameras() {
  return {analyticCamera(), lensCamera(), rationalCamera(), equidistantCamera()};
}

cv::Mat slopingDepthImage(const Camera& camera) {
  cv::Mat depth(camera.height, camera.width, CV_32FC1);
  for (int y = 0; y < depth.rows; ++y) {
    for (int x = 0; x < depth.cols; ++x) {
      depth.at<float>(y, x) = static_cast<float>(testing::slopingDepth(x, y));
    }
  }
  return depth;
}

ReferencePoints makePoints(const cv::Mat& image, const Camera& camera,
                           const std::vector<Pixel>& pixels, const RowMotion& rows = {}) {
  ReferencePoints points;
  points.pixels = pixels;
  makeReferencePoints({image}, {slopingDepthImage(camera)}, camera, rows, true, points);
  return points;
}

Vector6 jacobianOf(const ReferencePoints& points, std::size_t i) {
  Vector6 J;
  for (std::size_t k = 0; k < 6; ++k) {
    J[static_cast<int>(k)] = static_cast<double>(points.jacobian[k][i]);
  }
  return J;
}

Matrix6 secondDerivativeOf(const ReferencePoints& points, std::size_t i) {
  Matrix6 H;
  std::size_t entry = 0;
  for (int row = 0; row < 6; ++row) {
    for (int column = row; column < 6; ++column) {
      H(row, column) = H(column, row) = static_cast<double>(points.second_derivative[entry++][i]);
    }
  }
  return H;
}

const std::vector<Pixel> kPixels = {{12, 9}, {50, 40}, {88, 15}, {20, 70}, {80, 66}, {49, 41}};

TEST(PointDerivativesTest, AgreeWithDifferencesOfAnImageSeenThroughThePinhole) {
  Random random(1);
  for (const AnalyticImage& image : {testing::waves(), testing::blobs(), testing::litWaves()}) {
    for (const Pixel& pixel : kPixels) {
      const Camera camera = analyticCamera();
      const Eigen::Vector3d point = random.uniform(0.5, 3.0) * *camera.ray({pixel.x, pixel.y});
      const testing::ImageJet jet = image({pixel.x, pixel.y});
      const Eigen::Vector2d f(camera.fx, camera.fy);
      const testing::PointDerivatives derivatives = testing::pointDerivatives(
          point, f.asDiagonal() * jet.gradient, f.asDiagonal() * jet.hessian * f.asDiagonal());
      const auto intensity = [&](const Vector6& d) {
        return testing::warpedIntensity(image, camera, point, d);
      };
      const Vector6 zero = Vector6::Zero();
      EXPECT_TRUE(testing::convergesTo(
          derivatives.jacobian,
          [&](double step) { return testing::numericGradient<6>(intensity, zero, step); }, kStep,
          1e-7))
          << pixel.x << ' ' << pixel.y;
      EXPECT_TRUE(testing::convergesTo(
          derivatives.second,
          [&](double step) { return testing::numericHessian<6>(intensity, zero, step); }, kStep,
          1e-5))
          << pixel.x << ' ' << pixel.y;
    }
  }
}

// Central differences of a quadratic image are exact, so nothing but rounding is left.
AnalyticImage quadratic() {
  Eigen::Matrix2d hessian;
  hessian << 0.05, -0.02, -0.02, 0.03;
  return testing::quadraticImage(90.0, {48.0, 39.0}, {1.1, -0.7}, hessian);
}

TEST(ReferencePointsTest, DerivativesAreThoseOfTheIntensityUnderAnIncrement) {
  const AnalyticImage image = quadratic();
  for (const Camera& camera : allCameras()) {
    const cv::Mat raster = testing::rasterized(image, camera.width, camera.height);
    const ReferencePoints points = makePoints(raster, camera, kPixels);
    ASSERT_EQ(points.size(), kPixels.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Eigen::Vector3d point = testing::pointAt(points, i);
      const auto intensity = [&](const Vector6& d) {
        return testing::warpedIntensity(image, camera, point, d);
      };
      const Vector6 gradient = testing::numericGradient<6>(intensity, Vector6::Zero(), 1e-5);
      const Matrix6 hessian = testing::numericHessian<6>(intensity, Vector6::Zero(), 1e-4);
      EXPECT_LT(testing::relativeError(jacobianOf(points, i), gradient), 2e-4) << i;
      EXPECT_LT(testing::relativeError(secondDerivativeOf(points, i), hessian), 2e-3) << i;
    }
  }
}

TEST(ReferencePointsTest, AnImageOnARasterConvergesToTheTrueDerivative) {
  // Halving the frequency divides the error of the central differences by four.
  const auto errorAt = [](double frequency) {
    const Camera camera = analyticCamera();
    const AnalyticImage image = testing::waveImage(128.0, {{80.0, {frequency, 0.0}, 0.4}});
    const ReferencePoints points =
        makePoints(testing::rasterized(image, camera.width, camera.height), camera, {{40, 30}});
    const ReferencePoints exact = [&] {
      const Eigen::Vector2d f(camera.fx, camera.fy);
      const testing::ImageJet jet = image({40, 30});
      ReferencePoints result = points;
      const testing::PointDerivatives derivatives = testing::pointDerivatives(
          testing::pointAt(points, 0), f.asDiagonal() * jet.gradient, Eigen::Matrix2d::Zero());
      for (std::size_t k = 0; k < 6; ++k) {
        result.jacobian[k][0] = static_cast<float>(derivatives.jacobian[static_cast<int>(k)]);
      }
      return result;
    }();
    return testing::relativeError(jacobianOf(points, 0), jacobianOf(exact, 0));
  };
  EXPECT_NEAR(errorAt(0.4) / errorAt(0.2), 4.0, 0.1);
}

TEST(ReferencePointsTest, PointsProjectToTheirPixelsAndKeepTheirIntensity) {
  const AnalyticImage image = testing::waves();
  for (const Camera& camera : allCameras()) {
    const ReferencePoints points =
        makePoints(testing::rasterized(image, camera.width, camera.height), camera, kPixels);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Pixel& pixel = kPixels[i];
      const Eigen::Vector3d point = testing::pointAt(points, i);
      EXPECT_NEAR(point.z(), testing::slopingDepth(pixel.x, pixel.y), 1e-6);
      EXPECT_LT((*testing::project(camera, point) - Eigen::Vector2d(pixel.x, pixel.y)).norm(),
                1e-4);
      EXPECT_NEAR(points.intensity[i], image({pixel.x, pixel.y}).value, 1e-4);
      EXPECT_EQ(points.contrast[i], 1.0F);
    }
  }
}

TEST(ReferencePointsTest, PixelMotionIsTheMeanSquareOfWhatAnIncrementMoves) {
  Random random(2);
  for (const Camera& camera : allCameras()) {
    const cv::Mat raster = testing::rasterized(testing::waves(), camera.width, camera.height);
    const ReferencePoints points = makePoints(raster, camera, kPixels);
    for (int trial = 0; trial < 5; ++trial) {
      const Vector6 d = random.increment(1e-5, 1e-5);
      double sum = 0.0;
      for (std::size_t i = 0; i < points.size(); ++i) {
        const Eigen::Vector3d point = testing::pointAt(points, i);
        sum += (*testing::project(camera, testing::warped(point, d)) -
                *testing::project(camera, point))
                   .squaredNorm();
      }
      EXPECT_NEAR(d.dot(points.pixel_motion * d) / (sum / static_cast<double>(points.size())), 1.0,
                  1e-3);
    }
  }
}

TEST(ReferencePointsTest, MedianDepthIsThatOfThePoints) {
  const Camera camera = analyticCamera();
  const cv::Mat raster = testing::rasterized(testing::waves(), camera.width, camera.height);
  const ReferencePoints points = makePoints(raster, camera, {{10, 10}, {50, 10}, {90, 10}});
  EXPECT_NEAR(points.median_depth, testing::slopingDepth(50, 10), 1e-6);
  EXPECT_EQ(makePoints(raster, camera, {}).median_depth, 1.0F);
}

TEST(ReferencePointsTest, RowsReadAtAnotherTimeAreMovedToTheMiddleOne) {
  const Camera camera = analyticCamera();
  RowMotion rows;
  rows.readout = 1.0;
  rows.twist << 0.02, -0.01, 0.03, 0.01, 0.04, -0.02;
  const cv::Mat raster = testing::rasterized(testing::waves(), camera.width, camera.height);
  const ReferencePoints still = makePoints(raster, camera, kPixels);
  const ReferencePoints moved = makePoints(raster, camera, kPixels, rows);
  for (std::size_t i = 0; i < still.size(); ++i) {
    const double tau = kPixels[i].y / 80.0 - 0.5;
    const Eigen::Vector3d X = testing::pointAt(still, i);
    const Eigen::Vector3d expected =
        X - tau * (rows.twist.tail<3>().cross(X) + rows.twist.head<3>());
    EXPECT_LT((testing::pointAt(moved, i) - expected).norm(), 1e-6);
  }
  EXPECT_LT((testing::pointAt(moved, 1) - testing::pointAt(still, 1)).norm(), 1e-6);  // row 40
}

// A plane that approaches and moves sideways between the color image and its depth.
TEST(ReferencePointsTest, DepthReadLaterIsMovedToTheTimeOfTheImage) {
  const Camera camera = analyticCamera();
  const cv::Mat raster = testing::rasterized(testing::waves(), camera.width, camera.height);
  RowMotion rows;
  rows.twist << 0.06, 0.0, -0.2, 0.0, 0.0, 0.0;
  constexpr double kOffset = 0.5;
  const Eigen::Vector3d motion = kOffset * rows.twist.head<3>();
  // Plane z = 2 + x / 2 at the time of the image: 2 z / (2 - (u - cx) / fx) = z.
  const auto planeDepth = [&](double u, const Eigen::Vector3d& moved) {
    const double slope = (u - camera.cx) / camera.fx;
    return (2.0 + moved.z() - 0.5 * moved.x()) / (1.0 - 0.5 * slope);
  };
  cv::Mat depth(camera.height, camera.width, CV_32FC1);
  for (int x = 0; x < depth.cols; ++x) depth.col(x).setTo(planeDepth(x, motion));
  ReferencePoints points;
  points.pixels = kPixels;
  makeReferencePoints({raster}, {depth, kOffset}, camera, rows, false, points);
  for (std::size_t i = 0; i < points.size(); ++i) {
    // Up to the change of this plane's depth over one pixel of rounding.
    EXPECT_NEAR(static_cast<double>(points.z[i]), planeDepth(kPixels[i].x, Eigen::Vector3d::Zero()),
                0.75 / camera.fx * 2.0);
  }
}

// Mean and deviation are the same everywhere: normalizing subtracts the mean, and the weighting by
// the contrast restores gray levels. Gradients of normalized images are smoothed across their
// direction, those of raw images are not.
TEST(ReferencePointsTest, NormalizedPointsAreInGrayLevelsAgain) {
  const Camera camera = analyticCamera();
  const cv::Mat raster = testing::rasterized(testing::waves(), camera.width, camera.height);
  ContrastMap map;
  map.pairs = cv::Mat(21, 26, CV_32FC2, cv::Scalar(100.0F, 24.0F));
  map.constant = 6.0F;
  const ReferencePoints raw = makePoints(raster, camera, kPixels);
  ReferencePoints normalized;
  normalized.pixels = kPixels;
  makeReferencePoints({raster, &map}, {slopingDepthImage(camera)}, camera, {}, false, normalized);
  for (std::size_t i = 0; i < raw.size(); ++i) {
    EXPECT_FLOAT_EQ(normalized.contrast[i], 30.0F);
    EXPECT_NEAR(normalized.intensity[i], raw.intensity[i] - 100.0F, 1e-4);
    EXPECT_LT(testing::relativeError(jacobianOf(normalized, i), jacobianOf(raw, i)), 0.01);
    EXPECT_TRUE(normalized.second_derivative[0].empty());
  }
}

// Also at sharp edges: a gradient component along the edge would be mistaken for texture.
TEST(ReferencePointsTest, GradientsOfNormalizedImagesPointAcrossObliqueEdges) {
  const Camera camera = analyticCamera();
  const Eigen::Vector2d across(std::cos(0.45), std::sin(0.45));
  cv::Mat raster(camera.height, camera.width, CV_8UC1);
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      const double wave = std::sin(0.9 * (across.x() * u + across.y() * v));  // seven pixels long
      raster.at<unsigned char>(v, u) =
          static_cast<unsigned char>(std::lround(128.0 + 100.0 * wave));
    }
  }
  ContrastMap map;
  map.pairs = cv::Mat(21, 26, CV_32FC2, cv::Scalar(128.0F, 70.0F));
  map.constant = 6.0F;
  ReferencePoints points;
  points.pixels = kPixels;
  makeReferencePoints({raster, &map}, {slopingDepthImage(camera)}, camera, {}, false, points);
  double along = 0.0;
  double size = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    // The derivative with respect to a translation parallel to the image plane is gradient . f / z.
    const Vector6 jacobian = jacobianOf(points, i);
    const Eigen::Vector2d gradient(jacobian[0] / camera.fx, jacobian[1] / camera.fy);
    along += std::pow(across.x() * gradient.y() - across.y() * gradient.x(), 2);
    size += gradient.squaredNorm();
  }
  EXPECT_LT(std::sqrt(along / size), 0.01);  // central differences alone: 0.035
}

TEST(ReferencePointsTest, DepthOfALaterTimeIsTakenWhereTheSurfaceIsThen) {
  const Camera camera = lensCamera();
  const Eigen::Vector3d normal(0.3, -0.2, -1.0);  // of a plane normal . X = distance
  const double distance = -2.0;
  const double offset = 0.4;
  Vector6 twist;
  twist << 0.02, -0.03, 0.05, 0.03, -0.04, 0.02;
  const Eigen::Vector3d v = twist.head<3>();
  const Eigen::Vector3d w = twist.tail<3>();
  // A point s r of the depth image was at s r - offset (w x s r + v), which is on the plane.
  cv::Mat depth(camera.height, camera.width, CV_32FC1);
  for (int y = 0; y < depth.rows; ++y) {
    for (int x = 0; x < depth.cols; ++x) {
      const Eigen::Vector3d ray = *camera.ray({x, y});
      depth.at<float>(y, x) =
          static_cast<float>((distance + offset * normal.dot(v)) /
                             (normal.dot(ray) - offset * normal.dot(w.cross(ray))));
    }
  }
  ReferencePoints points;
  points.pixels = kPixels;
  const cv::Mat image = testing::rasterized(quadratic(), camera.width, camera.height);
  makeReferencePoints({image}, {depth, offset}, camera, RowMotion{twist, 0.0, 0.0}, false, points);
  double unmoved = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Pixel pixel = kPixels[i];
    const double expected = distance / normal.dot(*camera.ray({pixel.x, pixel.y}));
    // The reading is that of the nearest pixel.
    const double half_a_pixel = 0.5 * expected * normal.head<2>().lpNorm<1>() / camera.fx;
    EXPECT_NEAR(static_cast<double>(points.z[i]), expected, 1.3 * half_a_pixel) << i;
    unmoved = std::max(
        unmoved,
        std::abs(static_cast<double>(depth.at<float>(pixel.y, pixel.x)) - expected) / half_a_pixel);
  }
  EXPECT_GT(unmoved, 3.0);
}

}  // namespace
}  // namespace mivo
