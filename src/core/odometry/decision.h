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

/// What is known after a frame, and what is said of it.
struct Outcome {
  OdometryState state;
  TrackingResult result;
};

/// The keyframe that a frame is to become.
struct KeyframePlan {
  Eigen::Isometry3d T_odom_camera = Eigen::Isometry3d::Identity();
  Vector6 twist_per_period = Vector6::Zero();  ///< of the scene in the camera's axes
  Matrix6 covariance = Matrix6::Identity();    ///< of the pose
  double last_lit_contrast = 0.0;              ///< see PosedKeyframe
  int segment = 0;
};

/// What is to be made of a frame.
struct Decision {
  Outcome outcome;                   ///< if it becomes no keyframe
  std::size_t keyframe = 0;          ///< of the store, to be the current one from now on
  std::optional<KeyframePlan> plan;  ///< the keyframe that it is to become
  Outcome with_keyframe;             ///< if it does
};

/// The first frame, or the first since all keyframes are gone.
Decision decideFirst(const OdometryState& state, const Prediction& prediction,
                     const TrackingResult& result, const MotionParameters& parameters);

/// A frame whose sight is believed: it is tracked, and may become the next keyframe.
/// @param must_become_keyframe also where it would not have to
Decision decideTracked(const SearchInput& input, const Prediction& prediction, const Sight& sight,
                       bool must_become_keyframe, const TrackingResult& result);

/// A frame that is lost. After some of them a new segment begins, where there is a view.
Decision decideLost(const SearchInput& input, const Prediction& prediction, const Sight& sight,
                    const TrackingResult& result);

}  // namespace mivo
