// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <opencv2/core.hpp>

#include "io/image_file.h"
#include "mivo/core/parameters.h"
#include "mivo/io/trajectory_io.h"
#include "programs/plane_sequence.h"
#include "programs/program_fixture.h"

namespace mivo {
namespace {

constexpr int kFrames = 12;

class RunSequenceTest : public ProgramTest {
 protected:
  RunSequenceTest() : sequence_(folder_ / "sequence"), output_(folder_ / "trajectory.txt") {
    writePlaneSequence(sequence_, kFrames);
  }

  ProcessResult track(std::vector<std::string> options) {
    options.insert(options.begin(), {sequence_, "--output", output_});
    return run("run_sequence", options);
  }

  double largestError(int first_frame = 0) const { return largestPlaneError(output_, first_frame); }

  std::string image(int i) const {
    std::ostringstream name;
    name.setf(std::ios::fixed);
    name.precision(6);
    name << sequence_ << "/rgb/" << planeStamp(i) << ".png";
    return name.str();
  }

  void truncate(const std::string& path) {
    std::filesystem::resize_file(path, std::filesystem::file_size(path) / 2);
  }

  // The path is 86 mm long. Images this small measure it to 2 or 3 mm; a pose at the wrong stamp,
  // inverted, or of a wrong depth unit would be off by a frame's 8 mm or more.
  static constexpr double kTolerance = 0.005;  // m

  std::string sequence_;
  std::string output_;
};

TEST_F(RunSequenceTest, WritesAPoseForEveryFrame) {
  const ProcessResult result = track({"--statistics", folder_ / "statistics.csv"});
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_EQ(result.errors, "");
  EXPECT_EQ(readTrajectory(output_).size(), std::size_t{kFrames});
  EXPECT_LT(largestError(), kTolerance);
  EXPECT_EQ(valueOf(result.output, "frames"), kFrames);
  EXPECT_EQ(valueOf(result.output, "tracked"), kFrames);
  EXPECT_EQ(valueOf(result.output, "degraded"), 0);
  EXPECT_EQ(valueOf(result.output, "lost"), 0);
  EXPECT_EQ(valueOf(result.output, "skipped_frames"), 0);
  EXPECT_EQ(valueOf(result.output, "depth_time_offset_s"), 0);
  EXPECT_GE(valueOf(result.output, "keyframes"), 1);
  const double median = valueOf(result.output, "cpu_ms_median");
  EXPECT_GT(median, 0.0);
  EXPECT_GE(valueOf(result.output, "cpu_ms_p95"), median);
}

TEST_F(RunSequenceTest, StatisticsHaveARowPerFrameAndANamePerColumn) {
  const std::string path = folder_ / "statistics.csv";
  ASSERT_EQ(track({"--statistics", path}).exit_code, 0);
  std::istringstream lines(contentOf(path));
  std::string header;
  std::getline(lines, header);
  EXPECT_EQ(header.rfind("stamp,state,reason,keyframe,", 0), 0U);
  for (const char* name :
       {",iterations_0,", ",points_4,", ",mutual_information,", ",residual_scale,", ",overlap,",
        ",rolling_shutter_readout,", ",sigma_tx,", ",sigma_rz,"}) {
    EXPECT_NE(header.find(name), std::string::npos) << name;
  }
  // At the end, so that what reads columns by number still finds the others.
  EXPECT_EQ(header.substr(header.rfind(',')), ",alignment_covariance_55");
  const auto columns = std::count(header.begin(), header.end(), ',');
  int rows = 0;
  for (std::string row; std::getline(lines, row); ++rows) {
    EXPECT_EQ(std::count(row.begin(), row.end(), ','), columns) << row;
    EXPECT_NE(row.find(",tracking,"), std::string::npos) << row;
    EXPECT_EQ(row.find("nan"), std::string::npos) << row;
  }
  EXPECT_EQ(rows, kFrames);
}

TEST_F(RunSequenceTest, SameInputGivesTheSameBytes) {
  ASSERT_EQ(track({}).exit_code, 0);
  const std::string first = contentOf(output_);
  ASSERT_EQ(track({"--force", "--threads", "2"}).exit_code, 0);
  EXPECT_EQ(contentOf(output_), first);
}

TEST_F(RunSequenceTest, PartOfASequence) {
  const ProcessResult result = track({"--start", "3", "--count", "4"});
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  const Trajectory trajectory = readTrajectory(output_);
  ASSERT_EQ(trajectory.size(), 4U);
  EXPECT_NEAR(trajectory[0].stamp, planeStamp(3), 1e-6);
  EXPECT_TRUE(trajectory[0].pose.isApprox(Eigen::Isometry3d::Identity()));
  EXPECT_LT(largestError(3), kTolerance);
}

TEST_F(RunSequenceTest, BrokenFramesAreSkippedAndTold) {
  truncate(image(0));
  truncate(image(5));
  const ProcessResult result = track({});
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_EQ(valueOf(result.output, "skipped_frames"), 2);
  EXPECT_EQ(valueOf(result.output, "frames"), kFrames - 2);
  EXPECT_EQ(readTrajectory(output_).size(), std::size_t{kFrames - 2});
  EXPECT_EQ(valueOf(result.output, "skipped (the color image is truncated)"), 2);
  // Told once per reason.
  EXPECT_EQ(result.errors, "skipped: " + image(0) + " is truncated\n");
  EXPECT_LT(largestError(1), kTolerance);
}

TEST_F(RunSequenceTest, AssociationsInReverseOrderAndDoubledGiveTheSamePoses) {
  ASSERT_EQ(track({}).exit_code, 0);
  const std::string expected = contentOf(output_);
  std::istringstream lines(contentOf(sequence_ + "/associations.txt"));
  std::string reversed;
  for (std::string line; std::getline(lines, line);) {
    reversed = line + "\n" + line + "\n" + reversed;
  }
  folder_.write("sequence/associations.txt", reversed);
  const ProcessResult result = track({"--force"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(contentOf(output_), expected);
  EXPECT_EQ(result.errorLines(), 1U) << result.errors;
  EXPECT_NE(result.errors.find("12 of them left out"), std::string::npos) << result.errors;
}

TEST_F(RunSequenceTest, NothingTrackedIsAnErrorThatNamesTheDepth) {
  folder_.write("sequence/camera.txt", "160 120 140 140 79.5 59.5 1000000\n");
  const ProcessResult result = track({});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(valueOf(result.output, "initializing"), kFrames);
  EXPECT_EQ(result.errorLines(), 1U) << result.errors;
  EXPECT_NE(result.errors.find("nothing was tracked: too few points with depth and texture (12 of "
                               "12 frames); median depth seen 0.0"),
            std::string::npos)
      << result.errors;
  EXPECT_NE(result.errors.find("(camera.txt: 1000000 units per meter)?"), std::string::npos)
      << result.errors;
}

TEST_F(RunSequenceTest, ExistingFilesAreKeptWithoutForce) {
  folder_.write("trajectory.txt", "mine");
  expectRefusal(track({}), 1, output_ + " exists");
  EXPECT_EQ(contentOf(output_), "mine");
  ASSERT_EQ(track({"--force"}).exit_code, 0);
  EXPECT_EQ(readTrajectory(output_).size(), std::size_t{kFrames});

  std::filesystem::remove(output_);
  const std::string statistics = folder_.write("statistics.csv", "mine");
  expectRefusal(track({"--statistics", statistics}), 1, statistics + " exists");
  EXPECT_EQ(contentOf(statistics), "mine");
  EXPECT_FALSE(std::filesystem::exists(output_));  // refused before anything was begun
}

TEST_F(RunSequenceTest, NoFileIsTouchedUnlessAllCanBeWritten) {
  folder_.write("trajectory.txt", "mine");
  const std::string missing = folder_ / "no/statistics.csv";
  expectRefusal(track({"--force", "--statistics", missing}), 1, "cannot create " + missing);
  expectRefusal(track({"--force", "--statistics", folder_ / "./trajectory.txt"}), 2,
                "--output and --statistics name the same file");
  EXPECT_EQ(contentOf(output_), "mine");
  const std::string truth = contentOf(sequence_ + "/groundtruth.txt");
  expectRefusal(track({"--force", "--statistics", sequence_ + "/groundtruth.txt"}), 2,
                "--statistics names groundtruth.txt, which is read");
  EXPECT_EQ(contentOf(sequence_ + "/groundtruth.txt"), truth);
}

TEST_F(RunSequenceTest, RepeatedColorImagesAreLeftOutAndTold) {
  for (const int i : {4, 9}) {
    std::filesystem::copy_file(image(i - 1), image(i),
                               std::filesystem::copy_options::overwrite_existing);
  }
  const ProcessResult result = track({});
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_EQ(valueOf(result.output, "tracked"), kFrames - 2);
  EXPECT_EQ(valueOf(result.output,
                    "skipped (the color image repeats the one before while the depth goes on)"),
            2);
  EXPECT_EQ(result.errorLines(), 1U) << result.errors;
  EXPECT_LT(largestError(), kTolerance);
}

TEST_F(RunSequenceTest, DepthThatIsStoredWrongIsNamed) {
  const auto rewrite = [&](const auto& function) {
    for (const auto& entry : std::filesystem::directory_iterator(sequence_ + "/depth")) {
      cv::Mat depth = readImage(entry.path().string());
      depth.forEach<std::uint16_t>([&](std::uint16_t& value, const int*) {
        value = static_cast<std::uint16_t>(function(unsigned{value}));
      });
      writePng(entry.path().string(), depth, Overwrite::kYes);
    }
  };
  const auto noteOf = [&] {
    const ProcessResult result = track({"--force"});
    EXPECT_EQ(result.errorLines(), 1U) << result.errors;
    return result.errors;
  };
  const std::string camera = contentOf(sequence_ + "/camera.txt");
  folder_.write("sequence/camera.txt", "160 120 140 140 79.5 59.5 5000\n");
  EXPECT_NE(noteOf().find("median depth seen 0.3"), std::string::npos);
  EXPECT_NE(noteOf().find("is the depth unit wrong (camera.txt: 5000 units per meter)? With 1000 "
                          "units per meter it would be 1."),
            std::string::npos);
  folder_.write("sequence/camera.txt", camera);
  rewrite([](unsigned value) { return value << 3 | value >> 13; });  // as SUN RGB-D has it
  EXPECT_NE(
      noteOf().find("its values are multiples of 8, as if their bits were rotated by three to "
                    "the left (SUN RGB-D)"),
      std::string::npos);
  rewrite([](unsigned value) { return value >> 3 | value << 13; });
  EXPECT_EQ(track({"--force"}).errors, "");
  rewrite([](unsigned value) { return value >> 3 | value << 13; });
  EXPECT_NE(noteOf().find("neighboring values jump, unless their 16 bits are rotated by three to "
                          "the left"),
            std::string::npos);
  rewrite([](unsigned value) { return ((value << 3 | value >> 13) & 0xFFFF) / 80 * 80; });
  EXPECT_NE(noteOf().find("it comes in steps of 0.08 m: was it stored in 8 bits"),
            std::string::npos);
  rewrite([](unsigned) { return 0; });
  EXPECT_NE(noteOf().find("the depth images have no reading at all"), std::string::npos);
}

TEST_F(RunSequenceTest, ShortFormsSetTheirParameters) {
  ASSERT_EQ(track({"--method", "ssd"}).exit_code, 0);
  const std::string ssd = contentOf(output_);
  ASSERT_EQ(track({"--force", "--set", "method=ssd"}).exit_code, 0);
  EXPECT_EQ(contentOf(output_), ssd);
  const std::string config = folder_.write("config.yaml", "method: ssd\n");
  ASSERT_EQ(track({"--force", "--config", config}).exit_code, 0);
  EXPECT_EQ(contentOf(output_), ssd);
  ASSERT_EQ(track({"--force", "--config", config, "--method", "mi"}).exit_code, 0);
  EXPECT_NE(contentOf(output_), ssd);
}

TEST_F(RunSequenceTest, ReferenceFirstKeepsOneKeyframe) {
  ProcessResult result = track({"--set", "keyframe_translation=0.001"});
  EXPECT_GT(valueOf(result.output, "keyframes"), 1);
  result = track({"--force", "--set", "keyframe_translation=0.001", "--reference", "first"});
  EXPECT_EQ(valueOf(result.output, "keyframes"), 1);
  EXPECT_LT(largestError(), kTolerance);
}

TEST_F(RunSequenceTest, DisturbanceChangesTheStartAndNotTheGoal) {
  ASSERT_EQ(track({}).exit_code, 0);
  const std::string undisturbed = contentOf(output_);
  ASSERT_EQ(track({"--force", "--disturb", "0", "0"}).exit_code, 0);
  EXPECT_EQ(contentOf(output_), undisturbed);
  ASSERT_EQ(track({"--force", "--disturb", "0.02", "0.01", "--seed", "4"}).exit_code, 0);
  const std::string disturbed = contentOf(output_);
  EXPECT_NE(disturbed, undisturbed);
  EXPECT_LT(largestError(), kTolerance);
  ASSERT_EQ(track({"--force", "--disturb", "0.02", "0.01", "--seed", "4"}).exit_code, 0);
  EXPECT_EQ(contentOf(output_), disturbed);
  ASSERT_EQ(track({"--force", "--disturb", "0.02", "0.01", "--seed", "5"}).exit_code, 0);
  EXPECT_NE(contentOf(output_), disturbed);
}

TEST_F(RunSequenceTest, BadInputIsRefusedInOneLine) {
  const std::string config = folder_.write("config.yaml", "# comment\nlevles: 3\n");
  expectRefusal(track({"--config", config}), 1, config + ":2: ");
  expectRefusal(track({"--config", folder_ / "no.yaml"}), 1, folder_ / "no.yaml");
  expectRefusal(track({"--start", "12"}), 1, "no frame left");
  expectRefusal(run("run_sequence", {folder_ / "no", "--output", output_}), 1, "no folder");
  expectRefusal(run("run_sequence", {sequence_, "--output", folder_ / "no/t.txt"}), 1,
                folder_ / "no/t.txt");
  folder_.write("sequence/camera.txt", "640 480 500 500 320 240 1000\n");
  expectRefusal(track({}), 1, "160x120");
  folder_.write("sequence/camera.txt", "160 120 140 140 79.5 wrong 1000\n");
  expectRefusal(track({}), 1, "camera.txt:1: ");
  std::filesystem::remove(sequence_ + "/camera.txt");
  expectRefusal(track({}), 1, "camera.txt");
  EXPECT_FALSE(std::filesystem::exists(output_));
}

TEST_F(RunSequenceTest, SequenceWithoutReadableFramesIsRefused) {
  for (int i = 0; i < kFrames; ++i) truncate(image(i));
  expectRefusal(track({}), 1, image(0) + " is truncated");
}

TEST_F(RunSequenceTest, WrongUsageIsRefusedInOneLine) {
  expectRefusal(run("run_sequence", {}), 2, "FOLDER");
  expectRefusal(run("run_sequence", {sequence_}), 2, "--output");
  const struct {
    std::vector<std::string> options;
    const char* text;
  } cases[] = {{{"--levels", "3"}, "unknown option '--levels'"},
               {{"--stat", "x"}, "unknown option '--stat'"},
               {{"--statistcs", "x"}, "did you mean '--statistics'?"},
               {{"more"}, "'more'"},
               {{"--method", "best"}, "ssd mi hybrid"},
               {{"--set", "levels"}, "name=value"},
               {{"--set", "levles=3"}, "'levels'"},
               {{"--set", "levels=99"}, "1 to 8"},
               {{"--threads", "0"}, "threads"},
               {{"--start", "-1"}, "start"},
               {{"--start", "x"}, "start"},
               {{"--count", "0"}, "count"},
               {{"--reference", "last"}, "first"},
               {{"--disturb", "0.1"}, "disturb"},
               {{"--disturb", "0.1", "nan"}, "disturb"},
               {{"--seed", "1"}, "--disturb"},
               {{"--statistics", output_}, "same file"}};
  for (const auto& test : cases) expectRefusal(track(test.options), 2, test.text);
  EXPECT_FALSE(std::filesystem::exists(output_));
}

TEST_F(RunSequenceTest, HelpAndVersion) {
  const ProcessResult help = run("run_sequence", {"--help"});
  EXPECT_EQ(help.exit_code, 0);
  EXPECT_EQ(help.errors, "");
  for (const char* option :
       {"--output", "--method", "--config", "--set", "--start", "--count", "--threads",
        "--statistics", "--write-lost", "--force", "--reference", "--disturb", "--seed"}) {
    EXPECT_NE(help.output.find(option), std::string::npos) << option;
  }
  const ProcessResult version = run("run_sequence", {"--version"});
  EXPECT_EQ(version.exit_code, 0);
  EXPECT_EQ(version.output.rfind("run_sequence ", 0), 0U);
}

}  // namespace
}  // namespace mivo
