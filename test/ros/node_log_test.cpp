// SPDX-License-Identifier: BSD-3-Clause
// The node's log messages and their rate: states, and frames without a pose.
#include <gtest/gtest.h>

#include "ros/skipped_frames.h"
#include "ros/state_log.h"

namespace mivo {
namespace {

ros::WallTime at(double seconds) {
  return ros::WallTime(1000.0 + seconds);
}

TrackingResult degraded(int open_direction) {
  TrackingResult result;
  result.state = TrackingState::kDegraded;
  result.reason = TrackingReason::kOpenDirections;
  result.open_directions[static_cast<std::size_t>(open_direction)] = true;
  return result;
}

TEST(StateLogTest, TellsEachChangeOfTheState) {
  StateLog log;
  TrackingResult result;
  result.reason = TrackingReason::kTooFewPoints;  // why there is no first pose
  EXPECT_TRUE(log.add(result, at(0.0)));
  result.state = TrackingState::kTracking;
  result.reason = TrackingReason::kNone;
  EXPECT_TRUE(log.add(result, at(0.1)));
  EXPECT_FALSE(log.add(result, at(100.0)));
  result.state = TrackingState::kLost;
  result.reason = TrackingReason::kNoOverlap;
  EXPECT_TRUE(log.add(result, at(100.1)));
  result.state = TrackingState::kTracking;
  result.reason = TrackingReason::kNone;
  EXPECT_TRUE(log.add(result, at(100.2)));
}

TEST(StateLogTest, TellsOtherDirectionsThoughNotAllTheTime) {
  StateLog log;
  EXPECT_TRUE(log.add(degraded(0), at(0.0)));
  EXPECT_FALSE(log.add(degraded(1), at(1.0)));  // too early
  EXPECT_FALSE(log.add(degraded(0), at(6.0)));  // already logged
  EXPECT_TRUE(log.add(degraded(1), at(7.0)));
  EXPECT_FALSE(log.add(degraded(1), at(20.0)));
}

TEST(SkippedFramesTest, CountsByReasonAndTellsEachOnceAMinute) {
  SkippedFrames frames;
  EXPECT_TRUE(frames.add("late", at(0.0)));
  EXPECT_FALSE(frames.add("late", at(1.0)));
  EXPECT_TRUE(frames.add("broken", at(2.0)));  // each reason has its own rate
  EXPECT_TRUE(frames.add("late", at(61.0)));
  const SkipCounts counts = frames.counts();
  EXPECT_EQ(4U, counts.total);
  EXPECT_EQ("late", counts.last_reason);
  EXPECT_EQ(3U, counts.by_reason.at("late"));
  EXPECT_EQ(1U, counts.by_reason.at("broken"));
}

TEST(SkippedFramesTest, ReasonsWithoutEndTakeNoMemoryWithoutEnd) {
  SkippedFrames frames;
  for (int i = 0; i < 1000; ++i) frames.add("number " + std::to_string(i), at(i * 1e-3));
  const SkipCounts counts = frames.counts();
  EXPECT_EQ(1000U, counts.total);
  EXPECT_LT(counts.by_reason.size(), 30U);
  EXPECT_EQ("number 999", counts.last_reason);
  EXPECT_EQ(980U, counts.by_reason.at("other reasons"));
}

}  // namespace
}  // namespace mivo
