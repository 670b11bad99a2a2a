// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <memory>
#include <opencv2/core.hpp>

#include "mivo/core/odometry.h"
#include "support/camera_path.h"
#include "support/heap_counter.h"

namespace mivo {
namespace {

using testing::kFramePeriod;
using testing::numAllocations;

TEST(HeapCounterTest, CountsWhatIsAllocated) {
  std::size_t before = numAllocations();
  const auto number = std::make_unique<int>(1);
  EXPECT_EQ(numAllocations(), before + 1);
  before = numAllocations();
  const cv::Mat image(48, 64, CV_8UC1, cv::Scalar(0));
  EXPECT_GT(numAllocations(), before);
  before = numAllocations();
  const cv::Mat same = image;
  EXPECT_EQ(numAllocations(), before);
}

/// Tracks the frames forwards and backwards `walks` times; returns the number of allocations during
/// the last time.
std::size_t allocationsOfLastWalk(const testing::Recording& recording, const Parameters& parameters,
                                  int walks, int& keyframes) {
  Odometry odometry(recording.camera, parameters);
  const auto n = static_cast<int>(recording.frames.size());
  std::size_t allocations = 0;
  double stamp = 0.0;
  for (int walk = 0; walk < walks; ++walk) {
    allocations = 0;
    const int before = odometry.result().keyframes;
    for (int step = 0; step < 2 * n - 2; ++step) {
      Frame frame = recording.frames[static_cast<std::size_t>(step < n ? step : 2 * n - 2 - step)];
      frame.stamp = (stamp += kFramePeriod);
      const std::size_t start = numAllocations();
      const TrackingResult& result = odometry.process(frame);
      allocations += numAllocations() - start;
      EXPECT_EQ(result.state, TrackingState::kTracking) << "walk " << walk << ", step " << step;
    }
    keyframes = odometry.result().keyframes - before;
  }
  return allocations;
}

// Buffers grow during the first frames and keyframes, each kept keyframe to its own size;
// afterwards they are reused.
TEST(AllocationTest, AFrameAllocatesNothingOnceTheBuffersHaveGrown) {
  const testing::Recording recording = testing::recordWalk(15);
  for (const Method method : {Method::kHybrid, Method::kMi, Method::kSsd}) {
    for (const PhotometricModel model : {PhotometricModel::kLcn, PhotometricModel::kNone}) {
      Parameters parameters;
      parameters.alignment.method = method;
      parameters.alignment.photometric_model = model;
      parameters.keyframes.keyframe_translation = 0.02;
      parameters.shutter.depth_time_offset_estimation = true;
      int keyframes = 0;
      EXPECT_EQ(allocationsOfLastWalk(recording, parameters, 60, keyframes), 0U)
          << "method " << static_cast<int>(method) << ", model " << static_cast<int>(model);
      EXPECT_GE(keyframes, 2) << "keyframes are to be among the frames";
    }
  }
}

}  // namespace
}  // namespace mivo
