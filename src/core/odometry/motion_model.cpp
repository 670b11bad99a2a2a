// SPDX-License-Identifier: BSD-3-Clause
#include "core/odometry/motion_model.h"

#include <algorithm>
#include <cmath>

#include "core/execution/recycled.h"

namespace mivo {
namespace {

constexpr std::size_t kIntervals = 31;  // one second of a usual camera

}  // namespace

void MotionModel::addStamp(double stamp) {
  if (has_stamp_ && stamp > last_stamp_) {
    const double interval = stamp - last_stamp_;
    if (intervals_.size() < kIntervals) {
      intervals_.push_back(interval);
    } else {
      intervals_[next_interval_] = interval;
      next_interval_ = (next_interval_ + 1) % kIntervals;
    }
  }
  last_stamp_ = stamp;
  has_stamp_ = true;
}

void MotionModel::add(double stamp, const Eigen::Isometry3d& T_odom_camera) {
  if (poses_.size() == 2) poses_.erase(poses_.begin());
  poses_.push_back({stamp, T_odom_camera});
}

double MotionModel::period(const Parameters& parameters) const {
  if (parameters.motion.frame_period > 0.0) return parameters.motion.frame_period;
  if (intervals_.empty()) return 0.0;
  Recycled<std::vector<double>> sorted;
  *sorted = intervals_;
  const auto middle = sorted->begin() + static_cast<std::ptrdiff_t>(sorted->size() / 2);
  std::nth_element(sorted->begin(), middle, sorted->end());
  return *middle;
}

double MotionModel::steps(double from, double to, const Parameters& parameters) const {
  const double period_s = period(parameters);
  return period_s > 0.0 ? std::max(1.0, std::round((to - from) / period_s)) : 1.0;
}

Eigen::Isometry3d MotionModel::predict(double stamp, const Eigen::Isometry3d& last,
                                       const Parameters& parameters) const {
  if (parameters.motion.motion_model == MotionModelKind::kConstantPose || poses_.size() < 2) {
    return last;
  }
  const Pose& a = poses_[0];
  const Pose& b = poses_[1];
  const Vector6 motion = logSe3(a.T_odom_camera.inverse() * b.T_odom_camera);
  const double ratio = steps(b.stamp, stamp, parameters) / steps(a.stamp, b.stamp, parameters);
  return orthonormalised(b.T_odom_camera * expSe3(ratio * motion));
}

double MotionModel::periodsSince(double stamp, const Parameters& parameters) const {
  return poses_.empty() ? 1.0 : steps(poses_.back().stamp, stamp, parameters);
}

Vector6 MotionModel::velocity(const Parameters& parameters) const {
  const double period_s = period(parameters);
  if (poses_.size() < 2 || !(period_s > 0.0)) return Vector6::Zero();
  const Pose& a = poses_[0];
  const Pose& b = poses_[1];
  return logSe3(a.T_odom_camera.inverse() * b.T_odom_camera) /
         (steps(a.stamp, b.stamp, parameters) * period_s);
}

MotionUncertainty MotionModel::uncertainty(double stamp, const Parameters& parameters) const {
  const double period_s = period(parameters);
  if (poses_.size() < 2 || !(period_s > 0.0)) return {};
  const double seconds = period_s * periodsSince(stamp, parameters);
  return {parameters.motion.expected_acceleration * seconds * seconds,
          parameters.motion.expected_turn_acceleration * seconds * seconds};
}

void MotionModel::stop() {
  poses_.clear();
}

void MotionModel::transform(const Eigen::Isometry3d& T_new_old) {
  for (Pose& pose : poses_) pose.T_odom_camera = orthonormalised(T_new_old * pose.T_odom_camera);
}

}  // namespace mivo
