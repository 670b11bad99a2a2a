// SPDX-License-Identifier: BSD-3-Clause
#include "io/image_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <boost/crc.hpp>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <random>
#include <string>
#include <utility>
#include <vector>

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

TEST(ImageFileTest, ImagesComeBackExactly) {
  const TemporaryFolder folder;
  for (const int type : {CV_8UC1, CV_8UC3, CV_8UC4, CV_16UC1}) {
    const cv::Mat image = noise(type);
    writePng(folder / "image.png", image, Overwrite::kYes);
    EXPECT_TRUE(same(readImage(folder / "image.png"), image)) << type;
  }
}

TEST(ImageFileTest, WhatIsNoFileIsNamedAndNotWaitedFor) {
  const TemporaryFolder folder;
  const std::string pipe = folder / "pipe.png";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_EQ(errorText([&] { readImage(pipe); }), "cannot read " + pipe + ": it is no regular file");
  const std::string circle = folder / "circle.png";
  std::filesystem::create_symlink("circle.png", circle);
  EXPECT_EQ(errorText([&] { readImage(circle); }),
            "cannot read " + circle + ": Too many levels of symbolic links");
}

TEST(ImageFileTest, EveryTruncationIsNoticed) {
  const TemporaryFolder folder;
  writePng(folder / "image.png", noise(CV_16UC1), Overwrite::kNo);
  const std::string bytes = contentOf(folder / "image.png");
  ASSERT_GT(bytes.size(), 1000U);
  for (std::size_t size = 0; size < bytes.size(); size += 1 + size / 50) {
    const std::string path = folder.write("cut" + std::to_string(size), bytes.substr(0, size));
    EXPECT_EQ(errorText([&] { readImage(path); }).find(path), 0U) << size;
  }
  const std::string path = folder.write("cut.png", bytes.substr(0, bytes.size() - 1));
  EXPECT_EQ(errorText([&] { readImage(path); }), path + " is truncated");
}

TEST(ImageFileTest, EveryDamagedByteIsNoticed) {
  const TemporaryFolder folder;
  writePng(folder / "image.png", noise(CV_8UC3, 9, 7), Overwrite::kNo);
  const std::string bytes = contentOf(folder / "image.png");
  testing::internal::CaptureStderr();
  for (std::size_t position = 0; position < bytes.size(); ++position) {
    std::string damaged = bytes;
    damaged[position] = static_cast<char>(damaged[position] ^ 0x10);
    const std::string path = folder.write("damaged" + std::to_string(position), damaged);
    EXPECT_EQ(errorText([&] { readImage(path); }).find(path), 0U) << position;
  }
  // Detected before decoding: the decoder would print a message of its own.
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(ImageFileTest, BytesAfterTheImageDoNotMatter) {
  const TemporaryFolder folder;
  const cv::Mat image = noise(CV_8UC1);
  writePng(folder / "image.png", image, Overwrite::kNo);
  const std::string path = folder.write("more.png", contentOf(folder / "image.png") + "more");
  EXPECT_TRUE(same(readImage(path), image));
}

/// Waves, for JPEG.
cv::Mat smooth(int type) {
  cv::Mat image(48, 64, type);
  for (int y = 0; y < image.rows; ++y) {
    for (int i = 0; i < image.cols * image.channels(); ++i) {
      image.ptr(y)[i] = static_cast<unsigned char>(128.0 + 90.0 * std::sin(0.05 * i + 0.1 * y));
    }
  }
  return image;
}

std::string encoded(const char* extension, const cv::Mat& image) {
  std::vector<unsigned char> bytes;
  cv::imencode(extension, image, bytes);
  return {bytes.begin(), bytes.end()};
}

TEST(ImageFileTest, JpegIsRead) {
  const TemporaryFolder folder;
  for (const int type : {CV_8UC1, CV_8UC3}) {
    const std::string path = folder.write("image.jpg", encoded(".jpg", smooth(type)));
    const cv::Mat image = readImage(path);
    ASSERT_EQ(image.type(), type);
    EXPECT_LE(cv::norm(image, smooth(type), cv::NORM_INF), 6.0);
  }
}

TEST(ImageFileTest, TruncatedJpegIsNoticedAndPaddingDoesNotMatter) {
  const TemporaryFolder folder;
  const std::string bytes = encoded(".jpg", smooth(CV_8UC3));
  // The same with an embedded preview, which has its own end marker, in a segment after the first
  // two bytes.
  const std::string preview = encoded(".jpg", smooth(CV_8UC1));
  std::string with_preview = bytes;
  with_preview.insert(2, std::string("\xFF\xE1") + static_cast<char>((preview.size() + 2) >> 8) +
                             static_cast<char>((preview.size() + 2) & 0xFF) + preview);
  for (const std::string& whole : {bytes, with_preview}) {
    for (const std::size_t cut : {std::size_t{1}, std::size_t{2}, std::size_t{60}}) {
      const std::string path = folder.write("cut.jpg", whole.substr(0, whole.size() - cut));
      EXPECT_EQ(errorText([&] { readImage(path); }), path + " is truncated") << cut;
    }
    const std::string padded = folder.write("padded.jpg", whole + std::string(5000, '\0'));
    EXPECT_LE(cv::norm(readImage(padded), smooth(CV_8UC3), cv::NORM_INF), 6.0);
  }
}

TEST(ImageFileTest, PgmIsRead) {
  const TemporaryFolder folder;
  for (const int type : {CV_8UC1, CV_16UC1}) {
    const std::string bytes = encoded(".pgm", noise(type));
    const std::string path = folder.write("image.pgm", bytes);
    EXPECT_TRUE(same(readImage(path), noise(type))) << type;
    const std::string cut = folder.write("cut.pgm", bytes.substr(0, bytes.size() / 2));
    EXPECT_EQ(errorText([&] { readImage(cut); }).find(cut), 0U);
  }
}

TEST(ImageFileTest, SaysWhatIsNoImage) {
  const TemporaryFolder folder;
  EXPECT_NE(errorText([&] { readImage(folder / "no.png"); }).find("No such file"),
            std::string::npos);
  EXPECT_NE(errorText([&] { readImage(folder.path()); }).find("it is a folder"), std::string::npos);
  const std::string empty = folder.write("empty.png", "");
  EXPECT_EQ(errorText([&] { readImage(empty); }), empty + " is empty");
  const std::pair<std::string, const char*> cases[] = {
      {"words", "no image"},
      {encoded(".tiff", noise(CV_16UC1)), "a file of the format TIFF"},
      {encoded(".bmp", noise(CV_8UC1)), "a file of the format BMP"},
      {encoded(".ppm", noise(CV_8UC3)), "a file of the format PPM"},
      {std::string("\x93NUMPY\1\0", 8), "a file of the format NumPy"},
      {"\x76\x2F\x31\x01more", "a file of the format OpenEXR"}};
  for (const auto& [content, what] : cases) {
    const std::string path = folder.write("image.png", content);
    EXPECT_EQ(errorText([&] { readImage(path); }),
              path + " is " + what + "; PNG, JPEG and PGM are read");
  }
}

TEST(ImageFileTest, RefusesToWriteNothingAndOverFiles) {
  const TemporaryFolder folder;
  EXPECT_THROW(writePng(folder / "image.png", cv::Mat(), Overwrite::kNo), Error);
  const std::string path = folder.write("image.png", "old");
  EXPECT_THROW(writePng(path, noise(CV_8UC1), Overwrite::kNo), Error);
  EXPECT_EQ(contentOf(path), "old");
}

/// A few bytes that claim to be a large image.
std::string pngClaiming(std::uint32_t width, std::uint32_t height) {
  const auto word = [](std::uint32_t value) {
    std::string bytes;
    for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(value >> shift);
    return bytes;
  };
  const auto chunk = [&](const std::string& content) {
    boost::crc_32_type checksum;
    checksum.process_bytes(content.data(), content.size());
    return word(static_cast<std::uint32_t>(content.size() - 4)) + content +
           word(checksum.checksum());
  };
  const std::string how("\x10\0\0\0\0", 5);
  return "\x89PNG\r\n\x1A\n" + chunk("IHDR" + word(width) + word(height) + how) + chunk("IEND");
}

TEST(ImageFileTest, ImagesThatClaimTooManyPixelsAreRefusedAtOnce) {
  const std::string jpeg("\xFF\xD8\xFF\xC0\0\x0B\x08\xFD\xE8\xFD\xE8\x01\x01\x11\0\xFF\xD9", 17);
  const std::pair<const char*, std::string> files[] = {
      {"65000 x 65000", jpeg},
      {"65000 x 65000", "P5\n# made by hand\n65000 65000\n255\n"},
      {"65000 x 65000", pngClaiming(65000, 65000)},
      {"2147483648 x 1", pngClaiming(2147483648U, 1)},
      {"1 x 4294967295", pngClaiming(1, 4294967295U)}};
  const TemporaryFolder folder;
  for (const auto& [size, bytes] : files) {
    const std::string path = folder.write("image", bytes);
    EXPECT_EQ(errorText([&] { readImage(path); }),
              path + " is of " + size + " pixels, as it says; at most 67108864 are read");
  }
}

}  // namespace
}  // namespace mivo
