// SPDX-License-Identifier: BSD-3-Clause
#include "io/image_file.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <vector>

#include "io/image_decoding.h"
#include "mivo/core/error.h"

namespace mivo {
namespace {

using Bytes = std::vector<unsigned char>;

Bytes readBytes(const std::string& path) {
  namespace fs = std::filesystem;
  std::error_code ignored;  // what cannot be looked at cannot be opened either, and that says why
  const fs::file_status status = fs::status(path, ignored);
  if (fs::is_directory(status)) throw Error("cannot read " + path + ": it is a folder");
  // A pipe would be waited for.
  if (fs::exists(status) && !fs::is_regular_file(status)) {
    throw Error("cannot read " + path + ": it is no regular file");
  }
  errno = 0;
  std::ifstream stream(path, std::ios::binary);
  if (!stream) throw Error("cannot read " + path + ": " + std::strerror(errno));
  Bytes bytes(std::filesystem::file_size(path));
  stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  if (!stream) throw Error("cannot read " + path + " to its end");
  return bytes;
}

}  // namespace

cv::Mat readImage(const std::string& path) {
  const Bytes bytes = readBytes(path);
  return decodeImage(bytes.data(), bytes.size(), path);
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
