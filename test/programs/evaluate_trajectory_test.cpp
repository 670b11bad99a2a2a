// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <stdlib.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

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
    EXPECT_EQ(figures, 32);
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

TEST_F(EvaluateTrajectoryTest, FiguresOfCommittedFilesToTheSixthDigit) {
  const std::string folder = MIVO_TRAJECTORIES;
  const ProcessResult result =
      run("evaluate_trajectory", {folder + "/truth.txt", folder + "/estimate.txt"});
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  std::istringstream expected(contentOf(folder + "/figures.txt"));
  int figures = 0;
  for (std::string line; std::getline(expected, line); ++figures) {
    const std::string name = line.substr(0, line.find(':'));
    const double value = std::stod(line.substr(name.size() + 2));
    EXPECT_NEAR(valueOf(result.output, name), value, 1e-6 * std::max(std::abs(value), 1e-3))
        << name;
  }
  EXPECT_EQ(figures, 32);
}

TEST_F(EvaluateTrajectoryTest, FiguresWorkedOutByHand) {
  // Along a square of 1 m, without turning; the estimate is 10 % larger.
  folder_.write("square.txt",
                "0 0 0 0 0 0 0 1\n1 1 0 0 0 0 0 1\n2 1 1 0 0 0 0 1\n3 0 1 0 0 0 0 1\n"
                "4 0 0 0 0 0 0 1\n");
  folder_.write("larger.txt",
                "0 0 0 0 0 0 0 1\n1 1.1 0 0 0 0 0 1\n2 1.1 1.1 0 0 0 0 1\n3 0 1.1 0 0 0 0 1\n"
                "4 0 0 0 0 0 0 1\n");
  const ProcessResult result =
      run("evaluate_trajectory", {folder_ / "square.txt", folder_ / "larger.txt"});
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  // Centers at (0.4, 0.4) and (0.44, 0.44): what remains is 0.1 times the distance from there.
  // Squared distances: 2 * 0.32, 2 * 0.52, 0.72; in x alone 3 * 0.16, 2 * 0.36.
  EXPECT_NEAR(valueOf(result.output, "ate_rmse_m"), 0.1 * std::sqrt(2.4 / 5.0), 1e-9);
  EXPECT_NEAR(valueOf(result.output, "ate_max_m"), 0.1 * std::sqrt(0.72), 1e-9);
  EXPECT_NEAR(valueOf(result.output, "ate_x_rmse_m"), 0.1 * std::sqrt(1.2 / 5.0), 1e-9);
  EXPECT_NEAR(valueOf(result.output, "ate_y_rmse_m"), 0.1 * std::sqrt(1.2 / 5.0), 1e-9);
  EXPECT_NEAR(valueOf(result.output, "ate_z_rmse_m"), 0.0, 1e-9);
  EXPECT_NEAR(valueOf(result.output, "ate_scale"), 1.0 / 1.1, 1e-9);
  EXPECT_NEAR(valueOf(result.output, "ate_scaled_rmse_m"), 0.0, 1e-9);
  EXPECT_NEAR(valueOf(result.output, "rpe_frame_translation_rmse_m"), 0.1, 1e-9);
  // Marks after each meter: from the second corner on, three sides.
  EXPECT_EQ(valueOf(result.output, "rpe_path_pairs"), 3);
  EXPECT_NEAR(valueOf(result.output, "rpe_path_translation_percent"), 10.0, 1e-6);
  EXPECT_EQ(valueOf(result.output, "matched"), 1.0);
}

TEST_F(EvaluateTrajectoryTest, WritesJsonAndKeepsWhatIsThere) {
  const std::string json = folder_ / "figures.json";
  const ProcessResult result = run("evaluate_trajectory", {truth_, estimate_, "--json", json});
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  const std::string text = contentOf(json);
  std::istringstream lines(result.output);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t colon = line.find(':');
    EXPECT_NE(text.find('"' + line.substr(0, colon) + '"' + line.substr(colon)), std::string::npos)
        << line;
  }
  expectRefusal(run("evaluate_trajectory", {truth_, estimate_, "--json", json}), 1,
                json + " exists");
  EXPECT_EQ(contentOf(json), text);
  const std::string estimate = contentOf(estimate_);
  expectRefusal(run("evaluate_trajectory", {truth_, estimate_, "--json", estimate_, "--force"}), 2,
                "--json names ESTIMATE, which is read");
  EXPECT_EQ(contentOf(estimate_), estimate);
  expectRefusal(run("evaluate_trajectory", {truth_, estimate_, "--json", folder_ / "a.png",
                                            "--plot", folder_ / "./a.png"}),
                2, "--json and --plot name the same file");
}

TEST_F(EvaluateTrajectoryTest, PlotsAreOfTheKindThatTheNameEndsWith) {
  if (runProcess("/usr/bin/python3", {"-c", "import matplotlib"}).exit_code != 0) {
    GTEST_SKIP() << "plots need python3-matplotlib";
  }
  const std::pair<const char*, const char*> kinds[] = {
      {"plot.png", "\x89PNG"}, {"plot.pdf", "%PDF"}, {"plot.svg", "<?xml"}};
  for (const auto& [name, start] : kinds) {
    const std::string plot = folder_ / name;
    const ProcessResult result = run("evaluate_trajectory", {truth_, estimate_, "--plot", plot});
    ASSERT_EQ(result.exit_code, 0) << result.errors;
    EXPECT_EQ(result.errors, "");
    EXPECT_EQ(contentOf(plot).find(start), 0U) << name;
    expectRefusal(run("evaluate_trajectory", {truth_, estimate_, "--plot", plot}), 1,
                  plot + " exists");
  }
  const std::string svg = contentOf(folder_ / "plot.svg");
  for (const char* text : {"Path, x-y plane", "Path, x-z plane", "Absolute trajectory error, rmse",
                           "Relative pose error over 1 s, translation", "estimate, aligned"}) {
    EXPECT_NE(svg.find(text), std::string::npos) << text;
  }
  expectRefusal(run("evaluate_trajectory", {truth_, estimate_, "--plot", folder_ / "plot.jpg"}), 2,
                "must end with .png, .pdf or .svg");
}

TEST_F(EvaluateTrajectoryTest, WithoutMatplotlibTheFiguresAreThereAndOneLineSaysWhatIsMissing) {
  // A matplotlib that cannot be imported goes before the one that is installed.
  folder_.write("matplotlib.py", "raise ImportError('none')\n");
  setenv("PYTHONPATH", folder_.path().c_str(), 1);
  const ProcessResult result =
      run("evaluate_trajectory",
          {truth_, estimate_, "--plot", folder_ / "plot.png", "--json", folder_ / "figures.json"});
  unsetenv("PYTHONPATH");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(result.errorLines(), 1U) << result.errors;
  EXPECT_NE(result.errors.find("no plot: plots need matplotlib (Debian: python3-matplotlib)"),
            std::string::npos)
      << result.errors;
  EXPECT_GT(valueOf(result.output, "ate_pairs"), 0.0);
  EXPECT_NE(contentOf(folder_ / "figures.json"), "");
}

TEST_F(EvaluateTrajectoryTest, QuaternionsWithTheScalarFirstAreRecognizedByTheTruth) {
  std::string truth;
  std::string estimate;
  for (const auto& [path, text] : {std::make_pair(truth_, &truth), {estimate_, &estimate}}) {
    for (const StampedPose& pose : readTrajectory(path)) {
      std::istringstream words(trajectoryLine(pose));
      std::vector<std::string> w(8);
      for (std::string& word : w) words >> word;
      *text += w[0] + " " + w[1] + " " + w[2] + " " + w[3] + " " + w[7] + " " + w[4] + " " + w[5] +
               " " + w[6] + "\n";
    }
  }
  const std::string truth_first = folder_.write("truth_first.txt", truth);
  const std::string first = folder_.write("first.txt", estimate);
  const std::string plain = run("evaluate_trajectory", {truth_, estimate_}).output;
  for (const auto& [q, p, told] : {std::make_tuple(truth_, first, first),
                                   std::make_tuple(truth_first, estimate_, truth_first)}) {
    const ProcessResult result = run("evaluate_trajectory", {q, p});
    ASSERT_EQ(result.exit_code, 0) << result.errors;
    for (const char* name : {"rpe_rotation_rmse_deg", "rpe_translation_rmse_m", "ate_rmse_m"}) {
      EXPECT_NEAR(valueOf(result.output, name), valueOf(plain, name), 1e-7) << name;
    }
    EXPECT_NE(result.errors.find("note: " + told + ": read with qw before qx: its rotations fit"),
              std::string::npos)
        << result.errors;
  }
}

TEST_F(EvaluateTrajectoryTest, SparseTruthGivesFigures) {
  Trajectory sparse;
  const Trajectory dense = readTrajectory(truth_);
  for (std::size_t i = 0; i < dense.size(); i += 50) sparse.push_back(dense[i]);  // at 2 Hz
  const std::string path = folder_ / "sparse.txt";
  TrajectoryWriter writer(path, Overwrite::kNo);
  for (const StampedPose& pose : sparse) writer.write(pose);
  ProcessResult result = run("evaluate_trajectory", {path, estimate_});
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_EQ(result.errors, "");
  EXPECT_LT(valueOf(result.output, "matched"), 0.1);
  EXPECT_GT(valueOf(result.output, "rpe_translation_rmse_m"), 0.0);
  EXPECT_GT(valueOf(result.output, "ate_rmse_m"), 0.0);
  result = run("evaluate_trajectory", {path, estimate_, "--delta", "0.75"});
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_NE(result.errors.find("The true poses are 0.5 s apart"), std::string::npos);
  EXPECT_GT(valueOf(result.output, "ate_rmse_m"), 0.0);
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
  expectRefusal(run("evaluate_trajectory", {truth_, estimate_, "--delta", "0.001"}), 1,
                "s between two poses of the estimate: choose a larger delta");
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
