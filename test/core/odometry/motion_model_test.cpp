// SPDX-License-Identifier: BSD-3-Clause
#include "core/odometry/motion_model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/random_pose.h"

namespace mivo {
namespace {

constexpr double kPeriod = 1.0 / 30.0;

class MotionModelTest : public ::testing::Test {
 protected:
  /// Pose at frame n of a screw motion that turns by `twist_` with each frame.
  Eigen::Isometry3d pose(double n) const { return start_ * expSe3(n * twist_); }

  /// Adds frame n, with its stamp shifted by `jitter` seconds.
  void feed(int n, double jitter = 0.0) {
    stamp_ = 100.0 + n * kPeriod + jitter;
    clock_.add(stamp_);
    MeasuredPose measured;
    measured.stamp = stamp_;
    measured.T_odom_camera = pose(n);
    model_.add(measured, clock_, motion());
    last_ = pose(n);
  }

  const MotionParameters& motion() const { return parameters_.motion; }

  Eigen::Isometry3d predicted(double stamp, const Eigen::Isometry3d& last) const {
    return model_.predict(stamp, last, clock_, motion());
  }

  void expectPrediction(double stamp, double n, double tolerance = 1e-9) {
    EXPECT_LT((predicted(stamp, last_).matrix() - pose(n).matrix()).cwiseAbs().maxCoeff(),
              tolerance);
  }

  Vector6 twist_ = (Vector6() << 0.01, -0.02, 0.03, 0.02, 0.01, -0.03).finished();
  Eigen::Isometry3d start_ = testing::Random(3).pose(1.0, 1.0);
  Eigen::Isometry3d last_ = Eigen::Isometry3d::Identity();
  FrameClock clock_;
  MotionModel model_;
  Parameters parameters_;
  double stamp_ = 0.0;
};

TEST_F(MotionModelTest, WithoutTwoPosesTheLastOneIsThePrediction) {
  expectPrediction(100.0, 0.0, 10.0);
  EXPECT_EQ(predicted(1.0, pose(7)).matrix(), pose(7).matrix());
  feed(0);
  EXPECT_EQ(predicted(101.0, last_).matrix(), pose(0).matrix());
  EXPECT_EQ(model_.velocity(clock_, motion()), Vector6::Zero());
}

TEST_F(MotionModelTest, AScrewIsContinued) {
  for (int n = 0; n < 4; ++n) feed(n);
  expectPrediction(stamp_ + kPeriod, 4.0);
}

/// Deviations of the prediction along z and about it.
Eigen::Vector2d deviations(const Matrix6& covariance) {
  return {std::sqrt(covariance(2, 2)), std::sqrt(covariance(5, 5))};
}

TEST_F(MotionModelTest, ThePredictionErrsByWhatTheCameraMayAccelerate) {
  twist_.setZero();
  parameters_.motion.expected_acceleration = 1.0;
  parameters_.motion.expected_turn_acceleration = 2.0;
  parameters_.motion.expected_speed = 1e-3;
  parameters_.motion.expected_turn_rate = 1e-3;
  for (int n = 0; n < 4; ++n) feed(n);
  // Limited by the expected speed, for any acceleration.
  const Eigen::Vector2d slow = deviations(model_.covariance(stamp_ + kPeriod, clock_, motion()));
  EXPECT_LT(slow[0], 1.1e-3 * kPeriod);
  parameters_.motion.expected_speed = 1.0;
  parameters_.motion.expected_turn_rate = 2.0;
  feed(4);
  const Eigen::Vector2d fast = deviations(model_.covariance(stamp_ + kPeriod, clock_, motion()));
  EXPECT_GT(fast[0], 0.9 * kPeriod * kPeriod);
  EXPECT_NEAR(fast[1], 2.0 * fast[0], 1e-9);
}

TEST_F(MotionModelTest, UnseenTheCameraDriftsAtTheSpeedThatItMayHave) {
  for (int n = 0; n < 4; ++n) feed(n);
  const double speed = 30.0 * twist_.head<3>().norm();
  double before = 0.0;
  for (const double seconds : {0.1, 0.5, 1.0, 2.0, 10.0, 600.0}) {
    const double sigma = deviations(model_.covariance(stamp_ + seconds, clock_, motion()))[0];
    EXPECT_GT(sigma, before);
    EXPECT_LT(sigma, 2.0 * std::max(speed, motion().expected_speed) * seconds);
    before = sigma;
  }
  EXPECT_GT(before, 0.9 * std::max(speed, motion().expected_speed) * 600.0);
}

TEST_F(MotionModelTest, MotionIsContinuedForHalfASecondAndNoLonger) {
  for (int n = 0; n < 40; ++n) feed(n);
  expectPrediction(stamp_ + 0.4, 39.0 + 12.0, 1e-6);
  for (const double gap : {0.5, 2.0, 60.0, 600.0})
    expectPrediction(stamp_ + gap, 39.0 + 15.0, 1e-6);
}

TEST_F(MotionModelTest, OpenDirectionsKeepTheirVelocityForHalfASecond) {
  twist_ << 0.01, 0.0, 0.004, 0.0, 0.0, 0.0;
  start_.setIdentity();
  for (int n = 0; n < 10; ++n) feed(n);
  const double known = model_.covariance(stamp_ + kPeriod, clock_, motion())(0, 0);
  // From here on motion along x is not observable; along z it is.
  Eigen::Isometry3d T = pose(9);
  for (int n = 10; n < 60; ++n) {
    const double stamp = 100.0 + n * kPeriod;
    clock_.add(stamp);
    MeasuredPose measured;
    measured.stamp = stamp;
    T = predicted(stamp, T);
    T.translation().z() = 0.004 * n;
    measured.T_odom_camera = T;
    measured.covariance(0, 0) = model_.covariance(stamp, clock_, motion())(0, 0);
    measured.has_open_directions = true;
    measured.open_projector(0, 0) = 1.0;
    model_.add(measured, clock_, motion());
  }
  EXPECT_NEAR(T.translation().x(), 0.01 * (9.0 + 15.0), 0.0101);
  const Matrix6 covariance = model_.covariance(100.0 + 60 * kPeriod, clock_, motion());
  EXPECT_GT(covariance(0, 0), 100.0 * known);
  EXPECT_LT(covariance(2, 2), 4.0 * known);
  // It becomes observable again, and the prediction certain.
  for (int n = 60; n < 63; ++n) feed(n);
  EXPECT_LT(model_.covariance(stamp_ + kPeriod, clock_, motion())(0, 0), 4.0 * known);
}

TEST_F(MotionModelTest, JitterOfTheStampsIsNoMotion) {
  testing::Random random(1);
  for (int n = 0; n < 20; ++n) feed(n, random.uniform(-0.2, 0.2) * kPeriod);
  for (const double jitter : {-0.25, 0.0, 0.25}) {
    expectPrediction(100.0 + (20.0 + jitter) * kPeriod, 20.0);
  }
}

TEST_F(MotionModelTest, DroppedFramesAreCounted) {
  for (int n = 0; n < 10; ++n) feed(n);
  expectPrediction(100.0 + 12.0 * kPeriod, 12.0);
  feed(12);  // two frames were missing: this is the motion of three periods
  expectPrediction(100.0 + 13.0 * kPeriod, 13.0);
  expectPrediction(100.0 + 15.1 * kPeriod, 15.0);
}

TEST_F(MotionModelTest, AFrameIsAtLeastOnePeriodLater) {
  for (int n = 0; n < 5; ++n) feed(n);
  expectPrediction(stamp_ + 0.2 * kPeriod, 5.0);
}

TEST_F(MotionModelTest, TheGivenPeriodWinsOverTheMeasuredOne) {
  parameters_.motion.frame_period = 2.0 * kPeriod;
  for (int n = 0; n < 20; n += 2) feed(n);
  EXPECT_EQ(clock_.period(motion()), 2.0 * kPeriod);
  expectPrediction(stamp_ + 2.0 * kPeriod, 20.0);
}

TEST_F(MotionModelTest, ThePeriodIsTheMedianOfTheIntervals) {
  EXPECT_EQ(clock_.period(motion()), 0.0);
  for (int n : {0, 1, 2, 3, 9, 10, 11}) feed(n);
  EXPECT_NEAR(clock_.period(motion()), kPeriod, 1e-9);
}

TEST_F(MotionModelTest, ThePeriodFollowsAChangeOfTheCamera) {
  for (int n = 0; n < 60; ++n) feed(n);
  for (int n = 60; n < 160; n += 2) feed(n);
  EXPECT_NEAR(clock_.period(motion()), 2.0 * kPeriod, 1e-9);
}

TEST_F(MotionModelTest, StampsWithoutPosesTellThePeriodToo) {
  for (int n = 0; n < 10; ++n) clock_.add(100.0 + n * kPeriod);
  EXPECT_NEAR(clock_.period(motion()), kPeriod, 1e-9);
}

TEST_F(MotionModelTest, VelocityIsPerSecondInTheAxesOfTheCamera) {
  for (int n = 0; n < 5; ++n) feed(n);
  EXPECT_LT((model_.velocity(clock_, motion()) - 30.0 * twist_).norm(), 1e-6);
  feed(8);
  EXPECT_LT((model_.velocity(clock_, motion()) - 30.0 * twist_).norm(), 1e-6);
}

TEST_F(MotionModelTest, ConstantPoseDoesNotMove) {
  parameters_.motion.motion_model = MotionModelKind::kConstantPose;
  for (int n = 0; n < 5; ++n) feed(n);
  EXPECT_EQ(predicted(stamp_ + kPeriod, last_).matrix(), last_.matrix());
}

TEST_F(MotionModelTest, StoppingForgetsTheVelocityButNotThePeriod) {
  for (int n = 0; n < 5; ++n) feed(n);
  model_.stop();
  EXPECT_EQ(predicted(stamp_ + kPeriod, last_).matrix(), last_.matrix());
  EXPECT_EQ(model_.velocity(clock_, motion()), Vector6::Zero());
  EXPECT_NEAR(clock_.period(motion()), kPeriod, 1e-9);
}

TEST_F(MotionModelTest, AnotherWorldMovesThePredictionWithIt) {
  for (int n = 0; n < 5; ++n) feed(n);
  const Eigen::Isometry3d T_new_old = testing::Random(8).pose(5.0, 2.0);
  const Vector6 before = model_.velocity(clock_, motion());
  const Eigen::Isometry3d expected = T_new_old * pose(5);
  model_.transform(T_new_old);
  const Eigen::Isometry3d there = predicted(stamp_ + kPeriod, T_new_old * last_);
  EXPECT_LT((there.matrix() - expected.matrix()).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_LT((model_.velocity(clock_, motion()) - before).norm(), 1e-9);
}

}  // namespace
}  // namespace mivo
