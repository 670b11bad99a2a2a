// SPDX-License-Identifier: BSD-3-Clause
#include "random_twist.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

namespace mivo {
namespace {

TEST(RandomTwist, HasTheNormAskedFor) {
  for (std::uint64_t trial = 0; trial < 100; ++trial) {
    EXPECT_NEAR(randomTwist(0.25, 1, 2, trial).norm(), 0.25, 1e-12);
  }
}

TEST(RandomTwist, DependsOnEachOfItsNumbers) {
  const Vector6 twist = randomTwist(1.0, 1, 2, 3);
  EXPECT_EQ(twist, randomTwist(1.0, 1, 2, 3));
  EXPECT_GT((twist - randomTwist(1.0, 2, 2, 3)).norm(), 1e-3);
  EXPECT_GT((twist - randomTwist(1.0, 1, 3, 3)).norm(), 1e-3);
  EXPECT_GT((twist - randomTwist(1.0, 1, 2, 4)).norm(), 1e-3);
}

// Of uniform directions the mean is zero and the second moment a sixth of the identity.
TEST(RandomTwist, PrefersNoDirection) {
  constexpr int kTrials = 20000;
  Vector6 mean = Vector6::Zero();
  Matrix6 moment = Matrix6::Zero();
  for (std::uint64_t trial = 0; trial < kTrials; ++trial) {
    const Vector6 twist = randomTwist(1.0, 5, 0, trial);
    mean += twist / kTrials;
    moment += twist * twist.transpose() / kTrials;
  }
  const double deviation = 1.0 / std::sqrt(static_cast<double>(kTrials));
  EXPECT_LT(mean.cwiseAbs().maxCoeff(), 4.0 * deviation);
  EXPECT_LT((moment - Matrix6::Identity() / 6.0).cwiseAbs().maxCoeff(), 4.0 * deviation);
}

TEST(PoseDifference, IsThatOfTheTwistBetweenTwoPoses) {
  Vector6 twist;
  twist << 0.003, -0.004, 0.0, 0.0, 0.006, 0.008;
  const Eigen::Isometry3d b = expSe3(Vector6::Constant(0.3));
  const PoseDifference error = difference(expSe3(twist) * b, b);
  EXPECT_NEAR(error.translation, 0.005, 1e-12);
  EXPECT_NEAR(error.rotation, 0.01, 1e-12);
}

TEST(PoseDifference, SucceedsBelowTheLimitInBoth) {
  EXPECT_TRUE(isSuccess({0.0099, 0.0099}));
  EXPECT_FALSE(isSuccess({0.0101, 0.0}));
  EXPECT_FALSE(isSuccess({0.0, 0.0101}));
  EXPECT_FALSE(isSuccess({std::nan(""), 0.0}));
}

}  // namespace
}  // namespace mivo
