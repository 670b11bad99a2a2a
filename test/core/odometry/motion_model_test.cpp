// SPDX-License-Identifier: BSD-3-Clause
#include "core/odometry/motion_model.h"

#include <gtest/gtest.h>

#include "support/random_pose.h"

namespace mivo {
namespace {

constexpr double kPeriod = 1.0 / 30.0;

class MotionModelTest : public ::testing::Test {
 protected:
  /// Pose at frame n of a screw motion that turns by `twist_` with each frame.
  Eigen::Isometry3d pose(double n) const { return start_ * expSe3(n * twist_); }

  /// Feeds frame n at its stamp, off by `jitter` seconds.
  void feed(int n, double jitter = 0.0) {
    stamp_ = 100.0 + n * kPeriod + jitter;
    model_.addStamp(stamp_);
    model_.add(stamp_, pose(n));
    last_ = pose(n);
  }

  void expectPrediction(double stamp, double n, double tolerance = 1e-9) {
    const Eigen::Isometry3d predicted = model_.predict(stamp, last_, parameters_);
    EXPECT_LT((predicted.matrix() - pose(n).matrix()).cwiseAbs().maxCoeff(), tolerance);
  }

  Vector6 twist_ = (Vector6() << 0.01, -0.02, 0.03, 0.02, 0.01, -0.03).finished();
  Eigen::Isometry3d start_ = testing::Random(3).pose(1.0, 1.0);
  Eigen::Isometry3d last_ = Eigen::Isometry3d::Identity();
  MotionModel model_;
  Parameters parameters_;
  double stamp_ = 0.0;
};

TEST_F(MotionModelTest, WithoutTwoPosesTheLastOneIsThePrediction) {
  expectPrediction(100.0, 0.0, 10.0);
  EXPECT_EQ(model_.predict(1.0, pose(7), parameters_).matrix(), pose(7).matrix());
  feed(0);
  EXPECT_EQ(model_.predict(101.0, last_, parameters_).matrix(), pose(0).matrix());
  EXPECT_EQ(model_.velocity(parameters_), Vector6::Zero());
}

TEST_F(MotionModelTest, AScrewIsContinued) {
  for (int n = 0; n < 4; ++n) feed(n);
  expectPrediction(stamp_ + kPeriod, 4.0);
}

TEST_F(MotionModelTest, ThePredictionErrsByWhatTheCameraMayAccelerate) {
  Parameters parameters = parameters_;
  parameters.motion.expected_acceleration = 3.0;
  parameters.motion.expected_turn_acceleration = 20.0;
  parameters.motion.frame_period = 0.1;
  EXPECT_EQ(model_.uncertainty(0.1, parameters).translation, 0.0);  // no velocity is known yet
  model_.add(0.0, Eigen::Isometry3d::Identity());
  model_.add(0.1, Eigen::Isometry3d::Identity());
  EXPECT_NEAR(model_.uncertainty(0.2, parameters).translation, 0.03, 1e-12);
  EXPECT_NEAR(model_.uncertainty(0.2, parameters).rotation, 0.2, 1e-12);
  EXPECT_NEAR(model_.uncertainty(0.4, parameters).translation, 9.0 * 0.03, 1e-12);
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
  feed(12);  // two frames were missing: the motion since is that of three
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
  EXPECT_EQ(model_.period(parameters_), 2.0 * kPeriod);
  expectPrediction(stamp_ + 2.0 * kPeriod, 20.0);
}

TEST_F(MotionModelTest, ThePeriodIsTheMedianOfTheIntervals) {
  EXPECT_EQ(model_.period(parameters_), 0.0);
  for (int n : {0, 1, 2, 3, 9, 10, 11}) feed(n);
  EXPECT_NEAR(model_.period(parameters_), kPeriod, 1e-9);
}

TEST_F(MotionModelTest, ThePeriodFollowsAChangeOfTheCamera) {
  for (int n = 0; n < 60; ++n) feed(n);
  for (int n = 60; n < 160; n += 2) feed(n);
  EXPECT_NEAR(model_.period(parameters_), 2.0 * kPeriod, 1e-9);
}

TEST_F(MotionModelTest, StampsWithoutPosesTellThePeriodToo) {
  for (int n = 0; n < 10; ++n) model_.addStamp(100.0 + n * kPeriod);
  EXPECT_NEAR(model_.period(parameters_), kPeriod, 1e-9);
}

TEST_F(MotionModelTest, VelocityIsPerSecondInTheAxesOfTheCamera) {
  for (int n = 0; n < 5; ++n) feed(n);
  EXPECT_LT((model_.velocity(parameters_) - 30.0 * twist_).norm(), 1e-6);
  feed(8);
  EXPECT_LT((model_.velocity(parameters_) - 30.0 * twist_).norm(), 1e-6);
}

TEST_F(MotionModelTest, ConstantPoseDoesNotMove) {
  parameters_.motion.motion_model = MotionModelKind::kConstantPose;
  for (int n = 0; n < 5; ++n) feed(n);
  EXPECT_EQ(model_.predict(stamp_ + kPeriod, last_, parameters_).matrix(), last_.matrix());
}

TEST_F(MotionModelTest, StoppingForgetsTheVelocityButNotThePeriod) {
  for (int n = 0; n < 5; ++n) feed(n);
  model_.stop();
  EXPECT_EQ(model_.predict(stamp_ + kPeriod, last_, parameters_).matrix(), last_.matrix());
  EXPECT_EQ(model_.velocity(parameters_), Vector6::Zero());
  EXPECT_NEAR(model_.period(parameters_), kPeriod, 1e-9);
}

TEST_F(MotionModelTest, AnotherWorldMovesThePredictionWithIt) {
  for (int n = 0; n < 5; ++n) feed(n);
  const Eigen::Isometry3d T_new_old = testing::Random(8).pose(5.0, 2.0);
  const Vector6 before = model_.velocity(parameters_);
  const Eigen::Isometry3d expected = T_new_old * pose(5);
  model_.transform(T_new_old);
  const Eigen::Isometry3d predicted =
      model_.predict(stamp_ + kPeriod, T_new_old * last_, parameters_);
  EXPECT_LT((predicted.matrix() - expected.matrix()).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_LT((model_.velocity(parameters_) - before).norm(), 1e-9);
}

}  // namespace
}  // namespace mivo
