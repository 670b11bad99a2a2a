// SPDX-License-Identifier: BSD-3-Clause
#include "core/odometry/judgment.h"

#include <gtest/gtest.h>

#include <limits>

namespace mivo {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// An alignment without any sign of failure.
Alignment goodAlignment() {
  Alignment alignment;
  alignment.points = 5000;
  alignment.overlap = 0.9;
  alignment.sees_image = true;
  alignment.sees_depth = true;
  alignment.correlation = 0.9;
  return alignment;
}

class JudgmentTest : public ::testing::Test {
 protected:
  TrackingReason reason() const { return judge(alignment_, parameters_); }

  LossParameters parameters_;
  Alignment alignment_ = goodAlignment();
};

TEST_F(JudgmentTest, NothingSpeaksAgainstAGoodOne) {
  EXPECT_EQ(reason(), TrackingReason::kNone);
  EXPECT_TRUE(isConvincing(alignment_, parameters_));
  EXPECT_EQ(qualityOf(alignment_, false).state, TrackingState::kTracking);
  EXPECT_EQ(qualityOf(alignment_, false).reason, TrackingReason::kNone);
  EXPECT_EQ(qualityOf(alignment_, true).state, TrackingState::kDegraded);
  EXPECT_EQ(qualityOf(alignment_, true).reason, TrackingReason::kAmbiguous);
}

TEST_F(JudgmentTest, EachLimitHasItsReason) {
  alignment_.T_live_ref.translation().x() = kNan;
  EXPECT_EQ(reason(), TrackingReason::kNotFinite);
  alignment_ = goodAlignment();
  alignment_.hessian(2, 2) = kNan;
  EXPECT_EQ(reason(), TrackingReason::kNotFinite);
  alignment_ = goodAlignment();
  alignment_.overlap = parameters_.lost_overlap - 0.01;
  EXPECT_EQ(reason(), TrackingReason::kNoOverlap);
  alignment_ = goodAlignment();
  alignment_.points = parameters_.lost_points - 1;
  EXPECT_EQ(reason(), TrackingReason::kTooFewPoints);
  alignment_ = goodAlignment();
  alignment_.covariance(0, 0) = kNan;
  EXPECT_EQ(reason(), TrackingReason::kNotFinite);
}

TEST_F(JudgmentTest, DepthAloneCountsOnlyInTheDark) {
  alignment_.sees_image = false;
  EXPECT_EQ(reason(), TrackingReason::kNothingInCommon);
  for (bool* dark : {&alignment_.is_live_dark, &alignment_.is_keyframe_dark}) {
    *dark = true;
    EXPECT_EQ(reason(), TrackingReason::kNone);
    EXPECT_FALSE(isConvincing(alignment_, parameters_));
    EXPECT_EQ(qualityOf(alignment_, false).state, TrackingState::kDegraded);
    EXPECT_EQ(qualityOf(alignment_, false).reason, TrackingReason::kNothingInCommon);
    alignment_.sees_depth = false;
    EXPECT_EQ(reason(), TrackingReason::kNothingInCommon);
    alignment_.sees_depth = true;
    *dark = false;
  }
}

TEST_F(JudgmentTest, AnOpenDirectionDegrades) {
  alignment_.has_open_directions = true;
  EXPECT_EQ(reason(), TrackingReason::kNone);
  EXPECT_EQ(qualityOf(alignment_, false).state, TrackingState::kDegraded);
  EXPECT_EQ(qualityOf(alignment_, false).reason, TrackingReason::kOpenDirections);
}

TEST_F(JudgmentTest, AWeakCorrelationConvincesNobody) {
  alignment_.correlation = parameters_.retry_correlation - 0.01;
  EXPECT_FALSE(isConvincing(alignment_, parameters_));
}

TEST_F(JudgmentTest, MotionIsHeldAgainstTheTimeItTook) {
  parameters_.lost_speed = 2.0;
  parameters_.lost_turn_rate = 4.0;
  const Vector6 fast = 0.1 * Vector6::Unit(0) + 0.1 * Vector6::Unit(4);
  EXPECT_EQ(judgeMotion(fast, 0.06, parameters_), TrackingReason::kNone);
  EXPECT_EQ(judgeMotion(fast, 0.04, parameters_), TrackingReason::kImplausibleMotion);
  const Vector6 turn = 0.1 * Vector6::Unit(4);
  EXPECT_EQ(judgeMotion(turn, 0.03, parameters_), TrackingReason::kNone);
  EXPECT_EQ(judgeMotion(turn, 0.02, parameters_), TrackingReason::kImplausibleMotion);
}

}  // namespace
}  // namespace mivo
