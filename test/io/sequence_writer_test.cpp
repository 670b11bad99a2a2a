// SPDX-License-Identifier: BSD-3-Clause
#include "io/sequence_writer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "io/image_file.h"
#include "mivo/io/sequence_reader.h"
#include "support/error_text.h"
#include "support/temporary_folder.h"

namespace mivo {
namespace {

const SequenceCamera kCamera{{8, 6, 10.0, 10.0, 4.0, 3.0, {}}, 5000.0};

cv::Mat gray(int value) {
  return cv::Mat(6, 8, CV_8UC1, cv::Scalar(value));
}
cv::Mat units(int value) {
  return cv::Mat(6, 8, CV_16UC1, cv::Scalar(value));
}

TEST(SequenceWriterTest, ReaderGetsWhatWasWritten) {
  const TemporaryFolder folder;
  SequenceWriter writer(folder / "new/sequence", kCamera, Overwrite::kNo);
  const cv::Mat color(6, 8, CV_8UC3, cv::Scalar(200, 100, 50));
  writer.writeFrame(1305031229.528748, color, 1305031229.528784, units(7));
  writer.writeFrame(1305031229.564425, gray(9), 1305031229.564442, units(8));
  SequenceReader reader(folder / "new/sequence");
  EXPECT_TRUE(reader.camera() == kCamera.camera);
  EXPECT_EQ(reader.depthUnitsPerMeter(), 5000.0);
  ASSERT_EQ(reader.size(), 2U);
  Frame frame;
  FrameFault fault;
  ASSERT_EQ(reader.next(frame, fault), FrameSource::Status::kFrame);
  EXPECT_NEAR(frame.stamp, 1305031229.528748, 5e-7);
  EXPECT_EQ(frame.image.at<unsigned char>(0, 0),
            toGray(color, ChannelOrder::kBgr).at<unsigned char>(0, 0));
  EXPECT_EQ(frame.depth.at<unsigned short>(5, 7), 7);
  ASSERT_EQ(reader.next(frame, fault), FrameSource::Status::kFrame);
  EXPECT_EQ(frame.image.at<unsigned char>(2, 2), 9);
  EXPECT_EQ(contentOf(folder / "new/sequence/depth.txt"),
            "# stamp path\n1305031229.528784 depth/1305031229.528784.png\n"
            "1305031229.564442 depth/1305031229.564442.png\n");
}

TEST(SequenceWriterTest, DepthInMetersIsRoundedToUnits) {
  const TemporaryFolder folder;
  SequenceWriter writer(folder / "s", kCamera, Overwrite::kNo);
  cv::Mat meters(6, 8, CV_32FC1, cv::Scalar(1.00009));
  const float infinity = std::numeric_limits<float>::infinity();
  const float unusable[] = {std::nanf(""), infinity, -infinity, -1.0F, 0.0F, 13.108F};
  for (int i = 0; i < 6; ++i) meters.at<float>(0, i) = unusable[i];
  meters.at<float>(1, 0) = 13.107F;  // 65535 units
  writer.writeFrame(1.0, gray(0), 1.0, meters);
  const cv::Mat stored = readImage(folder / "s/depth/1.000000.png");
  ASSERT_EQ(stored.type(), CV_16UC1);
  for (int i = 0; i < 6; ++i) EXPECT_EQ(stored.at<unsigned short>(0, i), 0) << unusable[i];
  EXPECT_EQ(stored.at<unsigned short>(1, 0), 65535);
  EXPECT_EQ(stored.at<unsigned short>(3, 3), 5000);
}

TEST(SequenceWriterTest, TruthIsATrajectory) {
  const TemporaryFolder folder;
  SequenceWriter writer(folder / "s", kCamera, Overwrite::kNo);
  EXPECT_FALSE(std::filesystem::exists(folder / "s/groundtruth.txt"));
  writer.writePose({0.5, Eigen::Isometry3d::Identity()});
  EXPECT_EQ(readTrajectory(folder / "s/groundtruth.txt").front().stamp, 0.5);
}

TEST(SequenceWriterTest, RefusesFramesThatDoNotFit) {
  const TemporaryFolder folder;
  SequenceWriter writer(folder / "s", kCamera, Overwrite::kNo);
  const double nan = std::nan("");
  writer.writeFrame(1.0, gray(1), 1.0, units(1));
  EXPECT_THROW(writer.writeFrame(1.0, gray(1), 1.1, units(1)), Error);
  EXPECT_THROW(writer.writeFrame(0.9, gray(1), 1.1, units(1)), Error);
  EXPECT_THROW(writer.writeFrame(1.0000001, gray(1), 1.1, units(1)), Error);  // the same name
  EXPECT_THROW(writer.writeFrame(1.1, gray(1), 1.0000001, units(1)), Error);
  EXPECT_THROW(writer.writeFrame(nan, gray(1), 1.1, units(1)), Error);
  EXPECT_THROW(writer.writeFrame(1.1, gray(1), nan, units(1)), Error);
  EXPECT_THROW(writer.writeFrame(1.1, cv::Mat(5, 8, CV_8UC1), 1.1, units(1)), Error);
  EXPECT_THROW(writer.writeFrame(1.1, gray(1), 1.1, cv::Mat(6, 9, CV_16UC1)), Error);
  EXPECT_THROW(writer.writeFrame(1.1, cv::Mat(6, 8, CV_32FC1), 1.1, units(1)), Error);
  EXPECT_THROW(writer.writeFrame(1.1, gray(1), 1.1, cv::Mat(6, 8, CV_64FC1)), Error);
  writer.writeFrame(1.1, gray(1), 1.1, units(1));
  EXPECT_EQ(SequenceReader(folder / "s").size(), 2U);
}

TEST(SequenceWriterTest, SequenceIsReplacedOnlyOnDemandAndNothingElse) {
  const TemporaryFolder folder;
  {
    SequenceWriter writer(folder / "s", kCamera, Overwrite::kNo);
    writer.writeFrame(1.0, gray(1), 1.0, units(1));
    writer.writePose({1.0, Eigen::Isometry3d::Identity()});
  }
  folder.write("s/notes.txt", "mine");
  EXPECT_THROW(SequenceWriter(folder / "s", kCamera, Overwrite::kNo), Error);
  EXPECT_EQ(SequenceReader(folder / "s").size(), 1U);
  SequenceWriter writer(folder / "s", kCamera, Overwrite::kYes);
  writer.writeFrame(2.0, gray(1), 2.0, units(1));
  EXPECT_FALSE(std::filesystem::exists(folder / "s/rgb/1.000000.png"));
  EXPECT_FALSE(std::filesystem::exists(folder / "s/groundtruth.txt"));
  EXPECT_EQ(contentOf(folder / "s/notes.txt"), "mine");
  EXPECT_EQ(SequenceReader(folder / "s").size(), 1U);
}

TEST(SequenceWriterTest, RefusesWhereNoFolderCanBe) {
  const TemporaryFolder folder;
  const std::string file = folder.write("file", "");
  EXPECT_NE(errorText([&] { SequenceWriter(file, kCamera, Overwrite::kYes); }).find(file),
            std::string::npos);
  SequenceCamera camera = kCamera;
  camera.depth_units_per_meter = 0.0;
  EXPECT_THROW(SequenceWriter(folder / "s", camera, Overwrite::kNo), Error);
}

}  // namespace
}  // namespace mivo
