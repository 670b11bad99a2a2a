// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <string>
#include <vector>

#include "io/image_file.h"
#include "io/table_reader.h"
#include "mivo/core/error.h"
#include "mivo/io/camera_file.h"
#include "mivo/io/trajectory_io.h"
#include "programs/command_line.h"
#include "programs/progress_bar.h"
#include "ros/bag_writer.h"

namespace {

namespace fs = std::filesystem;

struct Image {
  double stamp;
  bool is_depth;
  std::string path;
};

/// Images of a list of lines with `stamp path` from field `first` on.
void readList(const fs::path& folder, const char* name, std::size_t fields, std::size_t first,
              bool is_depth, std::vector<Image>& images) {
  mivo::TableReader table((folder / name).string());
  while (table.next()) {
    if (table.size() != fields) table.refuse("expected " + std::to_string(fields) + " fields");
    images.push_back({table.number(first), is_depth, (folder / table.text(first + 1)).string()});
  }
}

/// All images in the order of their stamps: those of associations.txt, so that the bag has the same
/// pairs as the folder, or else all of both lists.
std::vector<Image> readImages(const fs::path& folder) {
  if (!fs::is_directory(folder)) throw mivo::Error("there is no folder " + folder.string());
  std::vector<Image> images;
  if (fs::exists(folder / "associations.txt")) {
    readList(folder, "associations.txt", 4, 0, false, images);
    readList(folder, "associations.txt", 4, 2, true, images);
  } else {
    readList(folder, "rgb.txt", 2, 0, false, images);
    readList(folder, "depth.txt", 2, 0, true, images);
  }
  std::stable_sort(images.begin(), images.end(),
                   [](const Image& a, const Image& b) { return a.stamp < b.stamp; });
  return images;
}

mivo::SequenceCamera readCameraOf(const fs::path& folder) {
  if (fs::exists(folder / "camera.txt")) return mivo::readCamera((folder / "camera.txt").string());
  const auto known = mivo::tumCamera(fs::canonical(folder).filename().string());
  if (known) return *known;
  throw mivo::Error(folder.string() + " has no camera.txt");
}

void writeImages(const std::vector<Image>& images, mivo::BagWriter& bag) {
  mivo::ProgressBar progress(images.size());
  std::size_t skipped = 0;
  for (const Image& image : images) {
    try {
      const cv::Mat pixels = mivo::readImage(image.path);
      if (image.is_depth) {
        bag.writeDepth(image.stamp, pixels);
      } else {
        bag.writeColor(image.stamp, pixels);
      }
    } catch (const mivo::Error& error) {
      progress.clear();
      std::cerr << "skipped: " << image.path << ": " << error.what() << "\n";
      ++skipped;
    }
    progress.advance();
  }
  if (skipped == images.size()) throw mivo::Error("none of the images could be used");
}

void writeTruth(const fs::path& folder, const std::vector<Image>& images, mivo::BagWriter& bag) {
  if (!fs::exists(folder / "groundtruth.txt")) return;
  const auto first = std::find_if(images.begin(), images.end(),
                                  [](const Image& image) { return !image.is_depth; });
  if (first == images.end()) return;
  const mivo::Trajectory truth = mivo::readTrajectory((folder / "groundtruth.txt").string());
  if (!bag.writeGroundTruth(truth, first->stamp)) {
    std::cerr
        << "sequence_to_bag: note: the ground truth has no pose within 20 ms of the first image: "
           "the bag has no transform from world to odom\n";
  }
}

void run(int argc, char** argv) {
  namespace po = boost::program_options;
  std::string folder;
  std::string path;
  std::string layout_name;
  bool compressed = false;
  bool force = false;
  mivo::CommandLine line("sequence_to_bag", "Converts a sequence folder to a bag.");
  line.argument("FOLDER", &folder, "sequence folder to read");
  line.argument("BAG", &path, "bag to write");
  line.options()("layout", po::value<std::string>(&layout_name)->default_value("tum"),
                 "names and types of the topics: tum, openni2, rtabmap or realsense")(
      "compressed", po::bool_switch(&compressed),
      "write PNG images on the compressed topics; depth in millimeters")(
      "force", po::bool_switch(&force), "replace an existing bag");
  if (!line.parse(argc, argv)) return;
  const auto& layouts = mivo::bagLayouts();
  if (std::none_of(layouts.begin(), layouts.end(),
                   [&](const mivo::BagLayout& layout) { return layout.name == layout_name; })) {
    throw mivo::UsageError("--layout: '" + layout_name +
                           "' is not one of tum, openni2, rtabmap, realsense");
  }
  const std::vector<Image> images = readImages(folder);
  mivo::BagWriter bag(path, mivo::bagLayout(layout_name), readCameraOf(folder),
                      compressed ? mivo::BagImages::kCompressed : mivo::BagImages::kRaw,
                      force ? mivo::Overwrite::kYes : mivo::Overwrite::kNo);
  writeTruth(folder, images, bag);
  writeImages(images, bag);
}

}  // namespace

int main(int argc, char** argv) {
  return mivo::runProgram("sequence_to_bag", [&] { run(argc, argv); });
}
