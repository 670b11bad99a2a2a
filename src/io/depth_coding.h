// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core/mat.hpp>

namespace mivo {

/// How the 16 bits of a depth pixel are stored.
enum class DepthCoding {
  kPlain,
  kRotated,   ///< by three bits to the left, as SUN3D and SUN RGB-D have it
  kSaturated  ///< 65535, too, is no reading, as 7-Scenes has it
};

/// Makes depth units of the pixels of a CV_16UC1 image, 0 where there is no reading.
void decodeDepth(cv::Mat& depth, DepthCoding coding);

}  // namespace mivo
