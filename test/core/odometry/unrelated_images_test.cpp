// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "mivo/core/odometry.h"
#include "support/camera_path.h"
#include "support/random_pose.h"

// No method may accept an alignment of images that have nothing in common.

namespace mivo {
namespace {

constexpr int kFrames = 20;

struct Case {
  Method method;
  int bins;
};

Camera noiseCamera() {
  Camera camera;
  camera.width = 320;
  camera.height = 240;
  camera.fx = camera.fy = 262.0;
  camera.cx = 160.0;
  camera.cy = 120.0;
  return camera;
}

/// A different wall for each index, two meters away.
Frame noise(int index) {
  const Camera camera = noiseCamera();
  testing::Random random(static_cast<std::uint64_t>(index) + 1);
  Frame frame;
  frame.stamp = 10.0 + testing::kFramePeriod * index;
  frame.image.create(camera.height, camera.width, CV_8UC1);
  for (int y = 0; y < camera.height; ++y) {
    for (int x = 0; x < camera.width; ++x) {
      frame.image.at<unsigned char>(y, x) = static_cast<unsigned char>(random.uniform(0.0, 256.0));
    }
  }
  frame.depth = cv::Mat(camera.height, camera.width, CV_32FC1, cv::Scalar(2.0F));
  return frame;
}

class UnrelatedImagesTest : public ::testing::TestWithParam<Case> {};

TEST_P(UnrelatedImagesTest, EveryOneIsLost) {
  Parameters parameters;
  parameters.alignment.method = GetParam().method;
  parameters.mi.mi_bins = GetParam().bins;
  Odometry odometry(noiseCamera(), parameters);
  EXPECT_EQ(odometry.process(noise(0)).state, TrackingState::kTracking);
  for (int i = 1; i < kFrames; ++i) {
    EXPECT_EQ(odometry.process(noise(i)).state, TrackingState::kLost) << i;
  }
}

std::string nameOf(const ::testing::TestParamInfo<Case>& tested) {
  const char* const names[] = {"Ssd", "Mi", "Hybrid"};
  return names[static_cast<int>(tested.param.method)] + std::to_string(tested.param.bins) + "Bins";
}

INSTANTIATE_TEST_SUITE_P(MethodsAndBins, UnrelatedImagesTest,
                         ::testing::Values(Case{Method::kMi, 8}, Case{Method::kMi, 32},
                                           Case{Method::kMi, 64}, Case{Method::kHybrid, 8},
                                           Case{Method::kSsd, 8}),
                         nameOf);

}  // namespace
}  // namespace mivo
