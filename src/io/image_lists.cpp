// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "io/image_file.h"
#include "io/known_camera.h"
#include "io/sequence_layout.h"
#include "io/table_reader.h"
#include "mivo/core/error.h"
#include "session/stamp_order.h"

namespace mivo {
namespace {

namespace fs = std::filesystem;

// Of pairs; the second is ETH3D's name for it.
constexpr const char* kPairLists[] = {"associations.txt", "associated.txt"};
constexpr const char* kImageEndings[] = {".png", ".jpg", ".jpeg", ".pgm"};

/// A line of a list of pairs, in the order of the file.
struct ListedPair {
  double stamp;
  std::string path;
  double other_stamp;
  std::string other_path;
};

void tell(SequenceListing& listing, const std::string& text) {
  if (!text.empty()) listing.notices.push_back(text);
}

/// Puts the lines of a file in the order of their stamps, in seconds, and says so.
template <typename Line>
StampOrder orderLines(std::vector<Line>& lines, const fs::path& file, SequenceListing& listing) {
  try {
    const StampOrder order = putInOrder(lines);
    tell(listing, describe(order, "lines of " + file.string()));
    return order;
  } catch (const Error& error) {
    throw Error(file.string() + ": " + error.what());
  }
}

std::vector<ListedImage> readImageList(const fs::path& folder, const char* name,
                                       SequenceListing& listing) {
  std::vector<ListedImage> images;
  const fs::path file = folder / name;
  TableReader table(file.string());
  while (table.next()) {
    if (table.size() < 2) table.refuse("expected 'stamp path'");
    images.push_back({table.number(0), (folder / table.textOf(1, table.size() - 1)).string()});
  }
  if (images.empty()) throw Error(file.string() + " lists no image");
  orderLines(images, file, listing);
  return images;
}

bool isImageName(const std::string& text) {
  std::string ending = fs::path(text).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char character) { return std::tolower(character); });
  return std::find(std::begin(kImageEndings), std::end(kImageEndings), ending) !=
         std::end(kImageEndings);
}

/// The field at which the second stamp stands. With blanks in paths: a number behind the name of an
/// image.
std::size_t secondStamp(const TableReader& table) {
  if (table.size() > 4) {
    for (std::size_t i = 2; i + 1 < table.size(); ++i) {
      if (table.isNumber(i) && isImageName(table.text(i - 1))) return i;
    }
  }
  if (table.size() != 4) table.refuse("expected 'stamp_rgb path stamp_depth path'");
  return 2;
}

bool isFile(const std::string& path) {
  std::error_code ignored;  // then it is none that could be read
  return fs::exists(path, ignored);
}

/// More fields than four are blanks in paths, if there are such files in any line.
void requireFiles(const std::vector<ListedPair>& pairs, std::size_t fields, const fs::path& file) {
  const bool has_files = std::any_of(pairs.begin(), pairs.end(), [](const ListedPair& pair) {
    return isFile(pair.path) && isFile(pair.other_path);
  });
  if (fields <= 4 || has_files) return;
  throw Error(
      fmt::format("{}: expected 'stamp_rgb path stamp_depth path', found {} fields, of which {} "
                  "and {} would be the images: no line has such files",
                  file.string(), fields, pairs.front().path, pairs.front().other_path));
}

std::vector<ListedPair> readPairs(const fs::path& folder, const fs::path& file) {
  std::vector<ListedPair> pairs;
  std::size_t fields = 0;  // of the longest line
  TableReader table(file.string());
  while (table.next()) {
    const std::size_t second = secondStamp(table);
    pairs.push_back({table.number(0), (folder / table.textOf(1, second - 1)).string(),
                     table.number(second),
                     (folder / table.textOf(second + 1, table.size() - 1)).string()});
    fields = std::max(fields, table.size());
  }
  if (pairs.empty()) throw Error(file.string() + " lists no frame");
  requireFiles(pairs, fields, file);
  return pairs;
}

enum class ImageKind { kUnreadable, kDepth, kColor };

ImageKind kindOf(const std::string& path) {
  try {
    return readImage(path).type() == CV_16UC1 ? ImageKind::kDepth : ImageKind::kColor;
  } catch (const Error&) {
    return ImageKind::kUnreadable;  // its frame is skipped when its turn comes
  }
}

/// Whether the first image of each line is the depth: by the first two images that tell, for a
/// camera of 16-bit gray by the name of the folder.
bool isDepthFirst(const std::vector<ListedPair>& pairs) {
  for (const ListedPair& pair : pairs) {
    const ImageKind kind = kindOf(pair.path);
    const ImageKind other = kindOf(pair.other_path);
    if (kind == ImageKind::kUnreadable || other == ImageKind::kUnreadable) continue;
    if (kind != other) return kind == ImageKind::kDepth;
    const auto is_depth_folder = [](const std::string& path) {
      return fs::path(path).parent_path().filename() == "depth";
    };
    return is_depth_folder(pair.path) && !is_depth_folder(pair.other_path);
  }
  return false;
}

void takePairs(const fs::path& folder, const fs::path& file, SequenceListing& listing) {
  const std::vector<ListedPair> pairs = readPairs(folder, file);
  const bool is_depth_first = isDepthFirst(pairs);
  if (is_depth_first) tell(listing, file.string() + " names depth first: read so");
  for (const ListedPair& pair : pairs) {
    if (is_depth_first) {
      listing.frames.push_back({pair.other_stamp, pair.other_path, pair.stamp, pair.path});
    } else {
      listing.frames.push_back({pair.stamp, pair.path, pair.other_stamp, pair.other_path});
    }
  }
  const double unit = orderLines(listing.frames, file, listing).unit;
  for (ListedFrame& frame : listing.frames) frame.depth_stamp *= unit;
}

bool hasFileEndingWith(const fs::path& folder, const std::string& ending) {
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (name.size() > ending.size() &&
        name.compare(name.size() - ending.size(), ending.size(), ending) == 0) {
      return true;
    }
  }
  return false;
}

/// Name of the folder itself, also when it was given as "." or with a slash at its end.
std::string folderName(const fs::path& folder) {
  return fs::canonical(folder).filename().string();
}

/// ETH3D's calibration.txt: one line 'fx fy cx cy'.
SequenceCamera readEth3dCamera(const fs::path& file) {
  TableReader table(file.string());
  if (!table.next() || table.size() != 4) table.refuse("expected 'fx fy cx cy'");
  SequenceCamera camera;
  camera.camera.fx = table.number(0);
  camera.camera.fy = table.number(1);
  camera.camera.cx = table.number(2);
  camera.camera.cy = table.number(3);
  camera.depth_units_per_meter = 5000.0;
  return camera;
}

/// ICL-NUIM's zip: frame numbers for stamps, depth first, no camera.
bool isIclNuim(const fs::path& folder) {
  if (hasFileEndingWith(folder, ".gt.freiburg")) return true;
  if (!fs::exists(folder / kPairLists[0])) return false;
  const std::vector<ListedPair> pairs = readPairs(folder, folder / kPairLists[0]);
  return std::all_of(pairs.begin(), pairs.end(),
                     [](const ListedPair& p) { return p.stamp == std::floor(p.stamp); }) &&
         isDepthFirst(pairs);
}

void takeCamera(const fs::path& folder, SequenceListing& listing) {
  if (takeCameraFile(folder, listing)) return;
  const std::string name = folderName(folder);
  if (fs::exists(folder / "calibration.txt")) {
    listing.camera = readEth3dCamera(folder / "calibration.txt");
    listing.camera_file = "calibration.txt of ETH3D";
    tell(listing, folder.string() +
                      " is laid out as ETH3D-SLAM: the camera is that of calibration.txt (" +
                      describe(listing.camera) + ")");
  } else if (isIclNuim(folder)) {
    listing.camera = iclCamera();
    listing.camera_file = "ICL-NUIM's published camera";
    tell(
        listing,
        folder.string() + " is laid out as ICL-NUIM: its published camera is taken (" +
            describe(listing.camera) +
            "), with the y axis down; its true poses have it up: ty, qx and qz change their signs");
  } else if (const auto known = cameraByName(name)) {
    listing.camera = known->camera;
    listing.camera_file = known->whose + ": published camera";
    tell(listing, folder.string() + " has no camera.txt: the published camera of " + known->whose +
                      " is taken, by the folder's name " + name + " (" + describe(listing.camera) +
                      ")");
  } else {
    throw Error(
        folder.string() +
        " has no camera.txt, and its name is none of TUM's freiburg1, 2 or 3; write the line "
        "'width height fx fy cx cy depth_units_per_meter [k1 k2 p1 p2 k3]' into camera.txt");
  }
}

}  // namespace

bool hasImageLists(const fs::path& folder) {
  constexpr const char* kLists[] = {"rgb.txt", "depth.txt", kPairLists[0], kPairLists[1]};
  return std::any_of(std::begin(kLists), std::end(kLists),
                     [&](const char* name) { return fs::exists(folder / name); });
}

SequenceListing readImageLists(const fs::path& folder) {
  SequenceListing listing;
  takeCamera(folder, listing);
  for (const char* name : kPairLists) {
    if (!fs::exists(folder / name)) continue;
    takePairs(folder, folder / name, listing);
    return listing;
  }
  const std::vector<ListedImage> images = readImageList(folder, "rgb.txt", listing);
  const std::vector<ListedImage> depths = readImageList(folder, "depth.txt", listing);
  pairImages(images, depths, folder.string(), listing);
  return listing;
}

}  // namespace mivo
