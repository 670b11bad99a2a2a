// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cstdlib>

#include "programs/program_fixture.h"

namespace mivo {
namespace {

/// A real recording, where $MIVO_DATA says that there are some.
class RecordingTest : public ProgramTest {
 protected:
  /// Tracks and evaluates; the output of both programs.
  std::string trackAndEvaluate(const std::string& name) {
    const std::string sequence = std::string(std::getenv("MIVO_DATA")) + "/" + name;
    const std::string trajectory = folder_ / "trajectory.txt";
    const ProcessResult tracked = run("run_sequence", {sequence, "--output", trajectory});
    EXPECT_EQ(tracked.exit_code, 0) << tracked.errors;
    const ProcessResult evaluated =
        run("evaluate_trajectory", {sequence + "/groundtruth.txt", trajectory});
    EXPECT_EQ(evaluated.exit_code, 0) << evaluated.errors;
    return tracked.output + evaluated.output;
  }
};

TEST_F(RecordingTest, OfficeIsTrackedToCentimetres) {
  if (std::getenv("MIVO_DATA") == nullptr) GTEST_SKIP() << "MIVO_DATA is not set: no recordings";
  const std::string output = trackAndEvaluate("sun3d_xtion_fragA");
  EXPECT_EQ(valueOf(output, "frames"), 50);
  EXPECT_EQ(valueOf(output, "lost"), 0);
  // The truth itself is good to a centimetre.
  EXPECT_LT(valueOf(output, "ate_rmse_m"), 0.03);
}

}  // namespace
}  // namespace mivo
