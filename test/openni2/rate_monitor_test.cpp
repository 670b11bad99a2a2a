// SPDX-License-Identifier: BSD-3-Clause
#include "openni2/rate_monitor.h"

#include <gtest/gtest.h>

namespace mivo {
namespace {

TEST(RateMonitorTest, RateIsKnownAfterThreeSeconds) {
  RateMonitor monitor;
  for (int i = 0; i < 80; ++i) {
    monitor.add(static_cast<std::uint64_t>(i) * 1000000 / 30, i);
  }
  EXPECT_EQ(monitor.rate(), 0.0);
  for (int i = 80; i < 100; ++i) {
    monitor.add(static_cast<std::uint64_t>(i) * 1000000 / 30, i);
  }
  EXPECT_NEAR(monitor.rate(), 30.0, 0.01);
  EXPECT_EQ(monitor.frames(), 100);
  EXPECT_EQ(monitor.dropped(), 0);
}

TEST(RateMonitorTest, GapsAreCountedAndLowerTheRate) {
  RateMonitor monitor;
  for (int i = 0; i < 300; i += 2) {
    monitor.add(static_cast<std::uint64_t>(i) * 1000000 / 30, i);
  }
  EXPECT_NEAR(monitor.rate(), 15.0, 0.01);
  EXPECT_EQ(monitor.frames(), 150);
  EXPECT_EQ(monitor.dropped(), 149);
}

TEST(RateMonitorTest, RestartForgetsTheRateAndKeepsTheCounts) {
  RateMonitor monitor;
  for (int i = 0; i < 120; ++i) {
    monitor.add(static_cast<std::uint64_t>(i) * 1000000 / 30, i);
  }
  monitor.restart();
  EXPECT_EQ(monitor.rate(), 0.0);
  monitor.add(0, 500);  // numbers and clock of another start: no gap
  EXPECT_EQ(monitor.dropped(), 0);
  EXPECT_EQ(monitor.frames(), 121);
}

}  // namespace
}  // namespace mivo
