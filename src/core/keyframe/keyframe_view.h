// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

#include "core/keyframe/keyframe.h"
#include "mivo/core/odometry.h"

namespace mivo {

/// For display: every second pixel of the keyframe with depth, in its optical frame.
std::vector<CloudPoint> makeCloud(const Keyframe& keyframe, const Camera& camera);

/// For display: live minus keyframe intensity at every second pixel of the keyframe with depth,
/// warped by the pose: CV_8UC1 of half the size, 128 + half the difference; 128 where unknown.
cv::Mat makeResidualImage(const Keyframe& keyframe, const cv::Mat& live, const Camera& camera,
                          const Eigen::Isometry3d& T_live_ref);

}  // namespace mivo
