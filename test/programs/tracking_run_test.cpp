// SPDX-License-Identifier: BSD-3-Clause
#include "programs/tracking_run.h"

#include <gtest/gtest.h>

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
