// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "core/keyframe/keyframe_store.h"
#include "core/odometry/odometry_state.h"
#include "core/odometry/prediction.h"
#include "core/odometry/search.h"
#include "mivo/core/parameters.h"
#include "mivo/core/tracking_result.h"

namespace mivo {

/// State and result after a frame.
struct Outcome {
  OdometryState state;
  TrackingResult result;
};

/// Plan for a keyframe created from the frame.
struct KeyframePlan {
  Eigen::Isometry3d T_odom_camera = Eigen::Isometry3d::Identity();
  Vector6 twist_per_period = Vector6::Zero();  ///< of the scene in the camera's axes
  Matrix6 covariance = Matrix6::Identity();    ///< of the pose
  double last_lit_contrast = 0.0;              ///< see PosedKeyframe
  int segment = 0;
};

/// Decision about a frame.
struct Decision {
  Outcome outcome;                   ///< if it does not become a keyframe
  std::size_t keyframe = 0;          ///< index of the keyframe that becomes the current one
  std::optional<KeyframePlan> plan;  ///< keyframe to create
  Outcome with_keyframe;             ///< if it does
};

/// The first frame, or the first after all keyframes were discarded.
Decision decideFirst(const OdometryState& state, const Prediction& prediction,
                     const TrackingResult& result, const MotionParameters& parameters);

/// A frame whose alignment is accepted: it is tracked, and may become the next keyframe.
/// @param must_become_keyframe regardless of the policy
Decision decideTracked(const SearchInput& input, const Prediction& prediction, const Sight& sight,
                       bool must_become_keyframe, const TrackingResult& result);

/// A lost frame. After lost_frames of them a new segment starts, unless the image is blank.
Decision decideLost(const SearchInput& input, const Prediction& prediction, const Sight& sight,
                    const TrackingResult& result);

}  // namespace mivo
