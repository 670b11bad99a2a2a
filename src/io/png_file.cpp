// SPDX-License-Identifier: BSD-3-Clause
#include "io/png_file.h"

#include <boost/crc.hpp>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <vector>

#include "mivo/core/error.h"

namespace mivo {
namespace {

using Bytes = std::vector<unsigned char>;

constexpr unsigned char kSignature[] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};

// A chunk: 4 bytes length, 4 bytes type, the data, 4 bytes checksum of type and data.
constexpr std::size_t kLengthSize = 4;
constexpr std::size_t kTypeSize = 4;
constexpr std::size_t kChecksumSize = 4;

Bytes readBytes(const std::string& path) {
  if (std::filesystem::is_directory(path)) throw Error("cannot read " + path + ": it is a folder");
  errno = 0;
  std::ifstream stream(path, std::ios::binary);
  if (!stream) throw Error("cannot read " + path + ": " + std::strerror(errno));
  Bytes bytes(std::filesystem::file_size(path));
  stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  if (!stream) throw Error("cannot read " + path + " to its end");
  return bytes;
}

std::uint32_t bigEndian(const unsigned char* bytes) {
  return std::uint32_t{bytes[0]} << 24 | std::uint32_t{bytes[1]} << 16 |
         std::uint32_t{bytes[2]} << 8 | std::uint32_t{bytes[3]};
}

/// Walks the chunks up to the one that ends the image.
void checkPng(const std::string& path, const Bytes& bytes) {
  if (bytes.size() < sizeof kSignature ||
      std::memcmp(bytes.data(), kSignature, sizeof kSignature) != 0) {
    throw Error(path + (bytes.empty() ? " is empty" : " is not a PNG image"));
  }
  for (std::size_t position = sizeof kSignature;;) {
    const std::size_t left = bytes.size() - position;
    if (left < kLengthSize + kTypeSize + kChecksumSize) break;
    const std::size_t length = bigEndian(&bytes[position]);
    if (left - kLengthSize - kTypeSize - kChecksumSize < length) break;
    const unsigned char* const type = &bytes[position + kLengthSize];
    boost::crc_32_type checksum;
    checksum.process_bytes(type, kTypeSize + length);
    if (checksum.checksum() != bigEndian(type + kTypeSize + length)) {
      throw Error(path + " is damaged: a checksum is wrong");
    }
    if (std::memcmp(type, "IEND", kTypeSize) == 0) return;
    position += kLengthSize + kTypeSize + length + kChecksumSize;
  }
  throw Error(path + " is truncated");
}

}  // namespace

cv::Mat readPng(const std::string& path) {
  const Bytes bytes = readBytes(path);
  checkPng(path, bytes);
  cv::Mat image;
  try {
    image = cv::imdecode(bytes, cv::IMREAD_UNCHANGED);
  } catch (const cv::Exception& error) {
    throw Error(path + " cannot be decoded: " + error.err);
  }
  if (image.empty()) throw Error(path + " cannot be decoded");
  return image;
}

void writePng(const std::string& path, const cv::Mat& image, Overwrite overwrite) {
  Bytes bytes;
  try {
    if (image.empty() || !cv::imencode(".png", image, bytes)) {
      throw Error("cannot encode the image for " + path);
    }
  } catch (const cv::Exception& error) {
    throw Error("cannot encode the image for " + path + ": " + error.err);
  }
  OutputFile(path, overwrite).write(reinterpret_cast<const char*>(bytes.data()), bytes.size());
}

}  // namespace mivo
