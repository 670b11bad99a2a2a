// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "mivo/core/se3.h"
#include "mivo/io/trajectory_io.h"
#include "programs/program_fixture.h"

namespace mivo {
namespace {

/// Numbers of a CSV text, without its header.
std::vector<std::vector<double>> rowsOf(const std::string& text) {
  std::istringstream lines(text);
  std::string line;
  std::getline(lines, line);
  std::vector<std::vector<double>> rows;
  while (std::getline(lines, line)) {
    std::istringstream fields(line);
    rows.emplace_back();
    for (std::string field; std::getline(fields, field, ',');) {
      rows.back().push_back(std::stod(field));
    }
  }
  return rows;
}

class PoseErrorsTest : public ProgramTest {
 protected:
  std::string write(const std::string& name, const std::vector<Eigen::Isometry3d>& poses) {
    const std::string path = folder_ / name;
    TrajectoryWriter writer(path, Overwrite::kNo);
    for (std::size_t i = 0; i < poses.size(); ++i) {
      writer.write({0.1 * static_cast<double>(i), poses[i]});
    }
    return path;
  }
  static Eigen::Isometry3d moved(double x, double yaw) {
    Vector6 d = Vector6::Zero();
    d[0] = x;
    d[5] = yaw;
    return retract(d);
  }
};

// The estimate makes 10 mm and 20 mrad too many in its second step and none in the others.
TEST_F(PoseErrorsTest, AreThoseOfTheSteps) {
  const auto truth = write("truth.txt", {moved(0, 0), moved(0.1, 0), moved(0.2, 0), moved(0.3, 0)});
  const Eigen::Isometry3d extra = expSe3((Vector6() << 0.01, 0, 0, 0, 0, 0.02).finished());
  const auto estimate = write("estimate.txt", {moved(0, 0), moved(0.1, 0), moved(0.2, 0) * extra,
                                               moved(0.2, 0) * extra * moved(0.1, 0)});
  const ProcessResult result = run("pose_errors", {truth, estimate});
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  const auto rows = rowsOf(result.output);
  ASSERT_EQ(rows.size(), 3U);
  const double expected[3][3] = {{0.1, 0.0, 0.0}, {0.2, 0.01, 0.02}, {0.3, 0.0, 0.0}};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(rows[i][k], expected[i][k], 1e-8) << i << k;
  }
}

TEST_F(PoseErrorsTest, OrThoseOfTheMotionSinceTheFirstFrame) {
  const auto truth = write("truth.txt", {moved(0, 0), moved(0, 0), moved(0, 0)});
  const auto estimate = write("estimate.txt", {moved(0, 0), moved(0.003, 0), moved(0, 0.004)});
  const ProcessResult result = run("pose_errors", {truth, estimate, "--reference", "first"});
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  const auto rows = rowsOf(result.output);
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_NEAR(rows[0][1], 0.003, 1e-9);
  EXPECT_NEAR(rows[0][2], 0.0, 1e-9);
  EXPECT_NEAR(rows[1][1], 0.0, 1e-9);
  EXPECT_NEAR(rows[1][2], 0.004, 1e-9);
}

TEST_F(PoseErrorsTest, NeedATruePoseForEachFrame) {
  const auto truth = write("truth.txt", {moved(0, 0), moved(0, 0)});
  const auto estimate = write("estimate.txt", {moved(0, 0), moved(0, 0), moved(0, 0)});
  const ProcessResult result = run("pose_errors", {truth, estimate});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_NE(result.errors.find("no pose near 0.2"), std::string::npos) << result.errors;
}

/// Experiments on a small sequence of exact images, rendered once for all tests.
class ExperimentTest : public ProgramTest {
 protected:
  static void SetUpTestSuite() {
    film_ = std::make_unique<TemporaryFolder>();
    const ProcessResult filmed =
        run("generate_sequence", {sequence(), "--ideal", "--frames", "9", "--width", "320",
                                  "--height", "240", "--threads", "1"});
    ASSERT_EQ(filmed.exit_code, 0) << filmed.errors;
  }
  static void TearDownTestSuite() { film_.reset(); }
  static std::string sequence() { return *film_ / "sequence"; }

  std::vector<std::vector<double>> experiment(const std::string& program,
                                              const std::vector<std::string>& options) {
    const std::string output = folder_ / "out.csv";
    std::vector<std::string> arguments{sequence(), "--output", output,    "--force",
                                       "--trials", "6",        "--pairs", "3"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const ProcessResult result = run(program, arguments);
    EXPECT_EQ(result.exit_code, 0) << result.errors;
    std::ifstream file(output);
    std::stringstream text;
    text << file.rdbuf();
    return rowsOf(text.str());
  }

  static std::unique_ptr<TemporaryFolder> film_;
};

std::unique_ptr<TemporaryFolder> ExperimentTest::film_;

// Starts at the truth always converge, starts rotated by more than the field of view never.
TEST_F(ExperimentTest, ConvergenceCountsWhatEndsNearTheTruth) {
  const auto rows = experiment("convergence_experiment", {"--magnitude", "0", "--magnitude", "3"});
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[0][1], 6.0);
  EXPECT_EQ(rows[0][2], 6.0);
  EXPECT_EQ(rows[1][0], 3.0);
  EXPECT_EQ(rows[1][2], 0.0);
}

#ifdef MIVO_WITH_CERES
TEST_F(ExperimentTest, EveryOptimizerStaysAtTheTruth) {
  for (const char* optimizer : {"newton", "lbfgs", "lbfgs_differences"}) {
    const auto rows =
        experiment("optimizer_experiment", {"--magnitude", "0", "--optimizer", optimizer});
    ASSERT_EQ(rows.size(), 6U) << optimizer;
    for (const auto& row : rows) {
      EXPECT_LT(row[1], 0.01) << optimizer;
      EXPECT_LT(row[2], 0.01) << optimizer;
      EXPECT_EQ(row[3], 1.0) << optimizer;
      EXPECT_LT(row[4], 0.0) << optimizer;  // the cost is the negative mutual information
    }
  }
}
#endif

TEST_F(ExperimentTest, RefusesWhatMakesNoSense) {
  expectRefusal(run("convergence_experiment", {sequence(), "--magnitude", "1"}), 2, "--output");
  expectRefusal(run("convergence_experiment",
                    {sequence(), "--output", folder_ / "x", "--magnitude", "1", "--pairs", "100"}),
                1, "too short");
}

TEST_F(ExperimentTest, PicturesAreThoseOfTheFrameAndItsKeyframe) {
  const std::string pictures = folder_ / "pictures";
  const ProcessResult result = run("tracking_pictures", {sequence(), pictures, "--frame", "2"});
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_GT(valueOf(result.output, "points"), 100.0);
  for (const char* name : {"keyframe.png", "depth.png", "points.png", "live.png", "residual.png"}) {
    EXPECT_TRUE(std::filesystem::exists(std::filesystem::path(pictures) / name)) << name;
  }
  expectRefusal(run("tracking_pictures", {sequence(), pictures, "--frame", "50"}), 1, "frame");
}

}  // namespace
}  // namespace mivo
