// SPDX-License-Identifier: BSD-3-Clause
#include "core/shutter/readout_estimator.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "support/analytic_points.h"
#include "support/random_pose.h"

namespace mivo {
namespace {

using testing::Random;

class MeasureReadoutTest : public ::testing::Test {
 protected:
  MeasureReadoutTest() {
    velocities_.live = (Vector6() << 0.01, 0.02, -0.01, 0.03, 0.06, -0.02).finished();
    velocities_.keyframe = (Vector6() << -0.01, 0.01, 0.02, -0.02, 0.04, 0.05).finished();
    velocities_.T_live_ref = Random(1).pose(0.1, 0.1);
    for (std::size_t i = 0; i < points_.size(); ++i) {
      rows_.push_back(static_cast<float>(random_.uniform(0.0, kHeight)));
    }
  }

  /// First-order residuals of a pose error d and an error `readout` of the read-out time: when a
  /// point moves by m, its intensity in the keyframe changes by J m.
  Residuals residualsOf(const Vector6& d, double readout) const {
    Residuals residuals;
    const Eigen::Matrix3d R = velocities_.T_live_ref.linear();
    const Eigen::Vector3d t = velocities_.T_live_ref.translation();
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const Eigen::Vector3d X = testing::pointAt(points_, i);
      const Eigen::Vector3d q = R * X + t;
      const double tau_live = static_cast<double>(rows_[i]) / kHeight - 0.5;
      const double tau_keyframe = points_.pixels[i].y / kHeight - 0.5;
      // The neglected motion: of the live point until its row is read, and of the keyframe's.
      const Eigen::Vector3d live =
          tau_live * (velocities_.live.tail<3>().cross(q) + velocities_.live.head<3>());
      const Eigen::Vector3d keyframe =
          tau_keyframe * (velocities_.keyframe.tail<3>().cross(X) + velocities_.keyframe.head<3>());
      const Eigen::Vector3d motion = keyframe - R.transpose() * live;
      const Eigen::Vector3d gradient(static_cast<double>(points_.jacobian[0][i]),
                                     static_cast<double>(points_.jacobian[1][i]),
                                     static_cast<double>(points_.jacobian[2][i]));
      double value = readout * gradient.dot(motion);
      for (std::size_t k = 0; k < 6; ++k) {
        value += static_cast<double>(points_.jacobian[k][i]) * d[static_cast<int>(k)];
      }
      residuals.value.push_back(static_cast<float>(value));
      residuals.visible.push_back(1.0F);
    }
    residuals.num_visible = points_.size();
    return residuals;
  }

  ReadoutMeasurement measure(const Residuals& residuals, double scale = 50.0) const {
    return measureReadout(points_, residuals, rows_, kHeight, scale, velocities_);
  }

  static constexpr double kHeight = 80.0;
  Random random_{2};
  ReferencePoints points_ = testing::analyticPoints(testing::waves(), testing::analyticCamera(), 3);
  std::vector<float> rows_;
  RowVelocities velocities_;
};

TEST_F(MeasureReadoutTest, TheMissingReadoutIsFoundBesideAWrongPose) {
  for (const double readout : {-0.3, 0.0, 0.2, 0.6}) {
    for (const double length : {0.0, 0.003}) {
      const Vector6 d = Random(3).increment(length, length);
      const ReadoutMeasurement measurement = measure(residualsOf(d, readout));
      EXPECT_NEAR(measurement.correction, readout, 0.01) << length;
      EXPECT_GT(measurement.information, 0.0);
    }
  }
}

TEST_F(MeasureReadoutTest, InformationIsInverseVariance) {
  const Residuals residuals = residualsOf(Vector6::Zero(), 0.1);
  EXPECT_NEAR(measure(residuals, 100.0).information / measure(residuals, 200.0).information, 4.0,
              0.05);
}

TEST_F(MeasureReadoutTest, ACameraAtRestSaysNothing) {
  velocities_.live.setZero();
  velocities_.keyframe.setZero();
  const ReadoutMeasurement measurement = measure(residualsOf(Random(4).increment(0.01, 0.01), 0.3));
  EXPECT_EQ(measurement.information, 0.0);
  EXPECT_EQ(measurement.correction, 0.0);
}

TEST_F(MeasureReadoutTest, NothingInViewSaysNothing) {
  Residuals residuals = residualsOf(Vector6::Zero(), 0.3);
  std::fill(residuals.visible.begin(), residuals.visible.end(), 0.0F);
  residuals.num_visible = 0;
  EXPECT_EQ(measure(residuals).information, 0.0);
}

class ReadoutEstimatorTest : public ::testing::Test {
 protected:
  /// A keyframe all of whose frames measure the same correction.
  void keyframe(double correction, int frames = 10, double information = 400.0) {
    for (int i = 0; i < frames; ++i) estimator_.add({correction, information});
    estimator_.endKeyframe();
  }

  ReadoutEstimator estimator_;
};

TEST_F(ReadoutEstimatorTest, AGlobalShutterStaysOne) {
  Random random(5);
  for (int i = 0; i < 200; ++i) keyframe(random.uniform(-0.05, 0.05));
  EXPECT_EQ(estimator_.readout(), 0.0);
}

TEST_F(ReadoutEstimatorTest, OneKeyframeIsNotEnough) {
  keyframe(0.15);
  EXPECT_EQ(estimator_.readout(), 0.0);
  keyframe(0.0);
  keyframe(0.15);
  EXPECT_EQ(estimator_.readout(), 0.0);
}

TEST_F(ReadoutEstimatorTest, TwoKeyframesInARowSwitchItOn) {
  keyframe(0.17);
  keyframe(0.17);
  EXPECT_GT(estimator_.readout(), 0.3);
}

// Depth of another time: little by most keyframes, much by two that show little.
TEST_F(ReadoutEstimatorTest, TwoKeyframesThatShowLittleDoNotOutvoteTheOthers) {
  for (int i = 0; i < 3; ++i) keyframe(0.04, 10, 430.0);
  keyframe(0.16, 10, 150.0);
  keyframe(0.2, 10, 110.0);
  EXPECT_EQ(estimator_.readout(), 0.0);
  for (int i = 0; i < 4; ++i) keyframe(0.2, 10, 430.0);
  EXPECT_GT(estimator_.readout(), 0.3);
}

// The effect of moving shadows: they suggest a long read-out time, and the opposite once it is
// used.
TEST_F(ReadoutEstimatorTest, WhatTheNextKeyframesContradictIsRevokedAndNotBelievedAgainSoon) {
  keyframe(0.17);
  keyframe(0.17);
  ASSERT_GT(estimator_.readout(), 0.3);
  keyframe(-0.4);
  EXPECT_EQ(estimator_.readout(), 0.0);
  for (int i = 0; i < 10; ++i) keyframe(0.17);
  EXPECT_EQ(estimator_.readout(), 0.0);
  keyframe(0.4);
  keyframe(0.4);
  EXPECT_GT(estimator_.readout(), 0.3);
}

TEST_F(ReadoutEstimatorTest, ItOnlyChangesWithAKeyframe) {
  keyframe(0.17);
  keyframe(0.17);
  const double before = estimator_.readout();
  for (int i = 0; i < 50; ++i) estimator_.add({0.2, 400.0});
  EXPECT_EQ(estimator_.readout(), before);
  estimator_.endKeyframe();
  EXPECT_GT(estimator_.readout(), before);
}

// Each correction is too small by the same factor, since the pose absorbs most of the effect.
TEST_F(ReadoutEstimatorTest, ItSettlesAtTheTruth) {
  for (const double truth : {0.65, 0.7, 0.75}) {
    estimator_ = ReadoutEstimator();
    for (int i = 0; i < 60; ++i) keyframe(0.25 * (truth - estimator_.readout()));
    EXPECT_NEAR(estimator_.readout(), truth, 0.06) << truth;
  }
}

TEST_F(ReadoutEstimatorTest, KeyframesWithoutInformationDoNotCount) {
  for (int i = 0; i < 20; ++i) keyframe(0.3, 2, 10.0);
  EXPECT_EQ(estimator_.readout(), 0.0);
}

TEST_F(ReadoutEstimatorTest, ItStaysBetweenNothingAndTheWholePeriod) {
  for (int i = 0; i < 50; ++i) keyframe(0.5);
  EXPECT_LE(estimator_.readout(), 1.0);
  EXPECT_GT(estimator_.readout(), 0.8);
  for (int i = 0; i < 200; ++i) keyframe(-0.5);
  EXPECT_EQ(estimator_.readout(), 0.0);
}

}  // namespace
}  // namespace mivo
