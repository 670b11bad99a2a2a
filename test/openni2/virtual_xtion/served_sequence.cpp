// SPDX-License-Identifier: BSD-3-Clause
#include "served_sequence.h"

#include <cmath>
#include <cstdint>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace virtual_xtion {
namespace {

constexpr double kMaxTimeDifference = 0.02;  // s, between the color and depth image of a pair
constexpr double kMillimetersPerMeter = 1000.0;
constexpr double kTenthsPerMeter = 10000.0;
constexpr double kLargestDepth = 65535.0;

using Entry = std::pair<double, std::string>;

std::vector<Entry> readList(const std::string& path) {
  std::ifstream file(path);
  if (!file) {
    throw std::runtime_error("cannot read " + path);
  }
  std::vector<Entry> entries;
  std::string line;
  while (std::getline(file, line)) {
    std::istringstream in(line);
    Entry entry;
    if (!line.empty() && line.front() != '#' && in >> entry.first >> entry.second) {
      entries.push_back(entry);
    }
  }
  return entries;
}

cv::Mat scaled(const cv::Mat& depth, double scale) {
  cv::Mat result(depth.size(), CV_16UC1);
  for (int y = 0; y < depth.rows; ++y) {
    for (int x = 0; x < depth.cols; ++x) {
      const double value = std::round(depth.at<std::uint16_t>(y, x) * scale);
      result.at<std::uint16_t>(y, x) =
          value <= kLargestDepth ? static_cast<std::uint16_t>(value) : std::uint16_t{0};
    }
  }
  return result;
}

}  // namespace

ServedSequence::ServedSequence(const std::string& folder) {
  const std::vector<Entry> color = readList(folder + "/rgb.txt");
  const std::vector<Entry> depth = readList(folder + "/depth.txt");
  for (const Entry& entry : color) {
    const Entry* best = nullptr;
    for (const Entry& candidate : depth) {
      if (best == nullptr ||
          std::abs(candidate.first - entry.first) < std::abs(best->first - entry.first)) {
        best = &candidate;
      }
    }
    if (best != nullptr && std::abs(best->first - entry.first) <= kMaxTimeDifference) {
      paths_.push_back({folder + "/" + entry.second, folder + "/" + best->second});
    }
  }
  if (paths_.empty()) {
    throw std::runtime_error(folder + " has no pair of color and depth");
  }
  images_.resize(paths_.size());
  readCamera(folder + "/camera.txt");
}

void ServedSequence::readCamera(const std::string& path) {
  std::ifstream file(path);
  std::string line;
  while (std::getline(file, line)) {
    std::istringstream in(line);
    double width = 0.0;
    double height = 0.0;
    double fx = 0.0;
    double fy = 0.0;
    double cx = 0.0;
    double cy = 0.0;
    if (line.empty() || line.front() == '#') {
      continue;
    }
    if (in >> width >> height >> fx >> fy >> cx >> cy >> units_per_meter_) {
      horizontal_fov_ = 2.0 * std::atan(0.5 * width / fx);
      vertical_fov_ = 2.0 * std::atan(0.5 * height / fy);
      return;
    }
  }
  throw std::runtime_error(path + " has no camera");
}

const ServedSequence::Images& ServedSequence::images(std::size_t index) {
  Images& images = images_.at(index);
  if (images.color.empty()) {
    const Paths& paths = paths_[index];
    const cv::Mat color = cv::imread(paths.color, cv::IMREAD_COLOR);
    const cv::Mat depth = cv::imread(paths.depth, cv::IMREAD_UNCHANGED);
    if (color.empty() || depth.type() != CV_16UC1) {
      throw std::runtime_error("cannot decode " + paths.color + " or " + paths.depth);
    }
    cv::cvtColor(color, images.color, cv::COLOR_BGR2RGB);
    images.depth_millimeters = scaled(depth, kMillimetersPerMeter / units_per_meter_);
    images.depth_tenths = scaled(depth, kTenthsPerMeter / units_per_meter_);
  }
  return images;
}

}  // namespace virtual_xtion
