// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>

#include "io/image_file.h"
#include "mivo/core/se3.h"
#include "mivo/io/trajectory_io.h"
#include "programs/program_fixture.h"

namespace mivo {
namespace {

/// A curved path of 6 s at 100 Hz as the truth; the estimate, at 30 Hz, drifts, jitters in time and
/// has gaps.
class EvaluateTrajectoryTest : public ProgramTest {
 protected:
  EvaluateTrajectoryTest() : truth_(folder_ / "truth.txt"), estimate_(folder_ / "estimate.txt") {
    TrajectoryWriter truth(truth_, Overwrite::kNo);
    for (int i = 0; i < 600; ++i) truth.write({50.0 + 0.01 * i, poseAt(0.01 * i)});
    TrajectoryWriter estimate(estimate_, Overwrite::kNo);
    for (int i = 0; i < 170; ++i) {
      if (i % 7 == 3 || (i > 60 && i < 75)) continue;
      const double time = i / 30.0 + 0.004 * std::sin(5.0 * i);
      Vector6 error;
      error << 0.02 * std::sin(time), -0.01 * time, 0.003 * std::sin(9.0 * i), 0.01 * time,
          0.02 * std::cos(time), 0.002 * std::cos(7.0 * i);
      estimate.write({50.0 + time, poseAt(time) * retract(error)});
    }
  }

  static Eigen::Isometry3d poseAt(double time) {
    Vector6 pose;
    pose << std::sin(time), std::cos(0.7 * time), 0.3 * time, 0.5 * std::sin(2.0 * time),
        0.4 * time, std::cos(time);
    return retract(pose);
  }

  std::string truth_;
  std::string estimate_;
};

TEST_F(EvaluateTrajectoryTest, AgreesWithASecondImplementation) {
  if (runProcess("/usr/bin/python3", {"-c", "import numpy"}).exit_code != 0) {
    GTEST_SKIP() << "the second implementation needs python3-numpy";
  }
  for (const char* delta : {"1", "0.5", "2.25"}) {
    const ProcessResult result = run("evaluate_trajectory", {truth_, estimate_, "--delta", delta});
    ASSERT_EQ(result.exit_code, 0) << result.errors;
    const ProcessResult reference =
        runProcess("/usr/bin/python3", {MIVO_REFERENCE_FIGURES, truth_, estimate_, delta});
    ASSERT_EQ(reference.exit_code, 0) << reference.errors;
    std::istringstream lines(result.output);
    int figures = 0;
    for (std::string line; std::getline(lines, line); ++figures) {
      const std::string name = line.substr(0, line.find(':'));
      const double value = valueOf(reference.output, name);
      // The program prints 9 digits.
      EXPECT_NEAR(valueOf(result.output, name), value, 1e-8 * std::max(1.0, std::abs(value)))
          << name << ", delta " << delta;
    }
    EXPECT_EQ(figures, 14);
  }
}

TEST_F(EvaluateTrajectoryTest, PerfectEstimateHasNoError) {
  const ProcessResult result = run("evaluate_trajectory", {truth_, truth_});
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_EQ(result.errors, "");
  EXPECT_EQ(valueOf(result.output, "coverage"), 1.0);
  EXPECT_NEAR(valueOf(result.output, "rpe_translation_max_m"), 0.0, 1e-9);
  EXPECT_NEAR(valueOf(result.output, "rpe_rotation_max_deg"), 0.0, 1e-6);
  EXPECT_NEAR(valueOf(result.output, "ate_max_m"), 0.0, 1e-9);
}

TEST_F(EvaluateTrajectoryTest, WritesJsonAndPlot) {
  const std::string json = folder_ / "figures.json";
  const std::string plot = folder_ / "plot.png";
  const ProcessResult result =
      run("evaluate_trajectory", {truth_, estimate_, "--json", json, "--plot", plot});
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  const std::string text = contentOf(json);
  std::istringstream lines(result.output);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t colon = line.find(':');
    EXPECT_NE(text.find('"' + line.substr(0, colon) + '"' + line.substr(colon)), std::string::npos)
        << line;
  }
  EXPECT_EQ(readImage(plot).type(), CV_8UC3);

  expectRefusal(run("evaluate_trajectory", {truth_, estimate_, "--json", json}), 1,
                json + " exists");
  expectRefusal(run("evaluate_trajectory", {truth_, estimate_, "--plot", plot}), 1,
                plot + " exists");
  EXPECT_EQ(contentOf(json), text);
  EXPECT_EQ(
      run("evaluate_trajectory", {truth_, estimate_, "--json", json, "--plot", plot, "--force"})
          .exit_code,
      0);
}

TEST_F(EvaluateTrajectoryTest, TimeDifferenceLimitsWhatIsCompared) {
  const double all = valueOf(run("evaluate_trajectory", {truth_, estimate_}).output, "ate_pairs");
  const ProcessResult strict =
      run("evaluate_trajectory", {truth_, estimate_, "--max-time-difference", "0.002"});
  EXPECT_LT(valueOf(strict.output, "ate_pairs"), all);
}

TEST_F(EvaluateTrajectoryTest, BadInputIsRefusedInOneLine) {
  const std::string none = folder_ / "none.txt";
  expectRefusal(run("evaluate_trajectory", {none, estimate_}), 1, none);
  expectRefusal(run("evaluate_trajectory", {truth_, none}), 1, none);
  const std::string bad = folder_.write("bad.txt", "0 0 0 0 0 0 0 1\n1 0 0 nan 0 0 0 1\n");
  expectRefusal(run("evaluate_trajectory", {truth_, bad}), 1, bad + ":2: ");
  const std::string other =
      folder_.write("other.txt", "900 0 0 0 0 0 0 1\n901 0 0 0 0 0 0 1\n902 0 0 0 0 0 0 1\n");
  expectRefusal(run("evaluate_trajectory", {truth_, other}), 1, "same time");
  expectRefusal(run("evaluate_trajectory", {truth_, estimate_, "--delta", "100"}), 1, "delta");
}

TEST_F(EvaluateTrajectoryTest, WrongUsageIsRefusedInOneLine) {
  expectRefusal(run("evaluate_trajectory", {truth_}), 2, "ESTIMATE");
  for (const char* delta : {"0", "-1", "nan", "inf", "x"}) {
    expectRefusal(run("evaluate_trajectory", {truth_, estimate_, "--delta", delta}), 2, "delta");
  }
  expectRefusal(run("evaluate_trajectory", {truth_, estimate_, "--max-time-difference", "0"}), 2,
                "max-time-difference");
  expectRefusal(run("evaluate_trajectory", {truth_, estimate_, "--scale"}), 2, "--scale");
  EXPECT_EQ(run("evaluate_trajectory", {"--help"}).exit_code, 0);
}

}  // namespace
}  // namespace mivo
