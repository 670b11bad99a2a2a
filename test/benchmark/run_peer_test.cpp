// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <opencv2/core/utility.hpp>
#include <opencv2/imgcodecs.hpp>

#include "mivo/io/trajectory_io.h"
#include "programs/plane_sequence.h"
#include "programs/program_fixture.h"

namespace mivo {
namespace {

constexpr int kFrames = 8;

class RunPeerTest : public ProgramTest {
 protected:
  RunPeerTest() : sequence_(folder_ / "sequence"), output_(folder_ / "trajectory.txt") {
    writePlaneSequence(sequence_, kFrames);
  }

  ProcessResult track(const std::string& method, std::vector<std::string> options = {}) {
    options.insert(options.begin(), {sequence_, "--output", output_, "--method", method});
    return run("run_peer", options);
  }

  std::string sequence_;
  std::string output_;
};

// The path is 55 mm long. OpenCV may reject a frame of images this small, and its RgbdOdometry
// drifts; but an inverted motion would end 110 mm from the truth.
TEST_F(RunPeerTest, FollowsTheCamera) {
  const ProcessResult result = track("rgbd_icp");
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_EQ(valueOf(result.output, "frames"), kFrames);
  EXPECT_EQ(valueOf(result.output, "tracked") + valueOf(result.output, "lost"), kFrames);
  EXPECT_LE(valueOf(result.output, "lost"), 2);
  EXPECT_GT(valueOf(result.output, "cpu_ms_median"), 0.0);
  EXPECT_GE(valueOf(result.output, "cpu_ms_p95"), valueOf(result.output, "cpu_ms_median"));
  EXPECT_EQ(readTrajectory(output_).size(), static_cast<std::size_t>(kFrames));
  EXPECT_LT(largestPlaneError(output_), 0.03);
}

TEST_F(RunPeerTest, CountsAFailureAndKeepsTheLastPose) {
  std::vector<cv::String> depths;
  cv::glob(sequence_ + "/depth/*.png", depths);
  ASSERT_EQ(depths.size(), static_cast<std::size_t>(kFrames));
  cv::imwrite(depths.back(), cv::Mat::zeros(120, 160, CV_16UC1));
  const ProcessResult result = track("icp");
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_GE(valueOf(result.output, "lost"), 1);
  const Trajectory trajectory = readTrajectory(output_);
  EXPECT_TRUE(trajectory[kFrames - 1].pose.isApprox(trajectory[kFrames - 2].pose));
}

TEST_F(RunPeerTest, TakesAPartOfTheSequence) {
  const ProcessResult result = track("rgbd", {"--start", "2", "--count", "3"});
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  const Trajectory trajectory = readTrajectory(output_);
  ASSERT_EQ(trajectory.size(), 3U);
  EXPECT_NEAR(trajectory.front().stamp, planeStamp(2), 1e-6);
}

TEST_F(RunPeerTest, RefusesWhatMakesNoSense) {
  expectRefusal(track("orb"), 2, "rgbd, icp, rgbd_icp");
  expectRefusal(track("rgbd", {"--count", "0"}), 2, "--count");
  expectRefusal(run("run_peer", {sequence_, "--method", "rgbd"}), 2, "--output");
  expectRefusal(run("run_peer", {folder_ / "nothing", "--output", output_, "--method", "rgbd"}), 1,
                "nothing");
  ASSERT_EQ(track("rgbd").exit_code, 0);
  expectRefusal(track("rgbd"), 1, "--force");
}

}  // namespace
}  // namespace mivo
