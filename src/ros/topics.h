// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Names used by launch files, bags and other nodes.

namespace mivo {
namespace topics {

// Inputs of the odometry.
constexpr char kColor[] = "rgb/image";
constexpr char kDepth[] = "depth/image";
constexpr char kCameraInfo[] = "rgb/camera_info";

// Outputs of the odometry.
constexpr char kOdometry[] = "odom";
constexpr char kPath[] = "path";
constexpr char kStatus[] = "status";
constexpr char kKeyframeCloud[] = "keyframe_cloud";
constexpr char kKeyframeMarkers[] = "keyframes";
constexpr char kStateMarkers[] = "state_markers";
constexpr char kReferenceImage[] = "reference/image";
constexpr char kResidualImage[] = "residual/image";

// Services of the odometry, in its private namespace.
constexpr char kReset[] = "reset";
constexpr char kSetPose[] = "set_pose";
constexpr char kPause[] = "pause";
constexpr char kSaveTrajectory[] = "save_trajectory";

// Added by sequence_to_bag when the folder has ground truth.
constexpr char kGroundTruth[] = "/ground_truth";
constexpr char kStaticTransforms[] = "/tf_static";

}  // namespace topics

namespace frames {

constexpr char kWorld[] = "world";     ///< frame of the ground truth
constexpr char kOdometry[] = "odom";   ///< default of odom_frame
constexpr char kBase[] = "base_link";  ///< default of base_frame
constexpr char kCameraLink[] = "camera_link";
constexpr char kColorFrame[] = "camera_rgb_frame";
constexpr char kColorOptical[] = "camera_rgb_optical_frame";

}  // namespace frames
}  // namespace mivo
