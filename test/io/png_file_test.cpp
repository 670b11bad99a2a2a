// SPDX-License-Identifier: BSD-3-Clause
#include "io/png_file.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <random>

#include "support/error_text.h"
#include "support/temporary_folder.h"

namespace mivo {
namespace {

cv::Mat noise(int type, int width = 32, int height = 24) {
  std::mt19937 engine(3);
  cv::Mat image(height, width, type);
  for (int y = 0; y < image.rows; ++y) {
    unsigned char* const row = image.ptr(y);
    for (std::size_t i = 0; i < image.cols * image.elemSize(); ++i) {
      row[i] = static_cast<unsigned char>(engine());
    }
  }
  return image;
}

bool same(const cv::Mat& a, const cv::Mat& b) {
  return a.type() == b.type() && a.size() == b.size() && cv::norm(a, b, cv::NORM_INF) == 0.0;
}

TEST(PngFileTest, ImagesComeBackExactly) {
  const TemporaryFolder folder;
  for (const int type : {CV_8UC1, CV_8UC3, CV_8UC4, CV_16UC1}) {
    const cv::Mat image = noise(type);
    writePng(folder / "image.png", image, Overwrite::kYes);
    EXPECT_TRUE(same(readPng(folder / "image.png"), image)) << type;
  }
}

TEST(PngFileTest, EveryTruncationIsNoticed) {
  const TemporaryFolder folder;
  writePng(folder / "image.png", noise(CV_16UC1), Overwrite::kNo);
  const std::string bytes = contentOf(folder / "image.png");
  ASSERT_GT(bytes.size(), 1000U);
  for (std::size_t size = 0; size < bytes.size(); size += 1 + size / 50) {
    const std::string path = folder.write("cut" + std::to_string(size), bytes.substr(0, size));
    EXPECT_EQ(errorText([&] { readPng(path); }).find(path), 0U) << size;
  }
  const std::string path = folder.write("cut.png", bytes.substr(0, bytes.size() - 1));
  EXPECT_EQ(errorText([&] { readPng(path); }), path + " is truncated");
}

TEST(PngFileTest, EveryDamagedByteIsNoticed) {
  const TemporaryFolder folder;
  writePng(folder / "image.png", noise(CV_8UC3, 9, 7), Overwrite::kNo);
  const std::string bytes = contentOf(folder / "image.png");
  testing::internal::CaptureStderr();
  for (std::size_t position = 0; position < bytes.size(); ++position) {
    std::string damaged = bytes;
    damaged[position] = static_cast<char>(damaged[position] ^ 0x10);
    const std::string path = folder.write("damaged" + std::to_string(position), damaged);
    EXPECT_EQ(errorText([&] { readPng(path); }).find(path), 0U) << position;
  }
  // Noticed here, not by the decoder, which would print a line of its own.
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(PngFileTest, BytesAfterTheImageDoNotMatter) {
  const TemporaryFolder folder;
  const cv::Mat image = noise(CV_8UC1);
  writePng(folder / "image.png", image, Overwrite::kNo);
  const std::string path = folder.write("more.png", contentOf(folder / "image.png") + "more");
  EXPECT_TRUE(same(readPng(path), image));
}

TEST(PngFileTest, SaysWhatIsNoPng) {
  const TemporaryFolder folder;
  EXPECT_NE(errorText([&] { readPng(folder / "no.png"); }).find("No such file"), std::string::npos);
  EXPECT_NE(errorText([&] { readPng(folder.path()); }).find("it is a folder"), std::string::npos);
  const std::string empty = folder.write("empty.png", "");
  EXPECT_EQ(errorText([&] { readPng(empty); }), empty + " is empty");
  const std::string text = folder.write("text.png", "P5 1 1 255 x");
  EXPECT_EQ(errorText([&] { readPng(text); }), text + " is not a PNG image");
}

TEST(PngFileTest, RefusesToWriteNothingAndOverFiles) {
  const TemporaryFolder folder;
  EXPECT_THROW(writePng(folder / "image.png", cv::Mat(), Overwrite::kNo), Error);
  const std::string path = folder.write("image.png", "old");
  EXPECT_THROW(writePng(path, noise(CV_8UC1), Overwrite::kNo), Error);
  EXPECT_EQ(contentOf(path), "old");
}

}  // namespace
}  // namespace mivo
