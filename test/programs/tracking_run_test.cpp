// SPDX-License-Identifier: BSD-3-Clause
#include "programs/tracking_run.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "mivo/core/error.h"
#include "mivo/io/trajectory_io.h"
#include "programs/plane_sequence.h"
#include "support/error_text.h"
#include "support/temporary_folder.h"

namespace mivo {
namespace {

/// Delivers some frames and then fails, as a recording on a failing disk does.
class FailingSource : public FrameSource {
 public:
  explicit FailingSource(int frames) : frames_(frames), camera_(planeCamera().camera) {}

  const Camera& camera() const override { return camera_; }
  std::size_t size() const override { return 100; }
  Status next(Frame& frame, std::string&) override {
    if (next_ == frames_) throw Error("the source has failed");
    renderPlane(planePose(next_), frame.image, frame.depth);
    frame.stamp = planeStamp(next_++);
    return Status::kFrame;
  }

 private:
  int frames_;
  int next_ = 0;
  Camera camera_;
};

TEST(TrackingRunTest, WhatHasBeenComputedIsKeptWhenTheSourceFails) {
  const TemporaryFolder folder;
  TrackingOptions options;
  options.output = folder / "trajectory.txt";
  options.statistics = folder / "statistics.csv";
  FailingSource source(3);
  EXPECT_EQ(errorText([&] { trackFrames(source, options); }), "the source has failed");
  EXPECT_EQ(readTrajectory(options.output).size(), 3U);
  const std::string statistics = contentOf(options.statistics);
  EXPECT_EQ(std::count(statistics.begin(), statistics.end(), '\n'), 4);  // with the header
}

/// Frames of the plane, changed before they are delivered.
class ChangedSource : public FrameSource {
 public:
  using Change = std::function<void(int i, Frame& frame)>;
  explicit ChangedSource(Change change)
      : change_(std::move(change)), camera_(planeCamera().camera) {}

  static constexpr int kFrames = 10;
  const Camera& camera() const override { return camera_; }
  std::size_t size() const override { return kFrames; }
  Status next(Frame& frame, std::string&) override {
    if (next_ == kFrames) return Status::kEnd;
    renderPlane(planePose(next_), frame.image, frame.depth);
    frame.stamp = planeStamp(next_);
    change_(next_++, frame);
    return Status::kFrame;
  }

 private:
  Change change_;
  Camera camera_;
  int next_ = 0;
};

class TrajectoryTest : public ::testing::Test {
 protected:
  TrajectoryTest() { options_.output = folder_ / "trajectory.txt"; }

  TrackingSummary track(const ChangedSource::Change& change) {
    ChangedSource source(change);
    testing::internal::CaptureStderr();
    TrackingSummary summary = trackFrames(source, options_);
    told_ = testing::internal::GetCapturedStderr();
    trajectory_ = summary.tracked > 0 ? readTrajectory(options_.output) : Trajectory();
    return summary;
  }

  TemporaryFolder folder_;
  TrackingOptions options_;
  Trajectory trajectory_;
  std::string told_;
};

TEST_F(TrajectoryTest, RefusedFramesAreNoPosesAndToldOnceForEachReason) {
  const TrackingSummary summary = track([](int i, Frame& frame) {
    if (i >= 4 && i < 7) frame.stamp = planeStamp(3);
    if (i == 8) frame.depth = cv::Mat(5, 5, CV_32FC1, cv::Scalar(1.0));
  });
  EXPECT_EQ(summary.frames, 6U);
  EXPECT_EQ(summary.tracked, 6U);
  EXPECT_EQ(summary.numRefused(), 4U);
  EXPECT_EQ(summary.refused_frames.at("stamp is not newer than that of the frame before"), 3U);
  EXPECT_EQ(summary.refused_frames.at("frame does not fit the camera"), 1U);
  EXPECT_EQ(std::count(told_.begin(), told_.end(), '\n'), 2) << told_;
  ASSERT_EQ(trajectory_.size(), 6U);
  EXPECT_NEAR(trajectory_[4].stamp, planeStamp(7), 1e-6);
  EXPECT_NO_THROW(requireTracked(summary));
}

TEST_F(TrajectoryTest, LostFramesAreWrittenOnlyWhenAskedForAndInitialisingOnesNever) {
  const auto change = [](int i, Frame& frame) {
    if (i != 0 && i != 5) return;  // nothing to be seen
    frame.image = cv::Scalar(0);
    frame.depth = cv::Scalar(0);
  };
  const TrackingSummary summary = track(change);
  EXPECT_EQ(summary.initialising, 1U);
  EXPECT_EQ(summary.lost, 1U);
  EXPECT_EQ(trajectory_.size(), 8U);
  options_.write_lost = options_.force = true;
  track(change);
  ASSERT_EQ(trajectory_.size(), 9U);
  EXPECT_NEAR(trajectory_[4].stamp, planeStamp(5), 1e-6);
}

TEST_F(TrajectoryTest, ARunInWhichNothingWasTrackedSaysWhy) {
  TrackingSummary summary = track([](int /*i*/, Frame& frame) { frame.depth = cv::Scalar(0); });
  EXPECT_EQ(errorText([&] { requireTracked(summary); }),
            "nothing was tracked; 10 frames: too few points with depth and texture, no pixel has "
            "depth");
  EXPECT_TRUE(trajectory_.empty());
  options_.force = true;
  summary = track([](int /*i*/, Frame& frame) { frame.depth = frame.depth / 1000.0; });
  const std::string text = errorText([&] { requireTracked(summary); });
  EXPECT_NE(text.find("100 % of the pixels have depth, its median is 0.00148 m"), std::string::npos)
      << text;
  // One pose is left where all stamps are the same: the first, which says nothing.
  summary = track([](int /*i*/, Frame& frame) { frame.stamp = 0.0; });
  EXPECT_EQ(errorText([&] { requireTracked(summary); }),
            "nothing was tracked; 9 frames refused: stamp is not newer than that of the frame "
            "before");
}

/// Nothing but broken frames.
class BrokenSource : public FailingSource {
 public:
  BrokenSource() : FailingSource(0) {}
  Status next(Frame&, std::string& fault) override {
    fault = "frame is broken";
    return ++calls_ <= 30 ? Status::kSkipped : Status::kEnd;
  }

 private:
  int calls_ = 0;
};

TEST(TrackingRunTest, SourceWithoutFramesIsAnErrorAndDoesNotFloodTheScreen) {
  const TemporaryFolder folder;
  TrackingOptions options;
  options.output = folder / "trajectory.txt";
  BrokenSource source;
  testing::internal::CaptureStderr();
  EXPECT_EQ(errorText([&] { trackFrames(source, options); }),
            "there was no frame to track: frame is broken");
  const std::string errors = testing::internal::GetCapturedStderr();
  EXPECT_EQ(std::count(errors.begin(), errors.end(), '\n'), 10);
}

}  // namespace
}  // namespace mivo
