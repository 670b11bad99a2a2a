// SPDX-License-Identifier: BSD-3-Clause
#include "core/odometry/prediction.h"

namespace mivo {

Prediction predict(const OdometryState& state, double stamp, const Eigen::Isometry3d* start,
                   const MotionParameters& parameters) {
  Prediction prediction;
  prediction.stamp = stamp;
  prediction.is_given = start != nullptr && isRigid(*start);
  prediction.T_odom_camera = prediction.is_given ? *start
                                                 : state.motion.predict(stamp, state.T_odom_camera,
                                                                        state.clock, parameters);
  prediction.covariance = state.motion.covariance(stamp, state.clock, parameters);
  prediction.drift = state.motion.drift(stamp, state.clock, parameters);
  prediction.periods = state.motion.periodsSince(stamp, state.clock, parameters);
  prediction.seconds = stamp - state.pose_stamp;
  return prediction;
}

Eigen::Isometry3d bestGuess(const OdometryState& state, const Prediction& prediction) {
  if (prediction.is_given) return prediction.T_odom_camera;
  return prediction.seconds <= kMotionHorizon ? prediction.T_odom_camera : state.T_odom_camera;
}

}  // namespace mivo
