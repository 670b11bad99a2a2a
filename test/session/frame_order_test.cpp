// SPDX-License-Identifier: BSD-3-Clause
#include "session/frame_order.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace mivo {
namespace {

/// The decisions on frames as text: their numbers, with "|" before the first frame of a new time,
/// late frames in brackets, outliers in braces and unset stamps in square brackets.
std::string fateOf(const std::vector<double>& stamps) {
  std::string text;
  FrameOrder<int> order(
      [&](int& i, bool is_new_time) {
        text += (is_new_time ? "| " : "") + std::to_string(i) + ' ';
      },
      [&](int& i, StampFault fault) {
        const std::string marks = fault == StampFault::kLate     ? "()"
                                  : fault == StampFault::kAstray ? "{}"
                                                                 : "[]";
        text += marks[0] + std::to_string(i) + marks[1] + ' ';
      });
  for (std::size_t i = 0; i < stamps.size(); ++i) order.push(stamps[i], static_cast<int>(i));
  order.flush();
  return text;
}

TEST(FrameOrderTest, NewerFramesGoThrough) {
  EXPECT_EQ(fateOf({0.0, 0.03, 0.06, 2.0, 11.9}), "0 1 2 3 4 ");
}

TEST(FrameOrderTest, DoubledAndLateFramesAreDropped) {
  EXPECT_EQ(fateOf({1.0, 1.1, 1.1, 1.05, 1.2}), "0 1 (2) (3) 4 ");
}

TEST(FrameOrderTest, StampsOfZeroAreNoTime) {
  EXPECT_EQ(fateOf({0.0, 0.0, 0.0, 0.0}), "[1] [2] [3] [0] ");
  // The clock is set after the first frames, or after the first one.
  EXPECT_EQ(fateOf({0.0, 0.0, 0.0, 1.6e9, 1.6e9 + 0.03, 1.6e9 + 0.06}), "[1] [2] [0] 3 4 5 ");
  EXPECT_EQ(fateOf({0.0, 1.6e9, 1.6e9 + 0.03}), "[0] 1 2 ");
  EXPECT_EQ(fateOf({1.6e9, 0.0, 1.6e9 + 0.03}), "0 (1) 2 ");
}

TEST(FrameOrderTest, ARecordingMayBeginAtZero) {
  EXPECT_EQ(fateOf({0.0}), "0 ");
  EXPECT_EQ(fateOf({0.0, 1.0, 2.0}), "0 1 2 ");
  EXPECT_EQ(fateOf({0.0, 60.0, 60.1}), "0 1 2 ");
}

TEST(FrameOrderTest, AlternatingClocksGiveTheLaterOne) {
  std::vector<double> stamps;
  std::string expected;
  for (int i = 0; i < 12; ++i) {
    stamps.push_back(100.0 + i / 30.0 - (i % 2 == 1 ? 3.0 : 0.0));
    expected += i % 2 == 1 ? "(" + std::to_string(i) + ") " : std::to_string(i) + ' ';
  }
  EXPECT_EQ(fateOf(stamps), expected);
}

TEST(FrameOrderTest, TimeIsSetBackWhenSeveralAgreeAndOnlyOnce) {
  // A looped bag: four frames are skipped until the jump is confirmed, then one segment begins.
  EXPECT_EQ(fateOf({10.0, 10.1, 10.2, 1.0, 1.1, 1.2, 1.3, 1.4, 1.5, 1.6}),
            "0 1 2 (3) (4) (5) (6) | 7 8 9 ");
}

TEST(FrameOrderTest, LateFramesThatDoNotAgreeNeverSetTimeBack) {
  // Reversed stamps, constant stamps, and stamps further apart than a camera's frames.
  EXPECT_EQ(fateOf({9.0, 8.0, 7.0, 6.0, 5.0, 4.0, 3.0}), "0 (1) (2) (3) (4) (5) (6) ");
  EXPECT_EQ(fateOf({9.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0}), "0 (1) (2) (3) (4) (5) (6) ");
  EXPECT_EQ(fateOf({90.0, 1.0, 11.0, 21.0, 31.0, 41.0, 51.0}), "0 (1) (2) (3) (4) (5) (6) ");
}

TEST(FrameOrderTest, ASingleStampFarAheadIsAstray) {
  EXPECT_EQ(fateOf({1.0, 1.1, 1e6, 1.2, 1.3}), "0 1 {2} 3 4 ");
  EXPECT_EQ(fateOf({1.0, 1.1, 1e6, 1.1, 1.2}), "0 1 (3) {2} 4 ");
}

TEST(FrameOrderTest, PausesAndSlowClocksGoOn) {
  EXPECT_EQ(fateOf({1.0, 61.0, 61.1, 61.2}), "0 1 2 3 ");
  // Milliseconds read as seconds: each frame is far ahead of the previous one.
  EXPECT_EQ(fateOf({0.0, 33333.0, 66666.0, 99999.0}), "0 1 2 3 ");
  EXPECT_EQ(fateOf({1.0, 61.0}), "0 1 ");
}

TEST(FrameOrderTest, AfterARestartAnyStampWillDo) {
  int frames = 0;
  FrameOrder<int> order([&](int&, bool is_new_time) { frames += is_new_time ? 100 : 1; },
                        [](int&, StampFault) { FAIL(); });
  order.push(5.0, 0);
  order.restart();
  order.push(1.0, 1);
  EXPECT_EQ(frames, 2);
}

}  // namespace
}  // namespace mivo
