// SPDX-License-Identifier: BSD-3-Clause
#include "io/sequence_layout.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "io/table_reader.h"
#include "mivo/core/error.h"
#include "session/stamp_pairer.h"

namespace mivo {
namespace {

namespace fs = std::filesystem;

// s; an offset of the clocks that pairing by stamps would hide: three images at 30 Hz.
constexpr double kClockOffset = 0.1;
// s; of such an offset, from image to image.
constexpr double kClockJitter = 0.005;

std::vector<double> stampsOf(const std::vector<ListedImage>& images) {
  std::vector<double> stamps;
  for (const ListedImage& image : images) stamps.push_back(image.stamp);
  return stamps;
}

/// From color to the nearest depth, s: the median over the color images.
double medianOffset(const std::vector<ListedImage>& images,
                    const std::vector<ListedImage>& depths) {
  std::vector<double> offsets;
  for (const ListedImage& image : images) {
    const auto after = std::lower_bound(
        depths.begin(), depths.end(), image.stamp,
        [](const ListedImage& depth, double stamp) { return depth.stamp < stamp; });
    double offset =
        after == depths.end() ? depths.back().stamp - image.stamp : after->stamp - image.stamp;
    if (after != depths.begin() && image.stamp - std::prev(after)->stamp < std::abs(offset)) {
      offset = std::prev(after)->stamp - image.stamp;
    }
    offsets.push_back(offset);
  }
  const auto middle = offsets.begin() + static_cast<std::ptrdiff_t>(offsets.size() / 2);
  std::nth_element(offsets.begin(), middle, offsets.end());
  return *middle;
}

/// Equally many images, the n-th depth always later (or earlier) than the n-th color by the same.
void refuseOtherClock(const std::vector<ListedImage>& images,
                      const std::vector<ListedImage>& depths, const std::string& whose) {
  if (images.size() != depths.size() || images.size() < 2) return;
  const double offset = depths.front().stamp - images.front().stamp;
  if (std::abs(offset) < kClockOffset) return;
  for (std::size_t i = 0; i < images.size(); ++i) {
    const double difference = depths[i].stamp - images[i].stamp;
    if (std::abs(difference - offset) > kClockJitter) return;
  }
  throw Error(
      fmt::format("{}: image for image, depth is stamped {:.3f} s {} than color: two clocks; "
                  "images of equal stamps would be of different times. Correct the stamps, or list "
                  "the pairs in associations.txt",
                  whose, std::abs(offset), offset > 0.0 ? "later" : "earlier"));
}

/// Folders directly below that could be meant.
std::vector<std::string> sequencesBelow(const fs::path& folder) {
  std::vector<std::string> names;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    if (!entry.is_directory()) continue;
    try {
      listSequence(entry.path().string());
    } catch (const Error&) {
      continue;  // none, or one that cannot be read
    }
    names.push_back(entry.path().filename().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace

void pairImages(const std::vector<ListedImage>& images, const std::vector<ListedImage>& depths,
                const std::string& whose, SequenceListing& listing) {
  refuseOtherClock(images, depths, whose);
  for (const auto& [i, j] : pairByStamp(stampsOf(images), stampsOf(depths))) {
    listing.frames.push_back({images[i].stamp, images[i].path, depths[j].stamp, depths[j].path});
  }
  if (listing.frames.empty()) {
    const double offset = medianOffset(images, depths);
    throw Error(
        fmt::format("{}: no depth image is within 20 ms of a color image; from color to the "
                    "nearest depth it is {:+.3f} s at the median",
                    whose, offset));
  }
  const auto leave_out = [&](const char* name, std::size_t count) {
    const std::size_t alone = count - listing.frames.size();
    if (alone == 0) return;
    listing.left_out[std::string(name) + " image without a partner within 20 ms"] += alone;
  };
  leave_out("color", images.size());
  leave_out("depth", depths.size());
}

bool takeCameraFile(const fs::path& folder, SequenceListing& listing) {
  const fs::path file = folder / "camera.txt";
  if (!fs::exists(file)) return false;
  listing.camera = readCamera(file.string());
  listing.camera_file = "camera.txt";
  return true;
}

Camera readIntrinsics(const fs::path& file) {
  TableReader table(file.string());
  std::vector<std::vector<double>> rows;
  while (table.next()) {
    if (table.size() < 3) table.refuse("expected a row of the matrix K");
    rows.emplace_back();
    for (std::size_t i = 0; i < table.size(); ++i) rows.back().push_back(table.number(i));
    if (rows.size() == 3 && (rows[2][0] != 0.0 || rows[2][1] != 0.0 || rows[2][2] != 1.0)) {
      table.refuse("the last row of K is not 0 0 1");
    }
  }
  if (rows.size() < 3) throw Error(file.string() + " has no matrix K of three rows");
  Camera camera;
  camera.fx = rows[0][0];
  camera.fy = rows[1][1];
  camera.cx = rows[0][2];
  camera.cy = rows[1][2];
  return camera;
}

SequenceListing listSequence(const std::string& folder) {
  if (hasImageLists(folder)) return readImageLists(folder);
  if (const auto listing = readNumberedImages(folder)) return *listing;
  std::string text =
      folder +
      " is no sequence folder: it has neither rgb.txt and depth.txt (TUM) nor images in a layout "
      "that mivo knows";
  const std::vector<std::string> below = sequencesBelow(folder);
  if (!below.empty()) text += fmt::format("; a folder in it has: {}", fmt::join(below, ", "));
  throw Error(text);
}

}  // namespace mivo
