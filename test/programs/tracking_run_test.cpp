// SPDX-License-Identifier: BSD-3-Clause
#include "programs/tracking_run.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "mivo/core/error.h"
#include "mivo/io/trajectory_io.h"
#include "programs/plane_sequence.h"
#include "support/error_text.h"
#include "support/temporary_folder.h"

namespace mivo {
namespace {

/// Frames in front of the plane, each changed by a function before it is delivered.
class PlaneSource : public FrameSource {
 public:
  using Change = std::function<void(int i, Frame& frame)>;

  PlaneSource(int frames, Change change)
      : frames_(frames), camera_(planeCamera().camera), change_(std::move(change)) {}

  const Camera& camera() const override { return camera_; }
  std::size_t size() const override { return static_cast<std::size_t>(frames_); }
  std::string depthUnit() const override { return "as the plane has it"; }
  const std::string& notice() const override { return notice_; }

  Status next(Frame& frame, FrameFault& fault) override {
    if (next_ == frames_) return Status::kEnd;
    frame = Frame();
    renderPlane(planePose(next_), frame.image, frame.depth);
    frame.stamp = planeStamp(next_);
    try {
      change_(next_++, frame);
    } catch (const UsageError&) {  // stands for a frame that cannot be read
      fault = {"file " + std::to_string(next_) + " is broken", "file is broken"};
      return Status::kSkipped;
    }
    return Status::kFrame;
  }

 private:
  int frames_;
  int next_ = 0;
  Camera camera_;
  std::string notice_;
  Change change_;
};

class TrackingRunTest : public ::testing::Test {
 protected:
  TrackingRunTest() {
    options_.output = folder_ / "trajectory.txt";
    options_.statistics = folder_ / "statistics.csv";
  }

  TrackingSummary track(int frames, const PlaneSource::Change& change) {
    PlaneSource source(frames, change);
    testing::internal::CaptureStderr();
    TrackingSummary summary = trackFrames(source, options_);
    errors_ = testing::internal::GetCapturedStderr();
    return summary;
  }

  /// Numbers of the frames that have a line in the trajectory.
  std::vector<int> written() const {
    std::vector<int> frames;
    for (const StampedPose& pose : readTrajectory(options_.output)) {
      frames.push_back(static_cast<int>(std::lround(30.0 * (pose.stamp - planeStamp(0)))));
    }
    return frames;
  }

  long numRows() const {
    const std::string text = contentOf(options_.statistics);
    return std::count(text.begin(), text.end(), '\n') - 1;  // without the header
  }

  /// What is said of a run in which nothing was tracked.
  std::string refusal(const TrackingSummary& summary) const {
    return errorText([&] { requireTracked(summary, options_.parameters.depth, "5000 per meter"); });
  }

  TemporaryFolder folder_;
  TrackingOptions options_;
  std::string errors_;
};

void keep(int, Frame&) {}

void cover(Frame& frame) {
  frame.image = cv::Scalar(0);
  frame.depth = cv::Scalar(0.0);
}

TEST_F(TrackingRunTest, WhatHasBeenComputedIsKeptWhenTheSourceFails) {
  const auto fail = [](int i, Frame&) {
    if (i == 3) throw Error("the source has failed");
  };
  PlaneSource source(10, fail);
  EXPECT_EQ(errorText([&] { trackFrames(source, options_); }), "the source has failed");
  EXPECT_EQ(written(), (std::vector<int>{0, 1, 2}));
  EXPECT_EQ(numRows(), 3);
}

/// The plane again after half of the frames, with stamps and calibration that the test chooses.
class ChangingSource : public PlaneSource {
 public:
  ChangingSource(int frames, const Change& change, bool changes_camera)
      : PlaneSource(frames, change), half_(frames / 2), changes_camera_(changes_camera) {
    other_ = PlaneSource::camera();
    other_.fx += 0.5;
  }
  const Camera& camera() const override {
    return changes_camera_ && read_ > half_ ? other_ : PlaneSource::camera();
  }
  Status next(Frame& frame, FrameFault& fault) override {
    ++read_;
    return PlaneSource::next(frame, fault);
  }
  bool startsAnew() const override { return !changes_camera_ && read_ == half_ + 1; }
  const std::map<std::string, std::size_t>& leftOut() const override { return left_out_; }

 private:
  int half_;
  bool changes_camera_;
  int read_ = 0;
  Camera other_;
  std::map<std::string, std::size_t> left_out_ = {{"color image without a partner", 3}};
};

TEST_F(TrackingRunTest, TimeSetBackGoesOnInAnotherFileAtTheLastPose) {
  ChangingSource source(
      10,
      [](int i, Frame& frame) {
        if (i >= 5) frame.stamp -= 20.0;
      },
      false);
  const TrackingSummary summary = trackFrames(source, options_);
  EXPECT_EQ(summary.segments, 2);
  EXPECT_EQ(summary.frames, 10U);
  EXPECT_EQ(summary.left_out, (CountByReason{{"color image without a partner", 3}}));
  EXPECT_EQ(written(), (std::vector<int>{0, 1, 2, 3, 4}));
  const Trajectory second = readTrajectory(folder_ / "trajectory_2.txt");
  ASSERT_EQ(second.size(), 5U);
  EXPECT_NEAR(second[0].stamp, planeStamp(5) - 20.0, 1e-6);
  const Trajectory first = readTrajectory(options_.output);
  EXPECT_TRUE(second[0].pose.isApprox(first[4].pose, 1e-9));
}

TEST_F(TrackingRunTest, AnotherCalibrationBeginsASegmentAtTheLastPose) {
  ChangingSource source(10, keep, true);
  const TrackingSummary summary = trackFrames(source, options_);
  EXPECT_EQ(summary.segments, 2);
  const Trajectory poses = readTrajectory(options_.output);
  ASSERT_EQ(poses.size(), 10U);
  EXPECT_TRUE(poses[5].pose.isApprox(poses[4].pose, 1e-9));
}

TEST_F(TrackingRunTest, RefusedFramesAreNoPosesAndAreToldOncePerReason) {
  const TrackingSummary summary = track(12, [](int i, Frame& frame) {
    if (i >= 4 && i < 7) frame.stamp = planeStamp(3);
    if (i == 7 || i == 9) frame.image = frame.image.colRange(0, 100);
    if (i == 10) throw UsageError("broken");
  });
  EXPECT_EQ(written(), (std::vector<int>{0, 1, 2, 3, 8, 11}));
  EXPECT_EQ(numRows(), 6);
  EXPECT_EQ(summary.frames, 6U);
  EXPECT_EQ(summary.tracked, 6U);
  EXPECT_EQ(summary.motions, 5U);
  EXPECT_EQ(summary.skipped_frames, 6U);
  const CountByReason expected = {{"file is broken", 1},
                                  {"stamp is not newer than that of the frame before", 3},
                                  {"the image has 100 x 120 pixels, but the camera 160 x 120", 2}};
  EXPECT_EQ(summary.skipped, expected);
  EXPECT_EQ(errors_,
            "skipped: frame of stamp 100.100000: stamp is not newer than that of the frame before\n"
            "skipped: frame of stamp 100.233333: the image has 100 x 120 pixels, but the camera "
            "160 x 120\n"
            "skipped: file 11 is broken\n");
  std::ostringstream text;
  print(text, summary);
  EXPECT_NE(text.str().find("\nskipped_frames: 6\nskipped (file is broken): 1\n"),
            std::string::npos)
      << text.str();
  EXPECT_EQ(refusal(summary), "nothing thrown");
}

TEST_F(TrackingRunTest, LostFramesAreWrittenOnlyWhenAskedFor) {
  const auto change = [](int i, Frame& frame) {
    if (i == 4 || i == 5) cover(frame);
  };
  EXPECT_EQ(track(8, change).lost, 2U);
  EXPECT_EQ(written(), (std::vector<int>{0, 1, 2, 3, 6, 7}));
  EXPECT_EQ(numRows(), 8);
  options_.write_lost = options_.force = true;
  EXPECT_EQ(track(8, change).lost, 2U);
  EXPECT_EQ(written(), (std::vector<int>{0, 1, 2, 3, 4, 5, 6, 7}));
}

TEST_F(TrackingRunTest, FramesBeforeTheFirstKeyframeAreNeverWritten) {
  options_.write_lost = true;
  const TrackingSummary summary = track(6, [](int i, Frame& frame) {
    if (i < 2) frame.depth = cv::Scalar(0.0);
  });
  EXPECT_EQ(summary.initializing, 2U);
  EXPECT_EQ(written(), (std::vector<int>{2, 3, 4, 5}));
  EXPECT_EQ(numRows(), 6);
}

TEST_F(TrackingRunTest, ASingleFrameIsTrackedWhenItBecomesTheKeyframe) {
  EXPECT_EQ(refusal(track(1, keep)), "nothing thrown");
  EXPECT_EQ(written(), (std::vector<int>{0}));
}

TEST_F(TrackingRunTest, NothingTrackedBecauseOfTheStampsIsSaid) {
  const TrackingSummary summary = track(8, [](int, Frame& frame) { frame.stamp = planeStamp(0); });
  const std::string text = refusal(summary);
  EXPECT_EQ(
      text.find("nothing was tracked: stamp is not newer than that of the frame before (7 of 8 "
                "frames); median depth seen 1."),
      0U)
      << text;
  EXPECT_EQ(text.find("unit"), std::string::npos) << text;
  EXPECT_EQ(written(), (std::vector<int>{0}));  // what there is stays
}

TEST_F(TrackingRunTest, NothingTrackedBecauseOfTheDepthUnitIsSaid) {
  const TrackingSummary summary =
      track(8, [](int, Frame& frame) { frame.depth = frame.depth * 0.001; });
  const std::string text = refusal(summary);
  EXPECT_EQ(text.find("nothing was tracked: too few points with depth and texture (8 of 8 frames); "
                      "median depth seen 0.001"),
            0U)
      << text;
  EXPECT_NE(text.find(" m, 100 % of the pixels, outside of 0.3 to 10 m: is the depth unit wrong "
                      "(5000 per meter)?"),
            std::string::npos)
      << text;
}

TEST_F(TrackingRunTest, NothingTrackedForWantOfDepthIsSaid) {
  const TrackingSummary summary =
      track(8, [](int, Frame& frame) { frame.depth = cv::Scalar(0.0); });
  EXPECT_EQ(refusal(summary),
            "nothing was tracked: too few points with depth and texture (8 of 8 frames); the depth "
            "images have no reading at all");
}

TEST_F(TrackingRunTest, NothingReadableIsSaidAndDoesNotFloodTheScreen) {
  const TrackingSummary summary = track(30, [](int, Frame&) { throw UsageError("broken"); });
  EXPECT_EQ(errors_, "skipped: file 1 is broken\n");
  EXPECT_EQ(refusal(summary), "nothing was tracked: file is broken (30 of 30 frames)");
}

TEST_F(TrackingRunTest, DepthThatCannotBeRightIsNamedEvenIfItWasTracked) {
  options_.parameters.depth.min_depth = 1.0;
  TrackingSummary summary = track(3, keep);
  const auto fault = [&] {
    return summary.depth.findFault(options_.parameters.depth, "unit",
                                   DepthAccount::Expected::kRoom);
  };
  EXPECT_EQ(fault(), "");
  options_.parameters.depth.min_depth = 2.0;
  EXPECT_NE(fault().find("(unit)?"), std::string::npos);
}

}  // namespace
}  // namespace mivo
