// SPDX-License-Identifier: BSD-3-Clause
#include "io/image_decoding.h"

#include <boost/crc.hpp>
#include <cctype>
#include <cstdint>
#include <cstring>
#include <opencv2/imgcodecs.hpp>
#include <string_view>

#include "mivo/core/error.h"

namespace mivo {
namespace {

using namespace std::string_view_literals;

/// The bytes of an encoded image with what is said of it when they are wrong.
struct Encoded {
  const unsigned char* bytes;
  std::size_t count;
  const std::string& name;

  [[noreturn]] void refuseTruncated() const { throw Error(name + " is truncated"); }

  /// Before memory is asked for: a file of 100 bytes may claim any size.
  void checkSize(std::uint64_t width, std::uint64_t height) const {
    if (height == 0 || width <= kMaxImagePixels / height) return;
    throw Error(name + " is of " + std::to_string(width) + " x " + std::to_string(height) +
                " pixels, as it says; at most " + std::to_string(kMaxImagePixels) + " are read");
  }
};

constexpr std::string_view kPngSignature = "\x89PNG\r\n\x1A\n"sv;

/// How files of an image format begin.
struct Signature {
  std::string_view start;
  const char* format;
};

constexpr Signature kSignatures[] = {
    {kPngSignature, "PNG"},   {"\xFF\xD8\xFF"sv, "JPEG"}, {"P5"sv, "PGM"},
    {"II*\0"sv, "TIFF"},      {"MM\0*"sv, "TIFF"},        {"\x76\x2F\x31\x01"sv, "OpenEXR"},
    {"\x93NUMPY"sv, "NumPy"}, {"P2"sv, "text PGM"},       {"P6"sv, "PPM"},
    {"BM"sv, "BMP"},          {"GIF8"sv, "GIF"},          {"RIFF"sv, "WebP"}};

// A chunk of a PNG: 4 bytes length, 4 bytes type, the data, 4 bytes checksum of type and data.
constexpr std::size_t kLengthSize = 4;
constexpr std::size_t kTypeSize = 4;
constexpr std::size_t kChecksumSize = 4;
constexpr std::size_t kSizesLength = 8;  // width and height, which the first chunk begins with

std::uint32_t bigEndian(const unsigned char* bytes) {
  return std::uint32_t{bytes[0]} << 24 | std::uint32_t{bytes[1]} << 16 |
         std::uint32_t{bytes[2]} << 8 | std::uint32_t{bytes[3]};
}

/// Of a PGM: whole numbers behind its two letters, with blanks and comments between them.
std::uint64_t pgmNumber(const Encoded& image, std::size_t& position) {
  const auto at = [&] { return position < image.count ? image.bytes[position] : 0; };
  for (bool is_comment = false; is_comment || at() == '#' || std::isspace(at()) != 0; ++position) {
    if (position >= image.count) image.refuseTruncated();
    is_comment = at() != '\n' && (is_comment || at() == '#');
  }
  std::uint64_t number = 0;
  for (; std::isdigit(at()) != 0 && number <= kMaxImagePixels; ++position) {
    number = 10 * number + (at() - std::uint64_t{'0'});
  }
  return number;
}

void checkPgmSize(const Encoded& image) {
  std::size_t position = 2;
  const std::uint64_t width = pgmNumber(image, position);
  image.checkSize(width, pgmNumber(image, position));
}

/// Walks the chunks up to the one that ends the image.
void checkPng(const Encoded& image) {
  for (std::size_t position = kPngSignature.size();;) {
    const std::size_t left = image.count - position;
    if (left < kLengthSize + kTypeSize + kChecksumSize) image.refuseTruncated();
    const std::size_t length = bigEndian(image.bytes + position);
    if (left - kLengthSize - kTypeSize - kChecksumSize < length) image.refuseTruncated();
    const unsigned char* const type = image.bytes + position + kLengthSize;
    boost::crc_32_type checksum;
    checksum.process_bytes(type, kTypeSize + length);
    if (checksum.checksum() != bigEndian(type + kTypeSize + length)) {
      throw Error(image.name + " is damaged: a checksum is wrong");
    }
    if (std::memcmp(type, "IHDR", kTypeSize) == 0 && length >= kSizesLength) {
      image.checkSize(bigEndian(type + kTypeSize), bigEndian(type + kTypeSize + 4));
    }
    if (std::memcmp(type, "IEND", kTypeSize) == 0) return;
    position += kLengthSize + kTypeSize + length + kChecksumSize;
  }
}

/// Of a JPEG: the segment holds the size, behind its own length and the bits of a sample.
bool isFrameHeader(unsigned char type) {
  const bool is_table = type == 0xC4 || type == 0xC8 || type == 0xCC;
  return type >= 0xC0 && type <= 0xCF && !is_table;
}

/// Walks the segments up to the mark that ends the image: a preview inside of a segment has one,
/// too. Between segments lie the coded pixels, in which 0xFF is followed by 0, or by a restart.
void checkJpeg(const Encoded& image) {
  constexpr unsigned char kMark = 0xFF;
  constexpr unsigned char kEnd = 0xD9;
  const auto has_length = [](unsigned char type) {
    const bool is_alone = (type >= 0xD0 && type <= 0xD8) || type == 0x01;  // restarts, start, TEM
    return type != 0x00 && type != kMark && !is_alone;
  };
  for (std::size_t i = 2; i + 1 < image.count;) {
    const unsigned char type = image.bytes[i + 1];
    if (image.bytes[i] != kMark || !has_length(type)) {
      ++i;
      continue;
    }
    if (type == kEnd) return;
    if (i + 3 >= image.count) break;
    if (isFrameHeader(type) && i + 8 < image.count) {
      const auto word = [&](std::size_t at) { return image.bytes[at] << 8 | image.bytes[at + 1]; };
      image.checkSize(static_cast<std::uint64_t>(word(i + 7)),
                      static_cast<std::uint64_t>(word(i + 5)));
    }
    i += 2U + (std::size_t{image.bytes[i + 2]} << 8 | image.bytes[i + 3]);
  }
  image.refuseTruncated();
}

/// PGM has no mark at its end, but no compression either.
void checkPgm(const Encoded& image, const cv::Mat& decoded) {
  if (image.count < decoded.total() * decoded.elemSize()) image.refuseTruncated();
}

}  // namespace

std::string imageFormat(const unsigned char* bytes, std::size_t count) {
  const std::string_view text(reinterpret_cast<const char*>(bytes), count);
  for (const Signature& signature : kSignatures) {
    if (text.substr(0, signature.start.size()) == signature.start) return signature.format;
  }
  return {};
}

cv::Mat decodeImage(const unsigned char* bytes, std::size_t count, const std::string& name) {
  const Encoded encoded{bytes, count, name};
  const std::string format = imageFormat(bytes, count);
  if (count == 0) throw Error(name + " is empty");
  if (format != "PNG" && format != "JPEG" && format != "PGM") {
    throw Error(name + " is " + (format.empty() ? "no image" : "a file of the format " + format) +
                "; PNG, JPEG and PGM are read");
  }
  if (format == "PNG") checkPng(encoded);
  if (format == "JPEG") checkJpeg(encoded);
  if (format == "PGM") checkPgmSize(encoded);
  cv::Mat image;
  try {
    const cv::Mat data(1, static_cast<int>(count), CV_8UC1, const_cast<unsigned char*>(bytes));
    image = cv::imdecode(data, cv::IMREAD_UNCHANGED);
  } catch (const cv::Exception& error) {
    throw Error(name + " cannot be decoded: " + error.err);
  }
  if (image.empty()) throw Error(name + " cannot be decoded");
  if (format == "PGM") checkPgm(encoded, image);
  return image;
}

}  // namespace mivo
