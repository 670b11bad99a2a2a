// SPDX-License-Identifier: BSD-3-Clause
#include "io/sequence_writer.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <limits>

#include "io/image_file.h"
#include "mivo/core/error.h"

namespace mivo {
namespace {

namespace fs = std::filesystem;

const char* const kLists[] = {"rgb.txt", "depth.txt", "associations.txt", "groundtruth.txt",
                              "camera.txt"};
const char* const kImageFolders[] = {"rgb", "depth"};

std::string inside(const std::string& folder, const std::string& name) {
  return (fs::path(folder) / name).string();
}

void createFolder(const std::string& path) {
  std::error_code error;
  fs::create_directories(path, error);
  if (error) throw Error("cannot create the folder " + path + ": " + error.message());
}

}  // namespace

SequenceWriter::SequenceWriter(const std::string& folder, const SequenceCamera& camera,
                               Overwrite overwrite)
    : folder_(folder), camera_(camera), last_stamp_(-std::numeric_limits<double>::infinity()) {
  camera.camera.validate();
  if (!std::isfinite(camera.depth_units_per_meter) || !(camera.depth_units_per_meter > 0.0)) {
    throw Error(fmt::format("{} depth units per meter: a positive number is needed",
                            camera.depth_units_per_meter));
  }
  createFolder(folder);
  if (overwrite == Overwrite::kYes) removeOld();
  for (const char* name : kLists) refuseExisting(inside(folder, name), Overwrite::kNo);
  for (const char* name : kImageFolders) {
    createFolder(inside(folder, name));
    if (!fs::is_empty(inside(folder, name))) {
      throw Error(inside(folder, name) +
                  " is not empty: choose another folder, or --force to replace it");
    }
  }
  writeCamera(inside(folder, "camera.txt"), camera, Overwrite::kNo);
  images_.emplace(inside(folder, "rgb.txt"), Overwrite::kNo);
  images_->write("# stamp path\n");
  depths_.emplace(inside(folder, "depth.txt"), Overwrite::kNo);
  depths_->write("# stamp path\n");
  associations_.emplace(inside(folder, "associations.txt"), Overwrite::kNo);
}

void SequenceWriter::removeOld() const {
  for (const char* name : kLists) fs::remove(inside(folder_, name));
  for (const char* name : kImageFolders) {
    if (!fs::is_directory(inside(folder_, name))) continue;
    for (const fs::directory_entry& entry : fs::directory_iterator(inside(folder_, name))) {
      if (entry.path().extension() == ".png") fs::remove(entry.path());
    }
  }
}

cv::Mat SequenceWriter::storedDepth(const cv::Mat& depth) const {
  if (depth.type() == CV_16UC1) return depth;
  if (depth.type() != CV_32FC1) throw Error("depth to be written is neither CV_16UC1 nor CV_32FC1");
  cv::Mat stored(depth.size(), CV_16UC1);
  for (int y = 0; y < depth.rows; ++y) {
    const float* const meters = depth.ptr<float>(y);
    std::uint16_t* const units = stored.ptr<std::uint16_t>(y);
    for (int x = 0; x < depth.cols; ++x) {
      const double value = std::round(double{meters[x]} * camera_.depth_units_per_meter);
      const bool fits = value > 0.0 && value <= std::numeric_limits<std::uint16_t>::max();
      units[x] = fits ? static_cast<std::uint16_t>(value) : std::uint16_t{0};
    }
  }
  return stored;
}

void SequenceWriter::writeFrame(double stamp, const cv::Mat& image, double depth_stamp,
                                const cv::Mat& depth) {
  const cv::Size size(camera_.camera.width, camera_.camera.height);
  if (image.size() != size || depth.size() != size) {
    throw Error(fmt::format("frame {:.6f} for {} has not the size of the camera", stamp, folder_));
  }
  if (image.type() != CV_8UC1 && image.type() != CV_8UC3 && image.type() != CV_16UC1) {
    throw Error(fmt::format("frame {:.6f} for {} is neither gray nor 8-bit color", stamp, folder_));
  }
  const std::string image_stamp = fmt::format("{:.6f}", stamp);
  const std::string depth_text = fmt::format("{:.6f}", depth_stamp);
  const std::string image_name = "rgb/" + image_stamp + ".png";
  const std::string depth_name = "depth/" + depth_text + ".png";
  if (!std::isfinite(stamp) || !std::isfinite(depth_stamp) || !(stamp > last_stamp_) ||
      image_name == last_image_ || depth_name == last_depth_) {
    throw Error(fmt::format("frame {} (depth {}) for {} is not newer than the one before it",
                            image_stamp, depth_text, folder_));
  }
  const cv::Mat stored_depth = storedDepth(depth);  // refused before anything is written
  writePng(inside(folder_, image_name), image, Overwrite::kNo);
  writePng(inside(folder_, depth_name), stored_depth, Overwrite::kNo);
  images_->write(image_stamp + " " + image_name + "\n");
  depths_->write(depth_text + " " + depth_name + "\n");
  associations_->write(image_stamp + " " + image_name + " " + depth_text + " " + depth_name + "\n");
  last_stamp_ = stamp;
  last_image_ = image_name;
  last_depth_ = depth_name;
}

void SequenceWriter::writePose(const StampedPose& pose) {
  if (!truth_) truth_.emplace(inside(folder_, "groundtruth.txt"), Overwrite::kNo);
  truth_->write(pose);
}

}  // namespace mivo
