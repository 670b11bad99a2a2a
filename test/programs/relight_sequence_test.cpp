// SPDX-License-Identifier: BSD-3-Clause
// relight_sequence as a process: what changes, and what does not.
#include <filesystem>
#include <opencv2/core.hpp>

#include "mivo/io/sequence_reader.h"
#include "programs/plane_sequence.h"
#include "programs/program_fixture.h"

namespace mivo {
namespace {

constexpr int kFrames = 4;

class RelightSequenceTest : public ProgramTest {
 protected:
  void relight() {
    const ProcessResult result = run("relight_sequence", {in_, out_, "--lighting", "inversion"});
    ASSERT_EQ(result.exit_code, 0) << result.errors;
  }

  /// Whether all frames have the depth and the stamps of the original, and other images.
  void expectOtherImagesOnly() {
    SequenceReader original(in_);
    SequenceReader copy(out_);
    ASSERT_EQ(copy.size(), original.size());
    EXPECT_EQ(copy.camera(), original.camera());
    double change = 0.0;
    for (std::size_t i = 0; i < original.size(); ++i) {
      Frame expected;
      Frame frame;
      FrameFault fault;
      ASSERT_EQ(original.next(expected, fault), FrameSource::Status::kFrame) << fault.text;
      ASSERT_EQ(copy.next(frame, fault), FrameSource::Status::kFrame) << fault.text;
      EXPECT_EQ(frame.stamp, expected.stamp);
      EXPECT_EQ(cv::norm(frame.depth, expected.depth, cv::NORM_INF), 0.0);
      change = std::max(change, cv::norm(frame.image, expected.image, cv::NORM_INF));
    }
    EXPECT_GT(change, 30.0);
  }

  const std::string in_ = folder_ / "in";
  const std::string out_ = folder_ / "out";
};

TEST_F(RelightSequenceTest, ListsDepthAndTruthOfTumStayByteForByte) {
  writePlaneSequence(in_, kFrames);
  relight();
  expectOtherImagesOnly();
  for (const char* file :
       {"rgb.txt", "depth.txt", "associations.txt", "groundtruth.txt", "camera.txt"}) {
    EXPECT_EQ(contentOf(out_ + '/' + file), contentOf(in_ + '/' + file)) << file;
  }
}

TEST_F(RelightSequenceTest, OtherLayoutsStayWhatTheyAre) {
  writeSun3dPlaneSequence(in_, kFrames);
  relight();
  expectOtherImagesOnly();
  EXPECT_EQ(contentOf(out_ + "/intrinsics.txt"), contentOf(in_ + "/intrinsics.txt"));
  EXPECT_NE(SequenceReader(out_).notice().find("is laid out as SUN3D"), std::string::npos);
}

TEST_F(RelightSequenceTest, ForceReplacesTheImagesOfAnotherLayout) {
  writePlaneSequence(in_, kFrames);
  writeSun3dPlaneSequence(out_, kFrames + 1);
  expectRefusal(run("relight_sequence", {in_, out_, "--lighting", "inversion"}), 1, "is not empty");
  const ProcessResult result =
      run("relight_sequence", {in_, out_, "--lighting", "inversion", "--force"});
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  expectOtherImagesOnly();
  EXPECT_TRUE(std::filesystem::is_empty(out_ + "/image"));
}

TEST_F(RelightSequenceTest, ACopyInsideOfTheFolderIsNotCopiedIntoItself) {
  writeSun3dPlaneSequence(in_, kFrames);
  const std::string inner = in_ + "/relit";
  const ProcessResult result = run("relight_sequence", {in_, inner, "--lighting", "inversion"});
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_FALSE(std::filesystem::exists(inner + "/relit"));
}

TEST_F(RelightSequenceTest, PathsThatLeaveTheFolderAreRefused) {
  writePlaneSequence(in_, kFrames);
  std::filesystem::copy_file(in_ + "/rgb/100.000000.png", folder_ / "outside.png");
  std::filesystem::copy_file(in_ + "/depth/100.000000.png", folder_ / "depth.png");
  folder_.write("in/associations.txt", "100 ../outside.png 100 ../depth.png\n");
  expectRefusal(run("relight_sequence", {in_, out_, "--lighting", "inversion"}), 1,
                "leaves the sequence folder");
}

}  // namespace
}  // namespace mivo
