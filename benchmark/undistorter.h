// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core/mat.hpp>
#include <opencv2/core/matx.hpp>

#include "mivo/core/camera.h"

namespace mivo {

/// Focal lengths and principal point in OpenCV's form.
cv::Matx33d cameraMatrix(const Camera& camera);

/// Images as a camera with the same focal lengths and principal point, but without distortion,
/// would take them: what an odometry needs that knows nothing about lenses.
class Undistorter {
 public:
  explicit Undistorter(const Camera& camera);

  /// Whether there is anything to do; otherwise the functions below return their argument.
  bool isNeeded() const { return !map_.empty(); }

  cv::Mat image(const cv::Mat& distorted) const;  ///< bilinear, black where nothing was seen
  cv::Mat depth(const cv::Mat& distorted) const;  ///< the nearest pixel's, 0 where nothing was seen

 private:
  cv::Mat map_;
  cv::Mat map_fraction_;
};

}  // namespace mivo
