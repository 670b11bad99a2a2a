// SPDX-License-Identifier: BSD-3-Clause
// A long run with darkness and other places in it. In the suite for a few seconds;
// MIVO_SOAK_FRAMES=100000 is an hour of 30 Hz.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <string>
#include <vector>

#include "mivo/core/odometry.h"
#include "support/camera_path.h"
#include "support/holdings.h"

namespace mivo {
namespace {

using testing::Holdings;
using testing::kFramePeriod;

constexpr int kRound = 500;  // frames between two events, which begin a round
constexpr int kDark = 20;    // frames
constexpr int kElsewhere = 30;
constexpr int kSettled = 2 * kDark + 2 * kElsewhere;

/// Walks there and back; at the beginning of each round the lens is covered, then the camera is
/// somewhere else.
class EndlessRecording {
 public:
  Frame next() {
    const int n = static_cast<int>(walk_.frames.size());
    const int step = number_ % (2 * n - 2);
    const int of_round = frameOfRound();
    Frame frame = walk_.frames[static_cast<std::size_t>(step < n ? step : 2 * n - 2 - step)];
    if (number_ >= kRound && of_round < kDark) {
      frame.image = black_;
    } else if (number_ >= kRound && of_round >= 2 * kDark && of_round < 2 * kDark + kElsewhere) {
      frame = elsewhere_;
    }
    frame.stamp = kFramePeriod * ++number_;
    return frame;
  }

  /// Of the next frame.
  int frameOfRound() const { return number_ % kRound; }
  const Camera& camera() const { return walk_.camera; }

 private:
  testing::Recording walk_ = testing::recordWalk(30);
  cv::Mat black_ = cv::Mat::zeros(walk_.frames[0].image.size(), CV_8UC1);
  Frame elsewhere_ =
      testing::render(testing::roomScene(), walk_.camera,
                      retract((Vector6() << 0.0, 0.0, 0.4, 0.1, 2.9, 0.2).finished()));
  int number_ = 0;
};

/// Median processor time of every tenth frame, milliseconds.
double run(EndlessRecording& recording, Odometry& odometry, int num_frames) {
  std::vector<double> times;
  for (int i = 0; i < num_frames; ++i) {
    const bool is_settled = recording.frameOfRound() >= kSettled;
    const TrackingResult& result = odometry.process(recording.next());
    EXPECT_TRUE(result.T_odom_camera.matrix().allFinite());
    if (is_settled) {
      EXPECT_EQ(result.state, TrackingState::kTracking) << result.stamp;
    }
    if (i % 10 == 0) times.push_back(result.milliseconds.total);
  }
  const auto middle = times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2);
  std::nth_element(times.begin(), middle, times.end());
  return *middle;
}

TEST(SoakTest, ALongRunHoldsNothingMore) {
  const int num_frames = testing::fromEnvironment("MIVO_SOAK_FRAMES", 4 * kRound);
  EndlessRecording recording;
  Odometry odometry(recording.camera(), {});
  // Buffers grow to the size of the largest keyframe there is.
  run(recording, odometry, std::max(3 * kRound, num_frames / 2));
  const Holdings before = testing::holdingsOf(getpid());
  const double first = run(recording, odometry, num_frames / 2);
  const double second = run(recording, odometry, num_frames / 2);
  const Holdings after = testing::holdingsOf(getpid());
  EXPECT_LT(after.resident_mb, before.resident_mb + 1.0);
  EXPECT_EQ(after.threads, before.threads);
  EXPECT_EQ(after.descriptors, before.descriptors);
  RecordProperty("mb_more", std::to_string(after.resident_mb - before.resident_mb));
  RecordProperty("median_ms_first_half", std::to_string(first));
  RecordProperty("median_ms_second_half", std::to_string(second));
}

}  // namespace
}  // namespace mivo
