// SPDX-License-Identifier: BSD-3-Clause
#include "undistorter.h"

#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include "mivo/core/error.h"

namespace mivo {

cv::Matx33d cameraMatrix(const Camera& camera) {
  return {camera.fx, 0.0, camera.cx, 0.0, camera.fy, camera.cy, 0.0, 0.0, 1.0};
}

Undistorter::Undistorter(const Camera& camera) {
  const Distortion& lens = camera.distortion;
  if (lens.isZero()) return;
  if (lens.model == LensModel::kEquidistant) {
    throw Error(
        "the other odometries take no equidistant lens, and not all of it fits a pinhole's "
        "image");
  }
  const cv::Matx33d matrix = cameraMatrix(camera);
  const cv::Vec<double, 8> coefficients(lens.k1, lens.k2, lens.p1, lens.p2, lens.k3, lens.k4,
                                        lens.k5, lens.k6);
  cv::initUndistortRectifyMap(matrix, coefficients, cv::noArray(), matrix,
                              {camera.width, camera.height}, CV_16SC2, map_, map_fraction_);
}

cv::Mat Undistorter::image(const cv::Mat& distorted) const {
  if (!isNeeded()) return distorted;
  cv::Mat result;
  cv::remap(distorted, result, map_, map_fraction_, cv::INTER_LINEAR);
  return result;
}

cv::Mat Undistorter::depth(const cv::Mat& distorted) const {
  if (!isNeeded()) return distorted;
  cv::Mat result;
  cv::remap(distorted, result, map_, map_fraction_, cv::INTER_NEAREST);
  return result;
}

}  // namespace mivo
