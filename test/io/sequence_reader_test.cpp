// SPDX-License-Identifier: BSD-3-Clause
#include "mivo/io/sequence_reader.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "io/image_file.h"
#include "support/error_text.h"
#include "support/temporary_folder.h"

namespace mivo {
namespace {

constexpr int kWidth = 8;
constexpr int kHeight = 6;

/// Three frames with their number as pixel values; the tests write lists and images themselves.
class SequenceReaderTest : public ::testing::Test {
 protected:
  SequenceReaderTest() {
    folder_.write("camera.txt", "8 6 10 10 4 3 5000\n");
    std::filesystem::create_directories(folder_ / "rgb");
    std::filesystem::create_directories(folder_ / "depth");
    std::string images = "# comment\n";
    std::string depths = "# comment\n";
    for (int i = 0; i < 3; ++i) {
      const std::string name = std::to_string(i) + ".png";
      writePng(folder_ / ("rgb/" + name), cv::Mat(kHeight, kWidth, CV_8UC1, cv::Scalar(10 * i)),
               Overwrite::kNo);
      writePng(folder_ / ("depth/" + name), cv::Mat(kHeight, kWidth, CV_16UC1, cv::Scalar(100 * i)),
               Overwrite::kNo);
      images += std::to_string(i) + ".0 rgb/" + name + "\n";
      depths += std::to_string(i) + ".015 depth/" + name + "\n";
    }
    folder_.write("rgb.txt", images);
    folder_.write("depth.txt", depths);
  }

  /// Reads to the end: "F<stamp>" for a frame, "S<fault>" for a skipped one.
  std::vector<std::string> readAll(const FrameRange& range = {}) {
    SequenceReader reader(folder_.path(), range);
    std::vector<std::string> events;
    Frame frame;
    FrameFault fault;
    for (;;) {
      const auto status = reader.next(frame, fault);
      if (status == FrameSource::Status::kEnd) return events;
      events.push_back(status == FrameSource::Status::kFrame
                           ? "F" + std::to_string(static_cast<int>(frame.stamp))
                           : "S" + fault.text);
    }
  }

  std::string openError(const FrameRange& range = {}) {
    return errorText([&] { SequenceReader(folder_.path(), range); });
  }

  void truncate(const std::string& name) {
    const std::string bytes = contentOf(folder_ / name);
    folder_.write(name, bytes.substr(0, bytes.size() - 20));
  }

  TemporaryFolder folder_;
};

using Events = std::vector<std::string>;

TEST_F(SequenceReaderTest, DeliversImagesAndDepthAsStored) {
  SequenceReader reader(folder_.path());
  EXPECT_EQ(reader.size(), 3U);
  EXPECT_TRUE(reader.notice().empty());
  Frame frame;
  FrameFault fault;
  for (int i = 0; i < 3; ++i) {
    ASSERT_EQ(reader.next(frame, fault), FrameSource::Status::kFrame);
    EXPECT_EQ(frame.stamp, i);
    EXPECT_EQ(frame.image.type(), CV_8UC1);
    EXPECT_EQ(frame.image.at<unsigned char>(kHeight - 1, kWidth - 1), 10 * i);
    EXPECT_EQ(frame.depth.type(), CV_16UC1);
    EXPECT_EQ(frame.depth.at<unsigned short>(0, 0), 100 * i);
    EXPECT_EQ(frame.depth_unit, 1.0 / 5000.0);
  }
  EXPECT_EQ(reader.next(frame, fault), FrameSource::Status::kEnd);
  EXPECT_EQ(reader.next(frame, fault), FrameSource::Status::kEnd);
}

TEST_F(SequenceReaderTest, ColorIsTakenAsBlueGreenRed) {
  const cv::Mat color(kHeight, kWidth, CV_8UC3, cv::Scalar(250, 100, 5));
  writePng(folder_ / "rgb/0.png", color, Overwrite::kYes);
  SequenceReader reader(folder_.path());
  Frame frame;
  FrameFault fault;
  ASSERT_EQ(reader.next(frame, fault), FrameSource::Status::kFrame);
  // Weights of ITU-R BT.601: 0.299 red, 0.587 green, 0.114 blue.
  EXPECT_NEAR(frame.image.at<unsigned char>(0, 0), 0.114 * 250 + 0.587 * 100 + 0.299 * 5, 1.0);
}

TEST_F(SequenceReaderTest, PairsWithin20MillisecondsOnly) {
  folder_.write("depth.txt", "0.019 depth/0.png\n1.021 depth/1.png\n1.98 depth/2.png\n");
  EXPECT_EQ(readAll(), (Events{"F0"}));
  folder_.write("depth.txt", "5 depth/0.png\n");
  EXPECT_NE(openError().find("within 20 ms"), std::string::npos);
}

TEST_F(SequenceReaderTest, ListsOutOfOrderAreSorted) {
  folder_.write("rgb.txt", "2 rgb/2.png\n0 rgb/0.png\n1 rgb/1.png\n");
  EXPECT_EQ(readAll(), (Events{"F0", "F1", "F2"}));
}

TEST_F(SequenceReaderTest, AssociationsGoBeforeTheLists) {
  folder_.write("associations.txt", "2 rgb/2.png 9 depth/0.png\n0 rgb/0.png 9 depth/1.png\n");
  EXPECT_EQ(readAll(), (Events{"F0", "F2"}));
  SequenceReader reader(folder_.path());
  Frame frame;
  FrameFault fault;
  reader.next(frame, fault);
  EXPECT_EQ(frame.depth.at<unsigned short>(0, 0), 100);
  std::filesystem::remove(folder_ / "rgb.txt");  // not needed then
  EXPECT_EQ(readAll().size(), 2U);
}

TEST_F(SequenceReaderTest, LinesOutOfOrderAndDoubledAreToldOnce) {
  const std::string line[] = {"0 rgb/0.png 0 depth/0.png\n", "1 rgb/1.png 1 depth/1.png\n",
                              "2 rgb/2.png 2 depth/2.png\n"};
  const std::string file = folder_.write("associations.txt", line[2] + line[1] + line[0]);
  EXPECT_EQ(readAll(), (Events{"F0", "F1", "F2"}));
  EXPECT_EQ(SequenceReader(folder_.path()).notice(),
            "the lines of " + file + " were not in the order of their stamps and are sorted");
  folder_.write("associations.txt", line[0] + line[0] + line[1] + line[1] + line[2]);
  EXPECT_EQ(readAll(), (Events{"F0", "F1", "F2"}));
  EXPECT_EQ(SequenceReader(folder_.path()).notice(),
            "2 of the lines of " + file + " left out: others have the same stamps");

  std::filesystem::remove(file);
  folder_.write("rgb.txt", "2 rgb/2.png\n0 rgb/0.png\n0 rgb/1.png\n");
  folder_.write("depth.txt", "0 depth/0.png\n0 depth/0.png\n2 depth/2.png\n");
  EXPECT_EQ(readAll(), (Events{"F0", "F2"}));
  EXPECT_EQ(SequenceReader(folder_.path()).notice(),
            "the lines of " + (folder_ / "rgb.txt") +
                " were not in the order of their stamps and are sorted; 1 of them left out: others "
                "have the same stamps; 1 of the lines of " +
                (folder_ / "depth.txt") + " left out: others have the same stamps");
}

TEST_F(SequenceReaderTest, ListsWithoutTimesAreErrors) {
  folder_.write("rgb.txt", "0 rgb/0.png\n0 rgb/1.png\n");
  EXPECT_EQ(openError(), (folder_ / "rgb.txt") +
                             ": all 2 stamps are 0.000000: without times nothing can be tracked");
  folder_.write("associations.txt", "7 rgb/0.png 0 depth/0.png\n7 rgb/1.png 1 depth/1.png\n");
  EXPECT_EQ(openError().find((folder_ / "associations.txt") + ": all 2 stamps are 7.000000"), 0U);
}

TEST_F(SequenceReaderTest, LinesWithAColumnTooManyAreErrors) {
  for (const char* line : {"0 0 rgb/0.png 0 depth/0.png\n", "0,00 rgb/0.png 0,00 depth/0.png\n",
                           "0 rgb/0.png 0 depth/0.png 7\n"}) {
    folder_.write("associations.txt", line);
    EXPECT_EQ(openError().find((folder_ / "associations.txt") +
                               ": expected 'stamp_rgb path stamp_depth path', found "),
              0U)
        << openError();
  }
  folder_.write("associations.txt", std::string("\xFF\xFE\x31\0 \0", 6));
  EXPECT_EQ(openError(),
            (folder_ / "associations.txt") + " is encoded as UTF-16: save it as UTF-8");
}

TEST_F(SequenceReaderTest, StampsInMillisecondsAreDoubted) {
  folder_.write("associations.txt",
                "100 rgb/0.png 100 depth/0.png\n133 rgb/1.png 133 depth/1.png\n"
                "166 rgb/2.png 166 depth/2.png\n");
  EXPECT_EQ(SequenceReader(folder_.path()).notice(),
            "the images are 33 s apart at the median: stamps are expected in seconds; are these "
            "milliseconds?");
}

TEST_F(SequenceReaderTest, RangeIsAPart) {
  EXPECT_EQ(readAll({1, 1}), (Events{"F1"}));
  EXPECT_EQ(readAll({1, 100}), (Events{"F1", "F2"}));
  EXPECT_EQ(SequenceReader(folder_.path(), {1, 100}).size(), 2U);
  EXPECT_NE(openError({3, 1}).find("it has 3"), std::string::npos);
  EXPECT_NE(openError({0, 0}), "nothing thrown");
}

TEST_F(SequenceReaderTest, BrokenFrameIsSkippedWithItsReason) {
  truncate("rgb/1.png");
  EXPECT_EQ(readAll(), (Events{"F0", "S" + (folder_ / "rgb/1.png") + " is truncated", "F2"}));
  SequenceReader reader(folder_.path());
  Frame frame;
  FrameFault fault;
  reader.next(frame, fault);
  ASSERT_EQ(reader.next(frame, fault), FrameSource::Status::kSkipped);
  EXPECT_EQ(fault.reason, "the color image is truncated");  // counted with others
}

TEST_F(SequenceReaderTest, BrokenFirstFrameIsSkippedToo) {
  truncate("depth/0.png");
  EXPECT_EQ(readAll(), (Events{"S" + (folder_ / "depth/0.png") + " is truncated", "F1", "F2"}));
}

TEST_F(SequenceReaderTest, MissingImageIsSkipped) {
  std::filesystem::remove(folder_ / "depth/2.png");
  const Events events = readAll();
  ASSERT_EQ(events.size(), 3U);
  EXPECT_NE(events[2].find(folder_ / "depth/2.png"), std::string::npos);
}

TEST_F(SequenceReaderTest, LaterFrameOfAnotherSizeOrTypeIsSkipped) {
  writePng(folder_ / "rgb/1.png", cv::Mat(5, 5, CV_8UC1, cv::Scalar(0)), Overwrite::kYes);
  writePng(folder_ / "depth/2.png", cv::Mat(kHeight, kWidth, CV_8UC1, cv::Scalar(0)),
           Overwrite::kYes);
  const Events events = readAll();
  ASSERT_EQ(events.size(), 3U);
  EXPECT_NE(events[1].find("5x5"), std::string::npos) << events[1];
  EXPECT_NE(events[2].find("16-bit"), std::string::npos) << events[2];
}

TEST_F(SequenceReaderTest, NothingReadableIsAnError) {
  for (const char* name : {"rgb/0.png", "rgb/1.png", "depth/2.png"}) truncate(name);
  EXPECT_EQ(openError(),
            "none of the 3 frames can be read: " + (folder_ / "rgb/0.png") + " is truncated");
}

TEST_F(SequenceReaderTest, CameraOfAnotherSizeIsAnError) {
  folder_.write("camera.txt", "640 480 500 500 320 240 5000\n");
  const std::string text = openError();
  EXPECT_NE(text.find("8x6"), std::string::npos) << text;
  EXPECT_NE(text.find("640x480"), std::string::npos) << text;
}

TEST_F(SequenceReaderTest, UnregisteredDepthIsAnError) {
  for (int i = 0; i < 3; ++i) {
    writePng(folder_ / ("depth/" + std::to_string(i) + ".png"), cv::Mat(3, 5, CV_16UC1),
             Overwrite::kYes);
  }
  EXPECT_NE(openError().find("not registered"), std::string::npos);
}

TEST_F(SequenceReaderTest, MissingFilesAndBadListsAreErrors) {
  EXPECT_NE(errorText([&] { SequenceReader(folder_ / "no"); }).find("there is no folder"),
            std::string::npos);
  EXPECT_NE(errorText([&] { SequenceReader(folder_ / "rgb.txt"); }).find("is no folder"),
            std::string::npos);
  folder_.write("rgb.txt", "# nothing\n");
  EXPECT_EQ(openError(), (folder_ / "rgb.txt") + " lists no image");
  folder_.write("rgb.txt", "0 rgb/0.png\nx rgb/1.png\n");
  EXPECT_EQ(openError().find((folder_ / "rgb.txt") + ":2: "), 0U);
  folder_.write("rgb.txt", "0\n");
  EXPECT_EQ(openError().find((folder_ / "rgb.txt") + ":1: "), 0U);
  std::filesystem::remove(folder_ / "rgb.txt");
  EXPECT_NE(openError().find(folder_ / "rgb.txt"), std::string::npos);
  folder_.write("associations.txt", "0 rgb/0.png 0\n");
  EXPECT_EQ(openError().find((folder_ / "associations.txt") + ":1: "), 0U);
  folder_.write("associations.txt", "\n");
  EXPECT_EQ(openError(), (folder_ / "associations.txt") + " lists no frame");
  folder_.write("camera.txt", "8 6 10 10 4 oops 5000\n");
  EXPECT_EQ(openError().find((folder_ / "camera.txt") + ":1: "), 0U);
}

TEST_F(SequenceReaderTest, CameraIsGuessedFromTheNameOfTumFoldersOnly) {
  std::filesystem::remove(folder_ / "camera.txt");
  EXPECT_NE(openError().find("no camera.txt"), std::string::npos);

  const std::string tum = folder_ / "rgbd_dataset_freiburg2_small";
  std::filesystem::create_directories(tum);
  writePng(tum + "/rgb.png", cv::Mat(480, 640, CV_8UC1, cv::Scalar(1)), Overwrite::kNo);
  writePng(tum + "/depth.png", cv::Mat(480, 640, CV_16UC1, cv::Scalar(1)), Overwrite::kNo);
  folder_.write("rgbd_dataset_freiburg2_small/associations.txt", "0 rgb.png 0 depth.png\n");
  const SequenceReader reader(tum + "/");
  EXPECT_EQ(reader.camera().fx, 520.9);
  EXPECT_EQ(reader.depthUnitsPerMeter(), 5000.0);
  EXPECT_NE(reader.notice().find("no camera.txt"), std::string::npos);
}

}  // namespace
}  // namespace mivo
