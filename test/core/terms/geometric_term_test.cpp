// SPDX-License-Identifier: BSD-3-Clause
#include "core/terms/geometric_term.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "support/numeric_derivative.h"
#include "support/projection.h"
#include "support/random_pose.h"
#include "support/scene.h"

namespace mivo {
namespace {

using testing::Random;

/// Into a corner of the room: three walls fix all six directions.
const Eigen::Isometry3d kIntoCorner =
    retract((Vector6() << 0.3, 0.2, -0.3, 0.0, 0.7, 0.0).finished()) *
    retract((Vector6() << 0.0, 0.0, 0.0, -0.5, 0.0, 0.0).finished());

double tukeyLoss(double u) {
  const double rest = std::max(0.0, 1.0 - u * u / (4.685 * 4.685));
  return 4.685 * 4.685 / 6.0 * (1.0 - rest * rest * rest);
}

class GeometricTermTest : public ::testing::Test {
 protected:
  explicit GeometricTermTest(const Camera& camera = testing::smallCamera()) : camera_(camera) {
    reference_ = testing::render(testing::roomScene(), camera_, kIntoCorner);
    live_frame_ = testing::render(testing::roomScene(), camera_, kIntoCorner * truth_.inverse());
    makeGeometricPoints(reference_.depth, camera_, {}, 5000, 5000, points_);
    live_.build(live_frame_, parameters_);
  }

  GeometricTerm term(std::size_t num_points = 5000) const {
    return GeometricTerm(points_, num_points, live_, warp_, parameters_);
  }

  /// What the live frame measures of each point, in the keyframe: P = T^-1 Y, once more in double.
  struct Measured {
    Eigen::Vector3d X, n, P;
    double weight;
  };
  std::vector<Measured> measured(const Eigen::Isometry3d& T_live_ref) const {
    std::vector<Measured> result;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      Measured m;
      m.X = Eigen::Vector3f(points_.x[i], points_.y[i], points_.z[i]).cast<double>();
      m.n = Eigen::Vector3f(points_.nx[i], points_.ny[i], points_.nz[i]).cast<double>();
      m.weight = 1.0 / static_cast<double>(depthDeviation(points_.z[i]));
      const auto pixel = testing::project(camera_, T_live_ref * m.X);
      if (!pixel || pixel->x() < 0.0 || pixel->y() < 0.0 || pixel->x() >= camera_.width - 1 ||
          pixel->y() >= camera_.height - 1) {
        continue;
      }
      const Eigen::Vector2d whole(std::floor(pixel->x() + 0.5), std::floor(pixel->y() + 0.5));
      const double z = static_cast<double>(
          live_frame_.depth.at<float>(static_cast<int>(whole.y()), static_cast<int>(whole.x())));
      m.P = T_live_ref.inverse() * (z * *camera_.ray(whole));
      result.push_back(m);
    }
    return result;
  }

  double cost(const std::vector<Measured>& points, double scale, const Vector6& d) const {
    double sum = 0.0;
    for (const Measured& m : points) {
      sum += tukeyLoss(m.weight * m.n.dot(retract(d) * m.P - m.X) / scale);
    }
    return sum * static_cast<double>(points_.size()) / static_cast<double>(points.size());
  }

  Camera camera_;
  Eigen::Isometry3d truth_ = Random(2).pose(0.03, 0.02);
  Parameters parameters_;
  Frame reference_;
  Frame live_frame_;
  GeometricPoints points_;
  FramePyramid live_;
  Warp warp_{camera_, {}, 1};
};

class FisheyeTermTest : public GeometricTermTest {
 protected:
  FisheyeTermTest() : GeometricTermTest(testing::fisheyeCamera()) {}
};

// Where two walls meet, a patch may pass for a plane within the sensor's noise; they must stay few.
TEST_F(GeometricTermTest, PointsLieOnTheWallsAndNormalsAreTheirs) {
  ASSERT_GT(points_.size(), 200U);
  const Eigen::Matrix3d axes = kIntoCorner.linear().transpose();  // of the walls, in the camera's
  int directions[3] = {0, 0, 0};
  std::size_t good = 0;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const Eigen::Vector3d n =
        Eigen::Vector3f(points_.nx[i], points_.ny[i], points_.nz[i]).cast<double>();
    EXPECT_NEAR(n.norm(), 1.0, 1e-5);
    EXPECT_NEAR(points_.weight[i] * depthDeviation(points_.z[i]), 1.0, 1e-4);
    const Eigen::Vector3d X =
        Eigen::Vector3f(points_.x[i], points_.y[i], points_.z[i]).cast<double>();
    const auto pixel = testing::project(camera_, X);
    ASSERT_TRUE(pixel);
    const double depth = static_cast<double>(reference_.depth.at<float>(
        static_cast<int>(std::lround(pixel->y())), static_cast<int>(std::lround(pixel->x()))));
    EXPECT_NEAR(X.z(), depth, 0.03 * depth);
    int best = 0;
    if ((axes.transpose() * n).cwiseAbs().maxCoeff(&best) < 0.999) continue;
    ++directions[best];
    if (std::abs(X.z() - depth) < 0.002 * depth) ++good;
  }
  EXPECT_GT(static_cast<double>(good), 0.9 * static_cast<double>(points_.size()));
  for (const int count : directions) EXPECT_GT(count, 20);
}

TEST_F(GeometricTermTest, HolesAndEdgesAreNoPlanes) {
  cv::Mat depth = reference_.depth.clone();
  depth.setTo(0.0F);
  GeometricPoints none;
  makeGeometricPoints(depth, camera_, {}, 5000, 5000, none);
  EXPECT_EQ(none.size(), 0U);
  Random random(3);
  for (int y = 0; y < depth.rows; ++y) {
    for (int x = 0; x < depth.cols; ++x) {
      depth.at<float>(y, x) = static_cast<float>(random.uniform(1.0, 3.0));
    }
  }
  makeGeometricPoints(depth, camera_, {}, 5000, 5000, none);
  EXPECT_EQ(none.size(), 0U);
}

TEST_F(GeometricTermTest, NoMorePointsThanAskedFor) {
  GeometricPoints few;
  makeGeometricPoints(reference_.depth, camera_, {}, 50, 50, few);
  EXPECT_EQ(few.size(), 50U);
}

TEST_F(GeometricTermTest, CostAndGradientAreThoseOfItsDefinition) {
  Random random(4);
  for (int trial = 0; trial < 3; ++trial) {
    const Eigen::Isometry3d T = random.pose(0.02, 0.01) * truth_;
    GeometricTerm geometry = term();
    const double value = geometry.evaluate(T);
    const QuadraticModel model = geometry.linearize(0);
    EXPECT_EQ(model.cost, value);
    const std::vector<Measured> points = measured(T);
    // Which pixel a point falls on is a matter of rounding for a few.
    EXPECT_NEAR(static_cast<double>(geometry.numVisible()), static_cast<double>(points.size()), 3);
    const auto definition = [&](const Vector6& d) { return cost(points, geometry.scale(), d); };
    EXPECT_NEAR(value / definition(Vector6::Zero()), 1.0, 0.02);
    const Vector6 numeric = testing::numericGradient<6>(definition, Vector6::Zero(), 1e-5);
    EXPECT_LT(testing::relativeError(model.gradient, numeric), 0.02)
        << model.gradient.transpose() << "\n"
        << numeric.transpose();
  }
}

// Towards the rim a pixel spans several times the angle of one in the middle.
TEST_F(FisheyeTermTest, ReadingsLieOnTheRaysOfTheirPixels) {
  for (const Eigen::Isometry3d& T : {truth_, Random(4).pose(0.02, 0.01) * truth_}) {
    GeometricTerm geometry = term();
    const double value = geometry.evaluate(T);
    const double expected = cost(measured(T), geometry.scale(), Vector6::Zero());
    EXPECT_NEAR(value / expected, 1.0, 0.02);
  }
}

// The rows of pixels that a patch is fitted to are bent on the wall.
TEST_F(FisheyeTermTest, PatchesLieOnTheWalls) {
  const Eigen::Matrix3d axes = kIntoCorner.linear().transpose();
  double squares = 0.0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const Eigen::Vector3d X =
        Eigen::Vector3f(points_.x[i], points_.y[i], points_.z[i]).cast<double>();
    const Eigen::Vector3d n =
        Eigen::Vector3f(points_.nx[i], points_.ny[i], points_.nz[i]).cast<double>();
    if ((axes.transpose() * n).cwiseAbs().maxCoeff() < 0.999) continue;  // across an edge
    const auto pixel = testing::project(camera_, X);
    ASSERT_TRUE(pixel);
    const double depth = static_cast<double>(reference_.depth.at<float>(
        static_cast<int>(std::lround(pixel->y())), static_cast<int>(std::lround(pixel->x()))));
    squares += std::pow(X.z() / depth - 1.0, 2);
    ++count;
  }
  ASSERT_GT(count, 200U);
  EXPECT_LT(std::sqrt(squares / static_cast<double>(count)), 5e-4);
}

TEST_F(GeometricTermTest, NearTheTruthTheHessianIsTheTrueOne) {
  GeometricTerm geometry = term();
  geometry.evaluate(truth_);
  const QuadraticModel model = geometry.linearize(0);
  const std::vector<Measured> points = measured(truth_);
  const auto definition = [&](const Vector6& d) { return cost(points, geometry.scale(), d); };
  EXPECT_LT(testing::relativeError(model.hessian,
                                   testing::numericHessian<6>(definition, Vector6::Zero(), 1e-4)),
            0.03);
  EXPECT_GT(Eigen::SelfAdjointEigenSolver<Matrix6>(model.hessian).eigenvalues().minCoeff(), 0.0);
}

TEST_F(GeometricTermTest, TheTruthCostsLeast) {
  GeometricTerm geometry = term();
  const double least = geometry.evaluate(truth_);
  EXPECT_EQ(geometry.scale(), 1.0);  // never below the sensor's own deviation
  Random random(5);
  for (int trial = 0; trial < 20; ++trial) {
    EXPECT_GT(geometry.evaluate(random.pose(0.02, 0.01) * truth_), least);
  }
}

TEST_F(GeometricTermTest, OnlyTheFirstPointsAreUsedWhenToldSo) {
  GeometricTerm few = term(60);
  few.evaluate(truth_);
  EXPECT_LE(few.numVisible(), 60U);
  EXPECT_GT(few.numVisible(), 30U);
}

TEST_F(GeometricTermTest, WithoutLiveDepthNothingIsVisible) {
  live_frame_.depth.setTo(0.0F);
  live_.build(live_frame_, parameters_);
  GeometricTerm geometry = term();
  EXPECT_TRUE(std::isinf(geometry.evaluate(truth_)));
  EXPECT_EQ(geometry.numVisible(), 0U);
}

TEST_F(GeometricTermTest, MillimetersAndMetersGiveTheSameCost) {
  GeometricTerm meters = term();
  const Eigen::Isometry3d T = Random(6).pose(0.02, 0.01) * truth_;
  const double expected = meters.evaluate(T);
  cv::Mat raw(live_frame_.depth.size(), CV_16UC1);
  live_frame_.depth.convertTo(raw, CV_16U, 10000.0);
  live_frame_.depth = raw;
  live_frame_.depth_unit = 1e-4;
  live_.build(live_frame_, parameters_);
  GeometricTerm integers = term();
  EXPECT_NEAR(integers.evaluate(T) / expected, 1.0, 0.01);
}

}  // namespace
}  // namespace mivo
