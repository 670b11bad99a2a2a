// SPDX-License-Identifier: BSD-3-Clause
#include "session/twist_covariance.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <limits>

namespace mivo {
namespace {

double smallestEigenvalue(const Matrix6& matrix) {
  return Eigen::SelfAdjointEigenSolver<Matrix6>(matrix).eigenvalues().minCoeff();
}

TEST(BoundedCovarianceTest, KeepsWhatIsSound) {
  const Matrix6 sound = (Vector6() << 1, 2, 3, 4, 5, 6).finished().asDiagonal();
  EXPECT_EQ(sound, boundedCovariance(sound));
}

TEST(BoundedCovarianceTest, MakesAnythingFiniteSymmetricAndPositive) {
  Matrix6 bad = Matrix6::Zero();
  EXPECT_GE(smallestEigenvalue(boundedCovariance(bad)), 0.99 * kMinVariance);
  bad(0, 0) = -3.0;
  bad(1, 1) = 1e300;
  bad(2, 3) = 5.0;
  const Matrix6 bounded = boundedCovariance(bad);
  EXPECT_TRUE(bounded.allFinite());
  EXPECT_EQ(bounded, bounded.transpose().eval());
  EXPECT_LE(bounded.diagonal().maxCoeff(), kMaxVariance * (1 + 1e-9));
  EXPECT_GE(bounded.diagonal().minCoeff(), 0.0);
  bad(4, 4) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(Matrix6(Matrix6::Identity() * kUnknownVariance), boundedCovariance(bad));
}

TEST(TwistCovarianceTest, IsTheSumOverTheSquaredTime) {
  const Matrix6 a = Matrix6::Identity() * 2e-6;
  const Matrix6 b = Matrix6::Identity() * 3e-6;
  EXPECT_TRUE(twistCovariance(a, b, 0.1).isApprox(Matrix6::Identity() * 5e-4, 1e-12));
  EXPECT_EQ(Matrix6(Matrix6::Identity() * kUnknownVariance), twistCovariance(a, b, 0.0));
}

}  // namespace
}  // namespace mivo
