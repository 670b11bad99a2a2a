// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

#include "core/geometry/row_motion.h"
#include "core/kernels/kernels.h"
#include "mivo/core/camera.h"

namespace mivo {

/// Standard deviation of one reading of a structured-light sensor, m: its disparity is quantized,
/// so it grows with the square of the depth.
inline float depthDeviation(float z) {
  return 0.0025F * z * z + 0.0007F;
}

/// Points of a keyframe on planar patches, with normals: what the geometric term aligns. Chosen so
/// that the normals point in as many directions as the scene has.
struct GeometricPoints {
  std::vector<float> x, y, z;     ///< m, optical frame of the keyframe, at its middle row
  std::vector<float> nx, ny, nz;  ///< unit normal
  std::vector<float> weight;      ///< 1 / standard deviation of a reading there, 1/m

  std::size_t size() const { return x.size(); }
};

/// Fits planes to patches of a depth image and picks points of them. The first `first_part` points
/// alone cover all directions, too, and are in reading order.
/// @param depth CV_32FC1 meters, 0 for none; @param camera and @param rows of the same level.
void makeGeometricPoints(const cv::Mat& depth, const Camera& camera, const RowMotion& rows,
                         int first_part, int max_points, GeometricPoints& points);

}  // namespace mivo
