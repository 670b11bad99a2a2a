// SPDX-License-Identifier: BSD-3-Clause
// Sequence folders of other data sets: each layout, and each difference from TUM's in lists,
// images, stamps and cameras.
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

#include "mivo/core/error.h"
#include "mivo/io/sequence_reader.h"
#include "support/error_text.h"
#include "support/temporary_folder.h"

namespace mivo {
namespace {

/// Three frames of one color each: image i is 10 (i + 1) gray, its depth 1000 (i + 1).
class SequenceLayoutTest : public ::testing::Test {
 protected:
  static constexpr int kWidth = 8;
  static constexpr int kHeight = 6;

  static int gray(int i) { return 10 * (i + 1); }
  static int depth(int i) { return 1000 * (i + 1); }

  void writeImage(const std::string& name, const cv::Mat& image) {
    const std::string path = folder_.write(name, "");
    ASSERT_TRUE(cv::imwrite(path, image)) << path;
  }
  void writeColor(const std::string& name, int i, int width = kWidth, int height = kHeight) {
    writeImage(name, cv::Mat(height, width, CV_8UC3, cv::Scalar::all(gray(i))));
  }
  void writeDepth(const std::string& name, int value) {
    writeImage(name, cv::Mat(kHeight, kWidth, CV_16UC1, cv::Scalar(value)));
  }

  /// rgb/0.png to depth/2.png, and camera.txt; the lists are the test's.
  void writeTumImages() {
    folder_.write("camera.txt", "8 6 10 10 4 3 1000\n");
    for (int i = 0; i < 3; ++i) {
      writeColor("rgb/" + std::to_string(i) + ".png", i);
      writeDepth("depth/" + std::to_string(i) + ".png", depth(i));
    }
  }
  static std::string pairLine(const std::string& stamp, int i) {
    return stamp + " rgb/" + std::to_string(i) + ".png " + stamp + " depth/" + std::to_string(i) +
           ".png\n";
  }
  void writeLists(const std::vector<std::string>& color, const std::vector<std::string>& depths) {
    std::string images;
    std::string depth_images;
    for (std::size_t i = 0; i < color.size(); ++i) {
      images += color[i] + " rgb/" + std::to_string(i) + ".png\n";
    }
    for (std::size_t i = 0; i < depths.size(); ++i) {
      depth_images += depths[i] + " depth/" + std::to_string(i) + ".png\n";
    }
    folder_.write("rgb.txt", images);
    folder_.write("depth.txt", depth_images);
  }

  /// Expects frames with these numbers, stamps and the gray and depth that belong to them.
  void expectFrames(SequenceReader& reader, const std::vector<int>& numbers,
                    const std::vector<double>& stamps) {
    ASSERT_EQ(reader.size(), numbers.size());
    Frame frame;
    FrameFault fault;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      ASSERT_EQ(reader.next(frame, fault), FrameSource::Status::kFrame) << fault.text;
      EXPECT_NEAR(frame.stamp, stamps[i], 1e-6);
      EXPECT_NEAR(frame.image.at<unsigned char>(3, 4), gray(numbers[i]), 1.0);
      EXPECT_EQ(frame.depth.at<unsigned short>(3, 4), depth(numbers[i]));
      EXPECT_EQ(findFault(frame, reader.camera()), "");
    }
  }
  void expectThreeFrames(const std::vector<double>& stamps) {
    SequenceReader reader(folder_.path());
    expectFrames(reader, {0, 1, 2}, stamps);
  }
  void expectNotice(const std::string& text) {
    const std::string notice = SequenceReader(folder_.path()).notice();
    EXPECT_NE(notice.find(text), std::string::npos) << notice;
  }
  void expectCamera(double fx, double fy, double cx, double cy, double units) {
    const SequenceReader reader(folder_.path());
    EXPECT_NEAR(reader.camera().fx, fx, 1e-9);
    EXPECT_NEAR(reader.camera().fy, fy, 1e-9);
    EXPECT_NEAR(reader.camera().cx, cx, 1e-9);
    EXPECT_NEAR(reader.camera().cy, cy, 1e-9);
    EXPECT_EQ(reader.camera().width, kWidth);
    EXPECT_EQ(reader.camera().height, kHeight);
    EXPECT_EQ(reader.depthUnitsPerMeter(), units);
  }
  void expectRefusal(const std::string& text) {
    const std::string error = errorText([&] { SequenceReader(folder_.path()); });
    EXPECT_NE(error.find(text), std::string::npos) << error;
  }

  TemporaryFolder folder_;
};

using SequenceListTest = SequenceLayoutTest;
using SequenceImageTest = SequenceLayoutTest;
using SequenceStampTest = SequenceLayoutTest;

TEST_F(SequenceListTest, DepthFirstIsRecognizedByTheImages) {
  writeTumImages();
  folder_.write("associations.txt",
                "7 depth/0.png 7.01 rgb/0.png\n8 depth/1.png 8.01 rgb/1.png\n"
                "9 depth/2.png 9.01 rgb/2.png\n");
  expectThreeFrames({7.01, 8.01, 9.01});
  expectNotice("associations.txt names depth first");
}

TEST_F(SequenceListTest, DepthFirstOfA16BitGrayCameraByTheFolder) {
  writeTumImages();
  for (int i = 0; i < 3; ++i) {
    writeImage("rgb/" + std::to_string(i) + ".png",
               cv::Mat(kHeight, kWidth, CV_16UC1, cv::Scalar(257 * gray(i))));
  }
  writeImage("rgb/2.png", cv::Mat(kHeight, kWidth, CV_16UC1, cv::Scalar(65535)));
  folder_.write("associations.txt", "1 depth/0.png 1 rgb/0.png\n2 depth/1.png 2 rgb/1.png\n");
  SequenceReader reader(folder_.path());
  EXPECT_NE(reader.notice().find("depth first"), std::string::npos);
  Frame frame;
  FrameFault fault;
  ASSERT_EQ(reader.next(frame, fault), FrameSource::Status::kFrame);
  EXPECT_EQ(frame.depth.at<unsigned short>(0, 0), depth(0));
}

TEST_F(SequenceListTest, ReversedShuffledAndDoubledLinesAreToldOnce) {
  writeTumImages();
  const std::string line[] = {pairLine("1.0", 0), pairLine("1.1", 1), pairLine("1.2", 2)};
  const struct {
    std::string lines;
    std::string notice;
  } cases[] = {
      {line[2] + line[1] + line[0], "were not in the order of their stamps and are sorted"},
      {line[1] + line[2] + line[0], "were not in the order of their stamps and are sorted"},
      {line[0] + line[0] + line[1] + line[1] + line[2] + line[2], "3 of the lines of"}};
  for (const auto& test : cases) {
    folder_.write("associations.txt", test.lines);
    expectThreeFrames({1.0, 1.1, 1.2});
    expectNotice(test.notice);
  }
}

TEST_F(SequenceListTest, BlanksInPaths) {
  folder_.write("camera.txt", "8 6 10 10 4 3 1000\n");
  std::string pairs;
  std::string quoted;
  std::string images;
  std::string depths;
  for (int i = 0; i < 3; ++i) {
    const std::string stamp = std::to_string(i) + ".5";
    const std::string color_name = "my  rgb/color 1 " + std::to_string(i) + ".png";
    const std::string depth_name = "my depth/2 deep " + std::to_string(i) + ".png";
    writeColor(color_name, i);
    writeDepth(depth_name, depth(i));
    images += stamp + "\t" + color_name + " \r\n";
    depths += stamp + " \"" + depth_name + "\"\n";
    pairs += stamp + " " + color_name + " " + stamp + " " + depth_name + "\n";
    quoted += stamp + " \"" + color_name + "\" " + stamp + " \"" + depth_name + "\"\n";
  }
  folder_.write("rgb.txt", images);
  folder_.write("depth.txt", depths);
  expectThreeFrames({0.5, 1.5, 2.5});
  for (const std::string& lines : {pairs, quoted}) {
    folder_.write("associations.txt", lines);
    expectThreeFrames({0.5, 1.5, 2.5});
  }
  folder_.write("associations.txt",
                "0 a picture.txt 0 b.png\n");  // no image's name before a number
  expectRefusal("associations.txt:1: expected 'stamp_rgb path stamp_depth path'");
}

TEST_F(SequenceListTest, ByteOrderMarkAndEndsOfLinesOfAnySystem) {
  writeTumImages();
  for (const std::string end : {"\n", "\r\n", "\r"}) {
    std::string lines = "\xEF\xBB\xBF# comment" + end;
    for (int i = 0; i < 3; ++i) {
      lines += pairLine(std::to_string(i), i);
      lines.replace(lines.size() - 1, 1, end);
    }
    folder_.write("associations.txt", lines);
    expectThreeFrames({0.0, 1.0, 2.0});
  }
}

TEST_F(SequenceImageTest, JpegColor) {
  folder_.write("camera.txt", "8 6 10 10 4 3 1000\n");
  std::string lines;
  for (int i = 0; i < 3; ++i) {
    const std::string number = std::to_string(i);
    writeColor("rgb/" + number + ".jpg", i);
    writeDepth("depth/" + number + ".png", depth(i));
    lines += number + " rgb/" + number + ".jpg " + number + " depth/" + number + ".png\n";
  }
  folder_.write("associations.txt", lines);
  expectThreeFrames({0.0, 1.0, 2.0});
}

TEST_F(SequenceImageTest, GrayAndColorOf10To16Bits) {
  for (const int type : {CV_16UC1, CV_16UC3, CV_16UC4}) {
    for (const int factor : {1, 4, 16, 64, 257}) {  // 8, 10, 12, 14, 16 bits
      writeTumImages();
      for (int i = 0; i < 3; ++i) {
        cv::Mat image(kHeight, kWidth, type, cv::Scalar::all(factor * gray(i)));
        image.at<unsigned short>(0, 0) = static_cast<unsigned short>(factor * 255);
        writeImage("rgb/" + std::to_string(i) + ".png", image);
      }
      writeLists({"0", "1", "2"}, {"0", "1", "2"});
      expectThreeFrames({0.0, 1.0, 2.0});
    }
  }
}

TEST_F(SequenceImageTest, ColorLargerByAWholeFactor) {
  writeTumImages();
  for (int i = 0; i < 3; ++i) {
    writeColor("rgb/" + std::to_string(i) + ".png", i, 3 * kWidth, 3 * kHeight);
  }
  writeLists({"0", "1", "2"}, {"0", "1", "2"});
  expectThreeFrames({0.0, 1.0, 2.0});  // the camera is that of depth
  expectCamera(10.0, 10.0, 4.0, 3.0, 1000.0);
  expectNotice("color of 24x18 pixels is reduced to the size of depth, 8x6");

  folder_.write("camera.txt", "24 18 30 36 13 10 1000\n");  // that of color
  SequenceReader large(folder_.path());
  EXPECT_EQ(large.camera().fx, 30.0);
  EXPECT_EQ(large.camera().width, 24);
  Frame large_frame;
  FrameFault no_fault;
  for (int i = 0; i < 3; ++i) {
    ASSERT_EQ(large.next(large_frame, no_fault), FrameSource::Status::kFrame);
    EXPECT_EQ(findFault(large_frame, large.camera()), "");
    EXPECT_EQ(large_frame.depth.at<float>(9, 11), 0.001F * static_cast<float>(depth(i)));
  }
  expectNotice("depth of 8x6 pixels is enlarged to the size of color, 24x18");

  folder_.write("camera.txt", "16 12 20 20 8 6 1000\n");  // neither
  expectRefusal("24x18 pixels, but the camera 16x12");
  folder_.write("camera.txt", "24 18 30 36 13 10 1000\n");
  writeColor("rgb/1.png", 1, 2 * kWidth, 2 * kHeight);
  SequenceReader reader(folder_.path());
  Frame frame;
  FrameFault fault;
  EXPECT_EQ(reader.next(frame, fault), FrameSource::Status::kFrame);
  EXPECT_EQ(reader.next(frame, fault), FrameSource::Status::kSkipped);
  EXPECT_EQ(reader.next(frame, fault), FrameSource::Status::kFrame);
}

TEST_F(SequenceStampTest, WholeNanoMicroAndMillisecondsAreSeconds) {
  writeTumImages();
  const struct {
    std::vector<std::string> stamps;
    double first;
    const char* unit;
  } cases[] = {
      {{"1305031102175304064", "1305031102208637440", "1305031102241970688"},
       1305031102.175304,
       "nanoseconds"},
      {{"1305031102175304", "1305031102208637", "1305031102241971"},
       1305031102.175304,
       "microseconds"},
      {{"1305031102175", "1305031102208", "1305031102242"}, 1305031102.175, "milliseconds"},
      {{"5000000000", "5033333333", "5066666667"}, 5.0, "nanoseconds"},
      {{"0", "33333", "66667"}, 0.0, "microseconds"}};
  for (const auto& test : cases) {
    writeLists(test.stamps, test.stamps);
    const double tolerance = 0.001;
    SequenceReader reader(folder_.path());
    Frame frame;
    FrameFault fault;
    for (int i = 0; i < 3; ++i) {
      ASSERT_EQ(reader.next(frame, fault), FrameSource::Status::kFrame);
      EXPECT_NEAR(frame.stamp, test.first + i / 30.0, tolerance);
    }
    expectNotice(test.unit);
  }
}

TEST_F(SequenceStampTest, ZeroAmongTimesOfDayIsNoStamp) {
  writeTumImages();
  folder_.write("associations.txt",
                pairLine("0", 0) + pairLine("0", 1) + pairLine("1600000001.5", 2));
  SequenceReader reader(folder_.path());
  expectFrames(reader, {2}, {1600000001.5});
  expectNotice("2 of the lines of");
  expectNotice("left out: their stamp is zero");
  folder_.write("associations.txt", pairLine("0", 0) + pairLine("1", 1) + pairLine("2", 2));
  expectThreeFrames({0.0, 1.0, 2.0});
}

TEST_F(SequenceStampTest, WhatHasNoPartnerIsTold) {
  writeTumImages();
  writeLists({"1.00", "1.10", "1.20"}, {"1.00", "1.19"});
  EXPECT_EQ(SequenceReader(folder_.path()).size(), 2U);
  const std::map<std::string, std::size_t> alone = {
      {"color image without a partner within 20 ms", 1}};
  EXPECT_EQ(SequenceReader(folder_.path()).leftOut(), alone);
  writeLists({"1.00", "1.03", "1.09"}, {"1.50"});
  expectRefusal(
      "no depth image is within 20 ms of a color image; from color to the nearest depth "
      "it is +0.470 s at the median");
}

TEST_F(SequenceStampTest, ColorAndDepthOfTwoClocksAreNotPaired) {
  writeTumImages();
  // 0.7 s are 7 images here: equal stamps would pair image 7 with depth 0.
  std::string images;
  std::string depths;
  for (int i = 0; i < 20; ++i) {
    images += std::to_string(1.0 + 0.1 * i) + " rgb/0.png\n";
    depths += std::to_string(1.7 + 0.1 * i) + " depth/0.png\n";
  }
  folder_.write("rgb.txt", images);
  folder_.write("depth.txt", depths);
  expectRefusal("depth is stamped 0.700 s later than color: two clocks");
}

TEST_F(SequenceLayoutTest, IclNuim) {
  // As its zip is: frame numbers for stamps, depth first, no camera.
  for (int i = 0; i < 3; ++i) {
    writeImage("rgb/" + std::to_string(i) + ".png",
               cv::Mat(480, 640, CV_8UC3, cv::Scalar::all(gray(i))));
    writeImage("depth/" + std::to_string(i) + ".png",
               cv::Mat(480, 640, CV_16UC1, cv::Scalar(depth(i))));
  }
  folder_.write(
      "associations.txt",
      "0 depth/0.png 0 rgb/0.png\n1 depth/1.png 1 rgb/1.png\n2 depth/2.png 2 rgb/2.png\n");
  for (const bool has_truth : {false, true}) {
    if (has_truth) folder_.write("livingRoom1.gt.freiburg", "0 0 0 0 0 0 0 1\n");
    expectThreeFrames({0.0, 1.0, 2.0});
    SequenceReader reader(folder_.path());
    EXPECT_EQ(reader.camera().fx, 481.20);
    EXPECT_EQ(reader.camera().fy, 480.00);
    EXPECT_EQ(reader.depthUnitsPerMeter(), 5000.0);
    expectNotice("is laid out as ICL-NUIM");
    expectNotice("ty, qx and qz change their signs");
  }
}

TEST_F(SequenceLayoutTest, NegativeFocalLengthIsExplained) {
  writeTumImages();
  writeLists({"0", "1", "2"}, {"0", "1", "2"});
  folder_.write("camera.txt", "8 6 10 -10 4 3 1000\n");
  expectRefusal("camera.txt:1: fy is -10: ICL-NUIM");
  expectRefusal("Write 10; in the true poses ty, qx and qz change their signs");
}

TEST_F(SequenceLayoutTest, Eth3d) {
  writeTumImages();
  std::filesystem::remove(folder_ / "camera.txt");
  folder_.write("calibration.txt", "10 11 4 3\n");
  folder_.write("associated.txt", pairLine("1", 0) + pairLine("2", 1) + pairLine("3", 2));
  writeLists({"1", "2", "3"}, {"1", "2", "3"});
  expectThreeFrames({1.0, 2.0, 3.0});
  expectCamera(10.0, 11.0, 4.0, 3.0, 5000.0);
  expectNotice("is laid out as ETH3D-SLAM");
  folder_.write("calibration.txt", "10 11 4\n");
  expectRefusal("calibration.txt:1: expected 'fx fy cx cy'");
}

TEST_F(SequenceLayoutTest, Bonn) {
  const std::string name = "rgbd_bonn_balloon";
  writeImage(name + "/rgb/1.png", cv::Mat(480, 640, CV_8UC3, cv::Scalar::all(1)));
  writeImage(name + "/depth/1.png", cv::Mat(480, 640, CV_16UC1, cv::Scalar(1)));
  folder_.write(name + "/rgb.txt", "1 rgb/1.png\n");
  folder_.write(name + "/depth.txt", "1 depth/1.png\n");
  const SequenceReader reader(folder_ / name);
  EXPECT_EQ(reader.camera().fx, 542.822841);
  EXPECT_EQ(reader.camera().distortion.k2, -0.099343);
  EXPECT_EQ(reader.depthUnitsPerMeter(), 5000.0);
  EXPECT_NE(reader.notice().find("published camera of Bonn's dynamic sequences"),
            std::string::npos);
}

TEST_F(SequenceLayoutTest, SevenScenes) {
  for (int i = 0; i < 3; ++i) {
    const std::string frame = "seq-01/frame-00000" + std::to_string(i);
    writeImage(frame + ".color.png", cv::Mat(480, 640, CV_8UC3, cv::Scalar::all(gray(i))));
    cv::Mat depths(480, 640, CV_16UC1, cv::Scalar(depth(i)));
    depths.at<unsigned short>(0, 0) = 65535;
    writeImage(frame + ".depth.png", depths);
    folder_.write(frame + ".pose.txt", "1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n");
  }
  SequenceReader reader(folder_ / "seq-01");
  EXPECT_NE(reader.notice().find("is laid out as 7-Scenes"), std::string::npos);
  EXPECT_NE(reader.notice().find("30 Hz are assumed"), std::string::npos);
  EXPECT_NE(reader.notice().find("not registered"), std::string::npos);
  EXPECT_EQ(reader.camera().fx, 585.0);
  EXPECT_EQ(reader.depthUnitsPerMeter(), 1000.0);
  expectFrames(reader, {0, 1, 2}, {0.0, 1.0 / 30.0, 2.0 / 30.0});
  SequenceReader again(folder_ / "seq-01");
  Frame frame;
  FrameFault fault;
  again.next(frame, fault);
  EXPECT_EQ(frame.depth.at<unsigned short>(0, 0), 0);  // 65535: no reading
  // The error for the parent folder names the folder to use.
  expectRefusal("a folder in it has: seq-01");

  folder_.write("camera-intrinsics.txt", "570 0 320\n0 571 240\n0 0 1\n");  // as 3DMatch has it
  const SequenceReader other(folder_ / "seq-01");
  EXPECT_EQ(other.camera().fy, 571.0);
  EXPECT_NE(other.notice().find("is laid out as 3DMatch"), std::string::npos);
  folder_.write("camera-intrinsics.txt", "570 0 320\n0 571 240\n0 1 1\n");
  const std::string error = errorText([&] { SequenceReader(folder_ / "seq-01"); });
  EXPECT_NE(error.find("camera-intrinsics.txt:3: the last row of K is not 0 0 1"),
            std::string::npos)
      << error;
}

TEST_F(SequenceLayoutTest, ScanNet) {
  for (int i = 0; i < 3; ++i) {
    const std::string number = std::to_string(i);
    writeColor("color/" + number + ".jpg", i, 17, 13);
    writeDepth("depth/" + number + ".png", depth(i));
  }
  folder_.write("intrinsic/intrinsic_depth.txt", "10 0 4 0\n0 11 3 0\n0 0 1 0\n0 0 0 1\n");
  folder_.write("intrinsic/intrinsic_color.txt", "20 0 8 0\n0 22 6 0\n0 0 1 0\n0 0 0 1\n");
  expectThreeFrames({0.0, 1.0 / 30.0, 2.0 / 30.0});
  expectCamera(10.0, 11.0, 4.0, 3.0, 1000.0);
  expectNotice("is laid out as ScanNet");
  expectNotice("color of 17x13 pixels is reduced to the size of depth, 8x6");
}

TEST_F(SequenceLayoutTest, ScanNetOfTheSensorStreamReader) {
  for (int i = 0; i < 3; ++i) {
    const std::string frame = "frame-00000" + std::to_string(i);
    writeColor(frame + ".color.jpg", i, 17, 13);
    writeDepth(frame + ".depth.pgm", depth(i));
  }
  folder_.write("_info.txt",
                "m_versionNumber = 4\nm_sensorName = StructureSensor\nm_depthShift = 2000\n"
                "m_calibrationDepthIntrinsic = 10 0 4 0 0 11 3 0 0 0 1 0 0 0 0 1 \n");
  expectThreeFrames({0.0, 1.0 / 30.0, 2.0 / 30.0});
  expectCamera(10.0, 11.0, 4.0, 3.0, 2000.0);
  expectNotice("is laid out as ScanNet");
}

TEST_F(SequenceLayoutTest, Sun3d) {
  const int high[] = {1000, 2000, 3000};
  for (int i = 0; i < 3; ++i) {
    const std::string number = "000000" + std::to_string(i + 1);
    writeColor("image/" + number + "-00000" + std::to_string(1033333 + 33333 * i) + ".jpg", i);
    writeDepth("depth/" + number + "-00000" + std::to_string(1040000 + 33333 * i) + ".png",
               high[i] << 3);
  }
  folder_.write("intrinsics.txt", "10 0 4\n0 11 3\n0 0 1\n");
  expectThreeFrames({1.033333, 1.066666, 1.099999});
  expectCamera(10.0, 11.0, 4.0, 3.0, 1000.0);
  expectNotice("is laid out as SUN3D");
  // 8193 mm: the highest bit is rotated to the lowest.
  for (const auto& entry : std::filesystem::directory_iterator(folder_ / "depth")) {
    cv::imwrite(entry.path().string(), cv::Mat(kHeight, kWidth, CV_16UC1, cv::Scalar(9)));
  }
  SequenceReader reader(folder_.path());
  Frame frame;
  FrameFault fault;
  ASSERT_EQ(reader.next(frame, fault), FrameSource::Status::kFrame);
  EXPECT_EQ(frame.depth.at<unsigned short>(0, 0), 8193);
}

TEST_F(SequenceLayoutTest, NumberedFoldersBesideACamera) {
  folder_.write("camera.txt", "8 6 10 11 4 3 1000\n");
  for (int i = 0; i < 3; ++i) {
    writeColor("color/00000" + std::to_string(i + 5) + ".jpg", i);
    writeDepth("depth/" + std::to_string(i + 5) + ".png", depth(i));
  }
  expectThreeFrames({5.0 / 30.0, 6.0 / 30.0, 7.0 / 30.0});
  expectCamera(10.0, 11.0, 4.0, 3.0, 1000.0);
  expectNotice("numbered images in color and depth");
}

TEST_F(SequenceLayoutTest, CamerasThatCannotBeRightAreRefusedOrDoubted) {
  writeTumImages();
  writeLists({"0", "1", "2"}, {"0", "1", "2"});
  folder_.write("camera.txt", "8 6 100 100 4 3 1000\n");
  expectRefusal("camera.txt:1: camera: with a focal length of 100 pixels images of 8 x 6 span 4.5");
  folder_.write("camera.txt", "8 6 0.1 0.1 4 3 1000\n");
  expectRefusal("camera.txt:1: camera: with a focal length of 0.1 pixels");
  folder_.write("camera.txt", "8 6 20 20 7.51 5.51 1000\n");
  expectRefusal(
      "the principal point (7.51, 5.51) lies outside of images of 8 x 6 pixels: is the "
      "calibration for images of 16 x 12 pixels?");
  folder_.write("camera.txt", "8 6 5 5 1.5 1 1000\n");
  expectNotice(
      "camera.txt: the principal point (1.5, 1) is far from the center of images of 8 x 6 "
      "pixels: is the calibration for images of 4 x 3 pixels?");
}

TEST_F(SequenceLayoutTest, OtherFoldersAreRefusedWithWhatIsMissing) {
  expectRefusal("is no sequence folder: it has neither rgb.txt and depth.txt (TUM)");
  folder_.write("rgb.txt", "0 rgb/0.png\n");
  expectRefusal("no camera.txt");
}

}  // namespace
}  // namespace mivo
