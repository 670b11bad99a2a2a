// SPDX-License-Identifier: BSD-3-Clause
#include "mivo/io/sequence_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "io/image_file.h"
#include "io/table_reader.h"
#include "mivo/core/error.h"
#include "session/stamp_order.h"
#include "session/stamp_pairer.h"

namespace mivo {
namespace {

namespace fs = std::filesystem;

/// One line of rgb.txt or depth.txt.
struct ListedImage {
  double stamp;
  std::string path;
};

void addNotice(std::string& notice, const std::string& text) {
  if (!notice.empty() && !text.empty()) notice += "; ";
  notice += text;
}

/// Puts the lines of a file in the order of their stamps, and says so.
template <typename Line>
void orderLines(std::vector<Line>& lines, const fs::path& file, std::string& notice) {
  try {
    addNotice(notice, describe(putInOrder(lines), "lines of " + file.string()));
  } catch (const Error& error) {
    throw Error(file.string() + ": " + error.what());
  }
}

std::vector<ListedImage> readImageList(const fs::path& folder, const char* name,
                                       std::string& notice) {
  std::vector<ListedImage> images;
  const fs::path file = folder / name;
  TableReader table(file.string());
  while (table.next()) {
    if (table.size() != 2) table.refuse("expected 'stamp path'");
    images.push_back({table.number(0), (folder / table.text(1)).string()});
  }
  if (images.empty()) throw Error(file.string() + " lists no image");
  orderLines(images, file, notice);
  return images;
}

std::vector<double> stampsOf(const std::vector<ListedImage>& images) {
  std::vector<double> stamps;
  for (const ListedImage& image : images) stamps.push_back(image.stamp);
  return stamps;
}

/// The text without what differs from frame to frame.
std::string withoutPath(std::string text, const std::string& path, const char* name) {
  const std::size_t begin = text.find(path);
  return begin == std::string::npos ? text : text.replace(begin, path.size(), name);
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
    camera_file_ = "camera.txt";
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
  camera_file_ = "TUM's published camera";
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
  if (entries_.empty()) throw Error(table.path() + " lists no frame");
  orderLines(entries_, table.path(), notice_);
}

void SequenceReader::pairEntries(const std::string& folder) {
  const std::vector<ListedImage> images = readImageList(folder, "rgb.txt", notice_);
  const std::vector<ListedImage> depths = readImageList(folder, "depth.txt", notice_);
  for (const auto& [i, j] : pairByStamp(stampsOf(images), stampsOf(depths))) {
    entries_.push_back({images[i].stamp, images[i].path, depths[j].path});
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
  const cv::Mat image = readImage(entry.image_path);
  try {
    frame.image = toGrey(image, ChannelOrder::kBgr);
  } catch (const Error& error) {
    throw Error(entry.image_path + ": " + error.what());
  }
  frame.depth = readImage(entry.depth_path);
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

FrameSource::Status SequenceReader::next(Frame& frame, FrameFault& fault) {
  if (next_ >= entries_.size()) return Status::kEnd;
  const Entry& entry = entries_[next_++];
  std::string text;
  try {
    frame = read(entry);
    text = sizeFault(frame, entry);
  } catch (const Error& error) {
    text = error.what();
  }
  if (text.empty()) return Status::kFrame;
  fault.text = text;
  fault.reason = withoutPath(withoutPath(text, entry.image_path, "the colour image"),
                             entry.depth_path, "the depth image");
  return Status::kSkipped;
}

std::string SequenceReader::depthUnit() const {
  return fmt::format("{}: {} units per metre", camera_file_, camera_.depth_units_per_metre);
}

}  // namespace mivo
