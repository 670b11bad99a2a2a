// SPDX-License-Identifier: BSD-3-Clause
#include "fault_run.h"

#include <gtest/gtest.h>

#include "support/camera_path.h"

namespace mivo {
namespace {

class FaultRunTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    const testing::Recording walk = testing::recordWalk(30);
    recording_ = new TrueRecording;
    for (std::size_t i = 0; i < walk.frames.size(); ++i) {
      recording_->deliveries.push_back({walk.frames[i], walk.camera, i});
    }
    recording_->T_world_camera = walk.T_first_camera;
  }
  static void TearDownTestSuite() { delete recording_; }

  static TrueRecording* recording_;
};

TrueRecording* FaultRunTest::recording_ = nullptr;

TEST_F(FaultRunTest, NothingIsWrongWithoutAFault) {
  const FaultOutcome outcome = track(*recording_, {"dropped", 0.0, 1}, {});
  EXPECT_EQ(outcome.wrong, 0);
  EXPECT_EQ(outcome.overconfident, 0);
  EXPECT_EQ(outcome.recovery, 0);
  EXPECT_GT(outcome.longest, 0.0);
}

// The measure itself: a camera that is not where the truth says.
TEST_F(FaultRunTest, WrongPosesAreSeen) {
  TrueRecording other = *recording_;
  for (std::size_t i = 25; i < 30; ++i) other.T_world_camera[i].translation().x() += 0.2;
  const FaultOutcome outcome = track(other, {"dropped", 0.0, 1}, {});
  EXPECT_EQ(outcome.wrong, 5);
  EXPECT_EQ(outcome.overconfident, 5);
  for (std::size_t i = 20; i < 25; ++i) other.T_world_camera[i].translation().x() += 0.2;
  EXPECT_EQ(track(other, {"dropped", 0.0, 1}, {}).recovery, 10);  // never right again
}

TEST_F(FaultRunTest, FaultsEndWithTheFault) {
  for (const std::string& name : FrameFaults::names()) {
    for (const std::uint32_t seed : {0U, 1U}) {
      const FaultOutcome outcome = track(*recording_, {name, seed == 0 ? 0.3 : 1.0, seed}, {});
      EXPECT_EQ(outcome.wrong, 0) << name;
      EXPECT_LT(outcome.recovery, 10) << name;
    }
  }
}

}  // namespace
}  // namespace mivo
