// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core/mat.hpp>

#include "core/geometry/warp.h"
#include "core/images/contrast_maps.h"
#include "core/keyframe/reference_points.h"
#include "core/terms/agreement.h"

namespace mivo {

/// The live image that points are compared with.
struct LiveImage {
  const cv::Mat& gray;          ///< CV_32FC1 or CV_8UC1, of the points' level
  const ContrastMap* contrast;  ///< to normalize it by; null: taken as it is
};

/// Agreement of the intensity gradients of at most so many points, spread over all of them.
/// @param samples where the points fall; @param visible which of them are seen there.
Agreement imageAgreement(const ReferencePoints& points, const LiveImage& image,
                         const LiveSamples& samples, const std::vector<float>& visible,
                         const Warp& warp, const Eigen::Isometry3d& T_live_ref,
                         std::size_t most_points);

}  // namespace mivo
