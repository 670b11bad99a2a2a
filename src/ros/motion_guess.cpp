// SPDX-License-Identifier: BSD-3-Clause
#include "ros/motion_guess.h"

#include <ros/console.h>

#include "mivo/core/se3.h"
#include "ros/stamp.h"

namespace mivo {
namespace {

constexpr double kLogPeriod = 5.0;  // s between messages of the same kind

}  // namespace

void MotionGuess::look(const ros::Time& stamp,
                       const std::optional<Eigen::Isometry3d>& T_base_camera) {
  if (parameters_.guess_frame_id.empty()) return;
  before_ = now_;
  now_ = {stamp, T_base_camera,
          transforms_.guessBase(stamp, ros::WallDuration(parameters_.tf_timeout))};
  // This transform arrived too late for its own frame. Later frames of a loss need it as origin.
  if (origin_.T_base_camera && !origin_.T_guess_base) {
    origin_.T_guess_base = transforms_.guessBase(origin_.stamp, ros::WallDuration());
  }
  if (!now_.T_guess_base) {
    ROS_WARN_THROTTLE(kLogPeriod,
                      "tf has no transform from %s to %s at the stamp of the frame (waited for "
                      "%.3f s, parameter tf_timeout): tracking starts from its own prediction",
                      parameters_.guess_frame_id.c_str(), parameters_.base_frame.c_str(),
                      parameters_.tf_timeout);
  }
}

bool MotionGuess::hasJumped(const LossParameters& limits) const {
  const double seconds = now_.stamp.toSec() - before_.stamp.toSec();
  if (!before_.isKnown() || !now_.isKnown() || seconds <= 0.0) return false;
  const Vector6 motion =
      localCoordinates(before_.T_guess_camera().inverse() * now_.T_guess_camera());
  return motion.head<3>().norm() > limits.lost_speed * seconds ||
         motion.tail<3>().norm() > limits.lost_turn_rate * seconds;
}

std::optional<Eigen::Isometry3d> MotionGuess::start(const std::optional<StampedPose>& last_measured,
                                                    const LossParameters& limits) {
  if (hasJumped(limits)) {
    ROS_WARN_THROTTLE(kLogPeriod,
                      "%s moved in %s faster than lost_speed and lost_turn_rate allow (was that "
                      "odometry reset?): it is ignored until a pose has been measured again",
                      parameters_.base_frame.c_str(), parameters_.guess_frame_id.c_str());
    origin_ = Sight();
  }
  const bool is_origin = last_measured && toSeconds(origin_.stamp) == last_measured->stamp;
  if (!is_origin || !origin_.isKnown() || !now_.isKnown()) return std::nullopt;
  return last_measured->pose * origin_.T_guess_camera().inverse() * now_.T_guess_camera();
}

}  // namespace mivo
