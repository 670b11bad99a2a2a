// SPDX-License-Identifier: BSD-3-Clause
// The bag programs and bag.launch as processes: results, refusals, exit codes.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "mivo/io/trajectory_io.h"
#include "programs/plane_sequence.h"
#include "programs/program_fixture.h"

namespace mivo {
namespace {

class BagProgramTest : public ProgramTest {
 protected:
  static constexpr int kFrames = 12;

  BagProgramTest() { writePlaneSequence(sequence_, kFrames); }

  void makeBag(const std::vector<std::string>& options = {}) {
    std::vector<std::string> arguments = {sequence_, bag_};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const ProcessResult result = run("sequence_to_bag", arguments);
    ASSERT_EQ(0, result.exit_code) << result.errors;
  }

  std::string trackFolder(const std::string& folder) {
    const std::string output = folder_ / "folder.txt";
    const ProcessResult result = run("run_sequence", {folder, "--output", output, "--force"});
    EXPECT_EQ(0, result.exit_code) << result.errors;
    return contentOf(output);
  }

  std::string trackBag() {
    const std::string output = folder_ / "bag.txt";
    const ProcessResult result = run("run_bag", {bag_, "--output", output, "--force"});
    EXPECT_EQ(0, result.exit_code) << result.errors;
    EXPECT_EQ(kFrames, valueOf(result.output, "frames"));
    return contentOf(output);
  }

  const std::string sequence_ = folder_ / "sequence";
  const std::string bag_ = folder_ / "test.bag";
};

TEST_F(BagProgramTest, BagAndFolderGiveTheSameBits) {
  const std::string expected = trackFolder(sequence_);
  ASSERT_FALSE(expected.empty());
  for (const char* layout : {"tum", "openni2", "rtabmap", "realsense"}) {
    makeBag({"--layout", layout, "--force"});
    EXPECT_EQ(expected, trackBag()) << layout;
    makeBag({"--layout", layout, "--compressed", "--force"});
    EXPECT_EQ(expected, trackBag()) << layout << ", compressed";
  }
}

TEST_F(BagProgramTest, FoldersOfOtherLayoutsBecomeBagsOfTheSamePoses) {
  const std::string sun3d = folder_ / "sun3d";
  writeSun3dPlaneSequence(sun3d, kFrames);
  const ProcessResult result = run("sequence_to_bag", {sun3d, bag_, "--layout", "openni2"});
  ASSERT_EQ(0, result.exit_code) << result.errors;
  EXPECT_NE(result.errors.find("sequence_to_bag: note: " + sun3d + " is laid out as SUN3D"),
            std::string::npos)
      << result.errors;
  trackFolder(sun3d);
  trackBag();
  const Trajectory expected = readTrajectory(folder_ / "folder.txt");
  const Trajectory poses = readTrajectory(folder_ / "bag.txt");
  ASSERT_EQ(poses.size(), std::size_t{kFrames});
  for (std::size_t i = 0; i < poses.size(); ++i) {
    EXPECT_EQ(poses[i].stamp, expected[i].stamp);
    // A bag has whole nanoseconds: the times between frames differ by some.
    EXPECT_TRUE(poses[i].pose.isApprox(expected[i].pose, 1e-6)) << i;
  }
}

TEST_F(BagProgramTest, ImagesWithoutAPartnerAreLeftOutOfTheBagAndTold) {
  std::ofstream(sequence_ + "/rgb.txt", std::ios::app) << "200.0 rgb/none.png\n";
  std::filesystem::remove(sequence_ + "/associations.txt");
  const ProcessResult result = run("sequence_to_bag", {sequence_, bag_});
  ASSERT_EQ(0, result.exit_code) << result.errors;
  EXPECT_EQ(result.errors,
            "sequence_to_bag: note: left out (color image without a partner within 20 ms): 1\n");
  EXPECT_EQ(trackFolder(sequence_), trackBag());
}

TEST_F(BagProgramTest, ABagComesBackAsTheSameFolder) {
  makeBag({"--layout", "openni2"});
  const std::string back = folder_ / "back";
  const ProcessResult result = run("bag_to_sequence", {bag_, back});
  ASSERT_EQ(0, result.exit_code) << result.errors;
  for (const char* file : {"camera.txt", "rgb.txt", "depth.txt", "associations.txt",
                           "groundtruth.txt", "rgb/100.000000.png", "depth/100.366667.png"}) {
    const std::string original = contentOf(sequence_ + '/' + file);
    EXPECT_FALSE(original.empty()) << file;
    EXPECT_EQ(original, contentOf(back + '/' + file)) << file;
  }
  expectRefusal(run("bag_to_sequence", {bag_, back}), 1, "back");
}

TEST_F(BagProgramTest, WantedTopicsAndARangeAreTaken) {
  makeBag({"--layout", "openni2"});
  const std::string output = folder_ / "part.txt";
  const ProcessResult result =
      run("run_bag", {bag_, "--output", output, "--rgb", "/camera/rgb/image_raw", "--depth",
                      "/camera/depth_registered/image_raw", "--camera-info",
                      "/camera/rgb/camera_info", "--start", "3", "--count", "4"});
  EXPECT_EQ(0, result.exit_code) << result.errors;
  EXPECT_EQ(4, valueOf(result.output, "frames"));
}

TEST_F(BagProgramTest, BadInputIsRefusedInOneLine) {
  makeBag();
  const std::string output = folder_ / "out.txt";
  expectRefusal(run("run_bag", {folder_ / "nothing.bag", "--output", output}), 1, "nothing.bag");
  expectRefusal(run("run_bag", {folder_.write("text.bag", "text"), "--output", output}), 1,
                "text.bag");
  expectRefusal(run("run_bag", {bag_, "--output", output, "--rgb", "/no/such"}), 1, "/no/such");
  expectRefusal(run("sequence_to_bag", {sequence_, bag_}), 1, "test.bag");  // exists
  expectRefusal(run("sequence_to_bag", {folder_ / "none", folder_ / "new.bag"}), 1, "none");
  expectRefusal(run("sequence_to_bag", {sequence_, folder_ / "new.bag", "--layout", "kinect"}), 2,
                "kinect");
  expectRefusal(run("run_bag", {bag_}), 2, "output");
  expectRefusal(run("bag_to_sequence", {bag_}), 2, "FOLDER");
  for (const char* program : {"run_bag", "sequence_to_bag", "bag_to_sequence"}) {
    const ProcessResult help = run(program, {"--help"});
    EXPECT_EQ(0, help.exit_code);
    EXPECT_NE(std::string::npos, help.output.find("Usage")) << help.output;
  }
}

TEST_F(BagProgramTest, PlayedThroughTheNodeTheBitsAreTheSame) {
  makeBag({"--layout", "openni2"});
  const std::string output = folder_ / "node.txt";
  const ProcessResult result =
      runProcess(MIVO_TEST_FOLDER "/run_with_ros",
                 {MIVO_BUILD_FOLDER, "roslaunch", "--port", "0", "mivo", "bag.launch",
                  "bag:=" + bag_, "rviz:=false", "output:=" + output});
  EXPECT_EQ(0, result.exit_code) << result.output << result.errors;
  EXPECT_EQ(trackFolder(sequence_), contentOf(output)) << result.output << result.errors;
}

}  // namespace
}  // namespace mivo
