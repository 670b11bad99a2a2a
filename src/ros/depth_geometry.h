// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>

#include "ros/recording.h"

namespace mivo {

/// Whether depth is seen by another camera than color, and not registered to it: its frame is
/// another, and its topic's name does not say that it is registered, aligned or "to_rgb".
bool isUnregistered(const std::string& color_frame, const std::string& depth_frame,
                    const std::string& depth_topic);

/// The topic of the calibration that a driver puts beside an image topic.
std::string cameraInfoBeside(const std::string& image_topic);

/// Pose of a frame in another by the recording's /tf_static and /tf, taken as rigid; nothing when
/// they do not tell.
std::optional<Eigen::Isometry3d> findTransform(const Recording& recording,
                                               const std::string& target,
                                               const std::string& source);

/// Why depth cannot be registered: what is missing.
std::string describeMissingGeometry(const std::string& color_frame, const std::string& depth_frame,
                                    const std::string& info_topic, bool has_calibration);

}  // namespace mivo
