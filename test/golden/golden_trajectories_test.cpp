// SPDX-License-Identifier: BSD-3-Clause
// What the tracker makes of a fixed sequence must not change unnoticed. The trajectories beside
// this file are of the last release; a change that is meant is recorded by
//   MIVO_WRITE_GOLDEN=1 test_bin/golden_trajectories_test
// and goes into CHANGELOG.rst with the figures that this test prints.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

#include "core/kernels/kernels.h"
#include "mivo/core/odometry.h"
#include "mivo/core/se3.h"
#include "mivo/io/trajectory_io.h"
#include "support/camera_path.h"

namespace mivo {
namespace {

using testing::Recording;

constexpr int kFrames = 30;
// m and rad. Instruction sets round differently: by up to 1e-5 in these sequences.
constexpr double kRounding = 5e-5;

/// So large that the points of a level are several chunks, which threads share.
Camera camera() {
  Camera camera = testing::smallCamera();
  camera.width *= 2;
  camera.height *= 2;
  camera.fx *= 2.0;
  camera.fy *= 2.0;
  camera.cx = 2.0 * camera.cx + 0.5;
  camera.cy = 2.0 * camera.cy + 0.5;
  return camera;
}

/// A room whose light fades and returns, so that gain and normalization are part of it.
const Recording& fadingRoom() {
  static const Recording recording = [] {
    Recording faded = testing::recordWalk(kFrames, camera());
    for (std::size_t i = 0; i < faded.frames.size(); ++i) {
      const double light = 1.0 - 0.5 * std::sin(0.15 * static_cast<double>(i));
      faded.frames[i].image = light * faded.frames[i].image;
    }
    return faded;
  }();
  return recording;
}

struct Case {
  const char* name;
  Method method;
  PhotometricModel model;
};

Parameters parametersOf(const Case& here) {
  Parameters parameters;
  parameters.alignment.method = here.method;
  parameters.alignment.photometric_model = here.model;
  parameters.keyframes.keyframe_translation = 0.04;
  const bool is_of_paper = here.model == PhotometricModel::kNone;
  if (is_of_paper) parameters.motion.motion_model = MotionModelKind::kConstantVelocity;
  return parameters;
}

Trajectory track(const Parameters& parameters) {
  Odometry odometry(fadingRoom().camera, parameters);
  Trajectory poses;
  for (const Frame& frame : fadingRoom().frames) {
    const TrackingResult& result = odometry.process(frame);
    EXPECT_EQ(result.state, TrackingState::kTracking) << frame.stamp;
    poses.push_back({frame.stamp, result.T_odom_camera});
  }
  EXPECT_GT(odometry.result().keyframes, 2) << "keyframes are to be among the frames";
  return poses;
}

double farthest(const Trajectory& a, const Trajectory& b) {
  double largest = 0.0;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
    largest = std::max(largest, localCoordinates(a[i].pose.inverse() * b[i].pose).norm());
  }
  return largest;
}

bool isSameToTheBit(const Trajectory& a, const Trajectory& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& one, const auto& other) {
    return one.pose.matrix() == other.pose.matrix();
  });
}

class GoldenTrajectoriesTest : public ::testing::TestWithParam<Case> {
 protected:
  void TearDown() override { kernels::select("auto"); }
};

TEST_P(GoldenTrajectoriesTest, TheTrajectoryIsThatOfTheLastRelease) {
  const std::string path = std::string(MIVO_GOLDEN) + "/" + GetParam().name + ".txt";
  kernels::select("scalar");
  const Trajectory poses = track(parametersOf(GetParam()));
  if (std::getenv("MIVO_WRITE_GOLDEN") != nullptr) {
    TrajectoryWriter writer(path, Overwrite::kYes);
    for (const StampedPose& pose : poses) writer.write(pose);
  }
  const Trajectory golden = readTrajectory(path);
  ASSERT_EQ(poses.size(), golden.size());
  const double change = farthest(poses, golden);
  RecordProperty("change", std::to_string(change));
  EXPECT_LT(change, kRounding) << "m and rad; see the top of this file if this is meant";
}

TEST_P(GoldenTrajectoriesTest, AnyNumberOfThreadsGivesTheSameBits) {
  Parameters parameters = parametersOf(GetParam());
  const Trajectory one = track(parameters);
  for (const int threads : {2, 3, 8}) {
    parameters.alignment.threads = threads;
    EXPECT_TRUE(isSameToTheBit(track(parameters), one)) << threads;
  }
}

TEST_P(GoldenTrajectoriesTest, AnyInstructionSetGivesTheSameWithinRounding) {
  kernels::select("scalar");
  const Trajectory scalar = track(parametersOf(GetParam()));
  for (const kernels::Backend& backend : kernels::backends()) {
    kernels::select(backend.name);
    EXPECT_LT(farthest(track(parametersOf(GetParam())), scalar), kRounding) << backend.name;
  }
}

INSTANTIATE_TEST_SUITE_P(Methods, GoldenTrajectoriesTest,
                         ::testing::Values(Case{"default", Method::kHybrid, PhotometricModel::kLcn},
                                           Case{"hybrid", Method::kHybrid, PhotometricModel::kNone},
                                           Case{"mi", Method::kMi, PhotometricModel::kNone},
                                           Case{"ssd_normalized", Method::kSsd,
                                                PhotometricModel::kLcn}),
                         [](const auto& info) { return info.param.name; });

}  // namespace
}  // namespace mivo
