// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/alignment.h"

#include <gtest/gtest.h>

#include <random>

#include "mivo/core/se3.h"

namespace mivo {
namespace {

Eigen::Isometry3d sampleMotion() {
  Vector6 twist;
  twist << 1.0, -2.0, 0.5, 2.0, 0.3, -1.0;
  return expSe3(twist);
}

Eigen::Matrix3Xd randomPoints(int count, unsigned seed) {
  std::mt19937 engine(seed);
  Eigen::Matrix3Xd points(3, count);
  for (Eigen::Index i = 0; i < points.size(); ++i) {
    points(i) = 1e-6 * static_cast<double>(engine() % 2000001) - 1.0;
  }
  return points;
}

double squaredError(const Eigen::Isometry3d& T, const Eigen::Matrix3Xd& a,
                    const Eigen::Matrix3Xd& b) {
  return ((T * a) - b).squaredNorm();
}

TEST(AlignmentTest, FindsTheMotionBetweenEqualShapes) {
  const Eigen::Matrix3Xd points = randomPoints(20, 1);
  const Eigen::Isometry3d T = sampleMotion();
  EXPECT_TRUE(rigidAlignment(points, T * points).isApprox(T, 1e-12));
}

TEST(AlignmentTest, DoesNotScale) {
  const Eigen::Matrix3Xd points = randomPoints(20, 2);
  const Eigen::Isometry3d T = rigidAlignment(points, 3.0 * points);
  EXPECT_NEAR(T.linear().determinant(), 1.0, 1e-12);
  EXPECT_TRUE(T.linear().isIdentity(1e-12));
}

TEST(AlignmentTest, MirroredShapeStillGetsARotation) {
  const Eigen::Matrix3Xd points = randomPoints(20, 3);
  const Eigen::Matrix3Xd mirrored = Eigen::Vector3d(1.0, 1.0, -1.0).asDiagonal() * points;
  EXPECT_NEAR(rigidAlignment(points, mirrored).linear().determinant(), 1.0, 1e-12);
}

TEST(AlignmentTest, NoNeighborIsBetter) {
  const Eigen::Matrix3Xd from = randomPoints(15, 4);
  const Eigen::Matrix3Xd to = sampleMotion() * from + 0.3 * randomPoints(15, 5);
  const Eigen::Isometry3d best = rigidAlignment(from, to);
  const double error = squaredError(best, from, to);
  for (int i = 0; i < 6; ++i) {
    for (const double step : {-1e-3, 1e-3}) {
      EXPECT_GT(squaredError(best * retract(step * Vector6::Unit(i)), from, to), error);
    }
  }
}

TEST(AlignmentTest, PathsOnALineOrAtAPointStayFinite) {
  Eigen::Matrix3Xd line(3, 4);
  line << 0, 1, 2, 3, 0, 0, 0, 0, 0, 0, 0, 0;
  const Eigen::Isometry3d T = sampleMotion();
  EXPECT_LT(squaredError(rigidAlignment(line, T * line), line, T * line), 1e-20);
  const Eigen::Matrix3Xd point = Eigen::Matrix3Xd::Constant(3, 5, 2.0);
  const Eigen::Isometry3d shift = rigidAlignment(point, T * point);
  EXPECT_LT(squaredError(shift, point, T * point), 1e-20);
  EXPECT_NEAR(shift.linear().determinant(), 1.0, 1e-12);
}

}  // namespace
}  // namespace mivo
