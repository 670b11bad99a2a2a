// SPDX-License-Identifier: BSD-3-Clause
#include "session/clock_offset.h"

#include <gtest/gtest.h>

namespace mivo {
namespace {

/// Images at 30 Hz that arrive 20 ms after exposure; the stamps of depth are later by an offset.
ClockOffset cameraWith(double offset, double playing_rate = 1.0, double depth_latency = 0.02) {
  ClockOffset clocks;
  for (int i = 0; i < 30; ++i) {
    const double taken = 1e9 + i / 30.0;
    const auto arrival = [&](double latency) { return 5e8 + (i / 30.0 + latency) / playing_rate; };
    clocks.add(ImageStream::kColor, taken, arrival(0.02));
    clocks.add(ImageStream::kDepth, taken + offset, arrival(depth_latency));
  }
  return clocks;
}

TEST(ClockOffsetTest, IsWhatDepthIsStampedLater) {
  EXPECT_NEAR(cameraWith(0.0).seconds().value(), 0.0, 1e-6);
  EXPECT_NEAR(cameraWith(0.7).seconds().value(), 0.7, 1e-6);
  EXPECT_NEAR(cameraWith(-0.7).seconds().value(), -0.7, 1e-6);
  // A longer transmission looks like a slow clock.
  EXPECT_NEAR(cameraWith(0.0, 1.0, 0.08).seconds().value(), -0.06, 1e-6);
}

TEST(ClockOffsetTest, NothingIsToldOfTooFewImagesOrOfAnotherPace) {
  EXPECT_FALSE(ClockOffset().seconds());
  EXPECT_FALSE(cameraWith(0.7, 3.0).seconds());
  EXPECT_FALSE(cameraWith(0.7, 0.3).seconds());
}

TEST(ClockOffsetTest, HalfASecondIsNoWayOfMessages) {
  EXPECT_TRUE(ClockOffset::isBelievable(0.3));
  EXPECT_TRUE(ClockOffset::isBelievable(-0.3));
  EXPECT_FALSE(ClockOffset::isBelievable(0.7));
  EXPECT_FALSE(ClockOffset::isBelievable(-0.7));
}

}  // namespace
}  // namespace mivo
