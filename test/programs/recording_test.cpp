// SPDX-License-Identifier: BSD-3-Clause
#include "programs/recording.h"

namespace mivo {
namespace {

TEST_F(RecordingTest, OfficeIsTrackedToCentimeters) {
  const std::string sequence = recording("sun3d_xtion_fragA");
  const std::string trajectory = folder_ / "trajectory.txt";
  const ProcessResult tracked = run("run_sequence", {sequence, "--output", trajectory});
  ASSERT_EQ(tracked.exit_code, 0) << tracked.errors;
  const ProcessResult evaluated =
      run("evaluate_trajectory", {sequence + "/groundtruth.txt", trajectory});
  ASSERT_EQ(evaluated.exit_code, 0) << evaluated.errors;
  EXPECT_EQ(valueOf(tracked.output, "frames"), 49);  // one of 50 repeats the color image before it
  EXPECT_EQ(valueOf(tracked.output, "lost"), 0);
  // The ground truth is accurate to a centimeter.
  EXPECT_LT(valueOf(evaluated.output, "ate_rmse_m"), 0.03);
}

}  // namespace
}  // namespace mivo
