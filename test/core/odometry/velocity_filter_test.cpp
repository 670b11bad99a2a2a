// SPDX-License-Identifier: BSD-3-Clause
#include "core/odometry/velocity_filter.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/alignment/pose_covariance.h"
#include "support/random_pose.h"

namespace mivo {
namespace {

constexpr double kPeriod = 1.0 / 30.0;

class VelocityFilterTest : public ::testing::Test {
 protected:
  VelocityFilterTest() { filter_.reset(parameters_); }

  /// A motion of so many periods whose error has these deviations, m and rad.
  void add(const Vector6& twist, double translation, double rotation, double periods = 1.0,
           bool has_open_directions = false) {
    MeasuredMotion motion;
    motion.twist = twist;
    motion.covariance = diagonalCovariance(translation, rotation);
    motion.periods = periods;
    motion.seconds = periods * kPeriod;
    motion.has_open_directions = has_open_directions;
    filter_.add(motion, parameters_);
  }

  Vector6 twist_ = (Vector6() << 0.006, -0.004, 0.008, 0.01, 0.005, -0.01).finished();
  MotionParameters parameters_ = Parameters().motion;
  VelocityFilter filter_;
};

TEST_F(VelocityFilterTest, AMotionKnownExactlyIsFollowedAtOnce) {
  for (const double periods : {1.0, 3.0}) {
    add(periods * twist_, 0.0, 0.0, periods);
    EXPECT_LT((filter_.twistPerPeriod() - twist_).norm(), 1e-12);
    twist_ *= -0.5;
  }
}

TEST_F(VelocityFilterTest, AWrongPoseThatIsHardlyKnownDoesNotLeadAway) {
  for (int n = 0; n < 10; ++n) add(twist_, 0.001, 0.0005);
  Vector6 wrong = twist_;
  wrong[0] += 0.03;
  add(wrong, 0.02, 0.005);
  const double error = filter_.twistPerPeriod()[0] - twist_[0];
  EXPECT_GT(error, 0.0);
  EXPECT_LT(error, 0.1 * 0.03);
}

// The gain is that of the variances before and of the motion.
TEST_F(VelocityFilterTest, TheFirstMotionCountsAgainstTheExpectedSpeed) {
  const double deviation = parameters_.expected_speed * kPeriod;
  add(twist_, deviation, 0.0);
  EXPECT_NEAR(filter_.twistPerPeriod()[0], 0.5 * twist_[0], 1e-12);
  EXPECT_NEAR(filter_.twistPerPeriod()[3], twist_[3], 1e-12);
  const double change = parameters_.expected_acceleration * kPeriod;
  const double variance = 0.5 * std::pow(parameters_.expected_speed, 2) + change * change;
  EXPECT_NEAR(filter_.covariance()(0, 0), variance, 1e-12);
}

TEST_F(VelocityFilterTest, TheErrorsAreThoseOfTheCovariance) {
  testing::Random random(1);
  constexpr double kDeviation = 0.004;  // m, of a motion
  const double acceleration = parameters_.expected_acceleration;
  constexpr int kMotions = 2000;
  double velocity = 0.0;
  double chi_square = 0.0;
  for (int n = 0; n < kMotions; ++n) {
    const double error = filter_.twistPerPeriod()[0] / kPeriod - velocity;
    if (n > 0) chi_square += error * error / filter_.covariance()(0, 0);
    Vector6 measured = Vector6::Zero();
    measured[0] = velocity * kPeriod + kDeviation * random.normal();
    add(measured, kDeviation, 0.001);
    velocity += acceleration * kPeriod * random.normal();
  }
  EXPECT_NEAR(chi_square / (kMotions - 1), 1.0, 0.15);
}

TEST_F(VelocityFilterTest, WithConstantVelocityTheLastMotionAloneCounts) {
  parameters_.motion_model = MotionModelKind::kConstantVelocity;
  for (int n = 0; n < 3; ++n) {
    twist_ *= -0.5;
    add(twist_, 0.3, 0.3);
    EXPECT_EQ(filter_.twistPerPeriod(), twist_);
  }
  EXPECT_GT(filter_.covariance()(0, 0), std::pow(0.3 / kPeriod, 2));
}

TEST_F(VelocityFilterTest, OpenDirectionsLeaveTheCovarianceAsItWas) {
  for (int n = 0; n < 10; ++n) add(twist_, 0.001, 0.0005);
  const Matrix6 before = filter_.covariance();
  add(twist_, 0.5, 0.0005, 1.0, true);
  EXPECT_EQ(filter_.covariance(), before);
  EXPECT_LT((filter_.twistPerPeriod() - twist_).norm(), 1e-4);
}

}  // namespace
}  // namespace mivo
