// SPDX-License-Identifier: BSD-3-Clause
#include "mivo/io/sequence_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "io/png_file.h"
#include "io/table_reader.h"
#include "mivo/core/error.h"
#include "trajectory/association.h"

namespace mivo {
namespace {

namespace fs = std::filesystem;

constexpr double kMaxPairDifference = 0.02;  // s

/// One list of images, sorted by stamp.
struct ImageList {
  std::vector<double> stamps;
  std::vector<std::string> paths;
};

ImageList readImageList(const fs::path& folder, const char* name) {
  std::vector<std::pair<double, std::string>> images;
  TableReader table((folder / name).string());
  while (table.next()) {
    if (table.size() != 2) table.refuse("expected 'stamp path'");
    images.emplace_back(table.number(0), (folder / table.text(1)).string());
  }
  if (images.empty()) throw Error((folder / name).string() + " lists no image");
  std::stable_sort(images.begin(), images.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  ImageList list;
  for (const auto& [stamp, path] : images) {
    list.stamps.push_back(stamp);
    list.paths.push_back(path);
  }
  return list;
}

/// Name of the folder itself, also when it was given as "." or with a slash at its end.
std::string folderName(const std::string& folder) {
  const fs::path path = fs::canonical(folder);
  return path.filename().string();
}

std::string sizeText(int width, int height) {
  return fmt::format("{}x{}", width, height);
}
std::string sizeText(const cv::Mat& image) {
  return sizeText(image.cols, image.rows);
}

}  // namespace

SequenceReader::SequenceReader(const std::string& folder, const FrameRange& range) {
  if (!fs::exists(folder)) throw Error("there is no folder " + folder);
  if (!fs::is_directory(folder)) throw Error(folder + " is no folder");
  readCameraOf(folder);
  if (fs::exists(fs::path(folder) / "associations.txt")) {
    readEntries(folder);
  } else {
    pairEntries(folder);
  }
  if (range.count == 0 || range.start >= entries_.size()) {
    throw Error(fmt::format(
        "no frame left of {}: it has {}, numbered from 0, and frames from {} on were asked for",
        folder, entries_.size(), range.start));
  }
  const std::size_t count = std::min(range.count, entries_.size() - range.start);
  entries_.erase(entries_.begin(), entries_.begin() + static_cast<std::ptrdiff_t>(range.start));
  entries_.resize(count);
  probe();
}

void SequenceReader::readCameraOf(const std::string& folder) {
  const fs::path file = fs::path(folder) / "camera.txt";
  if (fs::exists(file)) {
    camera_ = readCamera(file.string());
    return;
  }
  const std::string name = folderName(folder);
  const auto known = tumCamera(name);
  if (!known) {
    throw Error(
        folder +
        " has no camera.txt, and its name is none of TUM's freiburg1, 2 or 3; write the line "
        "'width height fx fy cx cy depth_units_per_metre [k1 k2 p1 p2 k3]' into camera.txt");
  }
  camera_ = *known;
  notice_ = folder +
            " has no camera.txt: the published camera of TUM's sequences is taken, by the folder's "
            "name " +
            name +
            fmt::format(" (fx {} fy {} cx {} cy {}, {} depth units per metre)", camera_.camera.fx,
                        camera_.camera.fy, camera_.camera.cx, camera_.camera.cy,
                        camera_.depth_units_per_metre);
}

void SequenceReader::readEntries(const std::string& folder) {
  const fs::path base(folder);
  TableReader table((base / "associations.txt").string());
  while (table.next()) {
    if (table.size() != 4) table.refuse("expected 'stamp_rgb path stamp_depth path'");
    table.number(2);  // refused when it is no number; the frame has the stamp of its colour image
    entries_.push_back(
        {table.number(0), (base / table.text(1)).string(), (base / table.text(3)).string()});
  }
  if (entries_.empty()) throw Error((base / "associations.txt").string() + " lists no frame");
}

void SequenceReader::pairEntries(const std::string& folder) {
  const ImageList images = readImageList(folder, "rgb.txt");
  const ImageList depths = readImageList(folder, "depth.txt");
  for (const auto& [i, j] : associate(images.stamps, depths.stamps, kMaxPairDifference)) {
    entries_.push_back({images.stamps[i], images.paths[i], depths.paths[j]});
  }
  if (entries_.empty()) {
    throw Error(folder +
                ": no depth image is within 20 ms of a colour image; the stamps of rgb.txt and "
                "depth.txt differ");
  }
}

void SequenceReader::probe() const {
  std::string first_fault;
  for (const Entry& entry : entries_) {
    Frame frame;
    try {
      frame = read(entry);
    } catch (const Error& error) {
      if (first_fault.empty()) first_fault = error.what();
      continue;
    }
    const std::string fault = sizeFault(frame, entry);
    if (!fault.empty()) throw Error(fault);
    return;
  }
  throw Error(fmt::format("none of the {} frames can be read: {}", entries_.size(), first_fault));
}

Frame SequenceReader::read(const Entry& entry) const {
  Frame frame;
  frame.stamp = entry.stamp;
  const cv::Mat image = readPng(entry.image_path);
  try {
    frame.image = toGrey(image, ChannelOrder::kBgr);
  } catch (const Error& error) {
    throw Error(entry.image_path + ": " + error.what());
  }
  frame.depth = readPng(entry.depth_path);
  if (frame.depth.type() != CV_16UC1) {
    throw Error(entry.depth_path + " is no 16-bit image with one channel, as depth has to be");
  }
  frame.depth_unit = 1.0 / camera_.depth_units_per_metre;
  return frame;
}

std::string SequenceReader::sizeFault(const Frame& frame, const Entry& entry) const {
  const Camera& camera = camera_.camera;
  if (frame.image.cols != camera.width || frame.image.rows != camera.height) {
    return entry.image_path + " has " + sizeText(frame.image) + " pixels, but the camera " +
           sizeText(camera.width, camera.height);
  }
  if (frame.depth.size() != frame.image.size()) {
    return entry.depth_path + " has " + sizeText(frame.depth) + " pixels, but the colour image " +
           sizeText(frame.image) + ": the depth is not registered to the colour camera";
  }
  return {};
}

FrameSource::Status SequenceReader::next(Frame& frame, std::string& fault) {
  if (next_ >= entries_.size()) return Status::kEnd;
  const Entry& entry = entries_[next_++];
  try {
    frame = read(entry);
    fault = sizeFault(frame, entry);
  } catch (const Error& error) {
    fault = error.what();
  }
  return fault.empty() ? Status::kFrame : Status::kSkipped;
}

}  // namespace mivo
