// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core/mat.hpp>
#include <string>

#include "mivo/io/output_file.h"

namespace mivo {

/// The image of a PNG, JPEG or PGM file, whatever its name ends with, see decodeImage(). Throws
/// Error, naming the file.
cv::Mat readImage(const std::string& path);

/// Writes a CV_8U image with 1, 3 (blue, green, red) or 4 channels or a CV_16UC1 image. Throws
/// Error.
void writePng(const std::string& path, const cv::Mat& image, Overwrite overwrite);

}  // namespace mivo
