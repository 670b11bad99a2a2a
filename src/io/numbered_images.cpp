// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <map>

#include "io/image_file.h"
#include "io/known_camera.h"
#include "io/sequence_layout.h"
#include "io/table_reader.h"
#include "mivo/core/error.h"
#include "session/stamp_order.h"

namespace mivo {
namespace {

namespace fs = std::filesystem;

constexpr double kMicrosecond = 1e-6;

/// What a file's name says: "0000012-000000400345" is image 12 at 0.400345 s, "frame-000012" and
/// "12" have no time.
struct ImageNumber {
  long number = 0;
  std::optional<double> stamp;  // s
};

bool isDigits(const std::string& text) {
  return !text.empty() && text.size() <= 15 &&
         std::all_of(text.begin(), text.end(),
                     [](unsigned char c) { return std::isdigit(c) != 0; });
}

std::optional<ImageNumber> numberOf(const std::string& stem) {
  const std::size_t dash = stem.rfind('-');
  const std::string last = dash == std::string::npos ? stem : stem.substr(dash + 1);
  if (!isDigits(last)) return std::nullopt;
  if (dash != std::string::npos && isDigits(stem.substr(0, dash))) {
    return ImageNumber{std::stol(stem.substr(0, dash)),
                       kMicrosecond * static_cast<double>(std::stol(last))};
  }
  return ImageNumber{std::stol(last), std::nullopt};
}

/// Calls take(number, path) for the files of a folder whose names end with one of the endings and
/// have a number.
template <typename Take>
void findNumbered(const fs::path& folder, const std::vector<std::string>& endings,
                  const Take& take) {
  if (!fs::is_directory(folder)) return;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    for (const std::string& ending : endings) {
      if (name.size() <= ending.size() ||
          name.compare(name.size() - ending.size(), ending.size(), ending) != 0) {
        continue;
      }
      const auto number = numberOf(name.substr(0, name.size() - ending.size()));
      if (number) take(*number, entry.path());
    }
  }
}

/// The images of a folder by their numbers.
std::map<long, ListedImage> numberedImages(const fs::path& folder,
                                           const std::vector<std::string>& endings,
                                           bool& have_stamps) {
  std::map<long, ListedImage> images;
  findNumbered(folder, endings, [&](const ImageNumber& number, const fs::path& path) {
    have_stamps = have_stamps && number.stamp;
    images[number.number] = {
        number.stamp.value_or(static_cast<double>(number.number) / kAssumedFrameRate),
        path.string()};
  });
  return images;
}

std::vector<ListedImage> listOf(const std::map<long, ListedImage>& images) {
  std::vector<ListedImage> list;
  for (const auto& [number, image] : images) list.push_back(image);
  return list;
}

/// Where the images of a layout lie and how their names end.
struct ImageNames {
  fs::path color_folder;
  std::vector<std::string> color_endings;
  fs::path depth_folder;
  std::vector<std::string> depth_endings;
};

/// Pairs by number, or by stamp where the names have them; false when there is no pair.
bool takeImages(const ImageNames& names, const fs::path& folder, SequenceListing& listing) {
  bool have_stamps = true;
  const auto images = numberedImages(names.color_folder, names.color_endings, have_stamps);
  const auto depths = numberedImages(names.depth_folder, names.depth_endings, have_stamps);
  if (images.empty() || depths.empty()) return false;
  if (have_stamps) {
    std::vector<ListedImage> ordered_images = listOf(images);
    std::vector<ListedImage> ordered_depths = listOf(depths);
    putInOrder(ordered_images);
    putInOrder(ordered_depths);
    pairImages(ordered_images, ordered_depths, folder.string(), listing);
    return true;
  }
  for (const auto& [number, image] : images) {
    const auto depth = depths.find(number);
    if (depth != depths.end()) {
      const double stamp = static_cast<double>(number) / kAssumedFrameRate;
      listing.frames.push_back({stamp, image.path, stamp, depth->second.path});
    }
  }
  return !listing.frames.empty();
}

void tellLayout(const fs::path& folder, const std::string& layout, const std::string& more,
                SequenceListing& listing) {
  std::string text = fmt::format("{} is laid out as {}: the camera is {} ({})", folder.string(),
                                 layout, listing.camera_file, describe(listing.camera));
  if (!more.empty()) text += "; " + more;
  listing.notices.push_back(text);
}

const char* const kNoTimes = "its images have no times: 30 Hz are assumed";

/// One of ScanNet's _info.txt: 'm_calibrationDepthIntrinsic = 16 numbers', 'm_depthShift = 1000'.
void readScanNetInfo(const fs::path& file, SequenceListing& listing) {
  TableReader table(file.string());
  while (table.next()) {
    if (table.text(0) == "m_depthShift" && table.size() > 2) {
      listing.camera.depth_units_per_meter = table.number(2);
    }
    if (table.text(0) != "m_calibrationDepthIntrinsic") continue;
    if (table.size() != 18) table.refuse("expected 16 numbers of a matrix");
    Camera& camera = listing.camera.camera;
    camera.fx = table.number(2);
    camera.cx = table.number(4);
    camera.fy = table.number(7);
    camera.cy = table.number(8);
  }
  if (!(listing.camera.camera.fx > 0.0)) {
    throw Error(file.string() + " has no m_calibrationDepthIntrinsic");
  }
  listing.camera_file = "_info.txt";
}

/// frame-000000.color.png, frame-000000.depth.png beside each other.
std::optional<SequenceListing> readFrameFiles(const fs::path& folder) {
  SequenceListing listing;
  const ImageNames names{
      folder, {".color.png", ".color.jpg"}, folder, {".depth.png", ".depth.pgm"}};
  if (!takeImages(names, folder, listing)) return std::nullopt;
  const fs::path intrinsics = "camera-intrinsics.txt";
  const fs::path parent = fs::canonical(folder).parent_path();
  listing.depth_coding = DepthCoding::kSaturated;
  if (takeCameraFile(folder, listing)) {
    tellLayout(folder, "7-Scenes", kNoTimes, listing);
  } else if (fs::exists(folder / "_info.txt")) {
    readScanNetInfo(folder / "_info.txt", listing);
    listing.is_color_reduced = true;
    tellLayout(folder, "ScanNet", kNoTimes, listing);
  } else if (fs::exists(folder / intrinsics) || fs::exists(parent / intrinsics)) {
    const bool is_here = fs::exists(folder / intrinsics);
    listing.camera.camera = readIntrinsics((is_here ? folder : parent) / intrinsics);
    listing.camera_file = intrinsics.string();
    tellLayout(folder, "3DMatch", kNoTimes, listing);
  } else {
    listing.camera = sevenScenesCamera();
    listing.camera_file = "7-Scenes' published depth camera";
    tellLayout(folder, "7-Scenes",
               std::string(kNoTimes) + "; its depth is not registered to the color", listing);
  }
  return listing;
}

/// color/0.jpg, depth/0.png, intrinsic/intrinsic_depth.txt.
std::optional<SequenceListing> readScanNet(const fs::path& folder) {
  const fs::path intrinsics = folder / "intrinsic" / "intrinsic_depth.txt";
  if (!fs::exists(intrinsics)) return std::nullopt;
  SequenceListing listing;
  const ImageNames names{folder / "color", {".jpg", ".png"}, folder / "depth", {".png", ".pgm"}};
  if (!takeImages(names, folder, listing)) return std::nullopt;
  listing.is_color_reduced = true;
  if (!takeCameraFile(folder, listing)) {
    listing.camera.camera = readIntrinsics(intrinsics);
    listing.camera_file = "intrinsic/intrinsic_depth.txt";
  }
  tellLayout(folder, "ScanNet", kNoTimes, listing);
  return listing;
}

/// image/0000001-000000000000.jpg, depth/0000001-000000000000.png, intrinsics.txt.
std::optional<SequenceListing> readSun3d(const fs::path& folder) {
  if (!fs::exists(folder / "intrinsics.txt")) return std::nullopt;
  SequenceListing listing;
  const ImageNames names{folder / "image", {".jpg", ".png"}, folder / "depth", {".png"}};
  if (!takeImages(names, folder, listing)) return std::nullopt;
  listing.depth_coding = DepthCoding::kRotated;
  if (!takeCameraFile(folder, listing)) {
    listing.camera.camera = readIntrinsics(folder / "intrinsics.txt");
    listing.camera_file = "intrinsics.txt";
  }
  tellLayout(folder, "SUN3D", "its depth is stored rotated by three bits", listing);
  return listing;
}

/// A folder of numbered color images beside one of depth, and a camera.txt.
std::optional<SequenceListing> readNumberedFolders(const fs::path& folder) {
  if (!fs::exists(folder / "camera.txt")) return std::nullopt;
  for (const char* color : {"color", "rgb", "image"}) {
    SequenceListing listing;
    const ImageNames names{folder / color, {".jpg", ".png"}, folder / "depth", {".png", ".pgm"}};
    if (!takeImages(names, folder, listing)) continue;
    takeCameraFile(folder, listing);
    tellLayout(folder, fmt::format("numbered images in {} and depth", color), "", listing);
    return listing;
  }
  return std::nullopt;
}

}  // namespace

std::map<long, fs::path> numberedFiles(const fs::path& folder,
                                       const std::vector<std::string>& endings) {
  std::map<long, fs::path> files;
  findNumbered(folder, endings, [&](const ImageNumber& number, const fs::path& path) {
    files[number.number] = path;
  });
  return files;
}

std::optional<SequenceListing> readNumberedImages(const fs::path& folder) {
  for (const auto& read : {readFrameFiles, readScanNet, readSun3d, readNumberedFolders}) {
    if (auto listing = read(folder)) return listing;
  }
  return std::nullopt;
}

}  // namespace mivo
