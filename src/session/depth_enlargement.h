// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core/mat.hpp>

namespace mivo {

/// Whether a size is another one times a whole number above 1.
bool isWholeMultiple(const cv::Size& large, const cv::Size& small);

/// A pixel of CV_32FC1 (m) or CV_16UC1 depth (steps of `unit` m) in meters; NaN for no reading.
float depthInMeters(const cv::Mat& depth, double unit, int x, int y);

/// Depth at a size that is a whole multiple of its own: CV_32FC1, m. Where four readings lie on one
/// surface what is between them lies on its plane, elsewhere the nearest one is taken.
cv::Mat enlargeDepth(const cv::Mat& depth, double unit, const cv::Size& size);

}  // namespace mivo
