// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

namespace virtual_xtion {

/// The images of a sequence folder as the camera's sensors see them: RGB, and depth in millimeters
/// and tenths of it.
class ServedSequence {
 public:
  /// Throws std::runtime_error.
  explicit ServedSequence(const std::string& folder);

  std::size_t size() const { return paths_.size(); }

  struct Images {
    cv::Mat color;              ///< CV_8UC3, RGB
    cv::Mat depth_millimeters;  ///< CV_16UC1
    cv::Mat depth_tenths;       ///< CV_16UC1, in 0.1 mm; what does not fit is 0
  };
  /// Decoded once, then kept.
  const Images& images(std::size_t index);

  double horizontalFieldOfView() const { return horizontal_fov_; }  ///< rad
  double verticalFieldOfView() const { return vertical_fov_; }      ///< rad

 private:
  struct Paths {
    std::string color;
    std::string depth;
  };
  void readCamera(const std::string& path);

  std::vector<Paths> paths_;
  std::vector<Images> images_;
  double units_per_meter_ = 0.0;
  double horizontal_fov_ = 0.0;
  double vertical_fov_ = 0.0;
};

}  // namespace virtual_xtion
