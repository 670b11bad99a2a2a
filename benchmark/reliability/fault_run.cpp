// SPDX-License-Identifier: BSD-3-Clause
#include "fault_run.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/execution/cpu_clock.h"
#include "mivo/core/error.h"
#include "mivo/core/se3.h"
#include "session/frame_order.h"
#include "session/repeated_image.h"
#include "session/tracking_session.h"

namespace mivo {
namespace {

/// How far estimated motion is from the true one, since the start of a segment.
class SegmentErrors {
 public:
  explicit SegmentErrors(const std::vector<Eigen::Isometry3d>& truth) : truth_(truth) {}

  /// Error of a measured pose in the axes of the camera.
  Vector6 of(const TrackingResult& result, std::size_t index) {
    if (result.segment != segment_) {
      segment_ = result.segment;
      T_odom_first_ = result.T_odom_camera;
      first_ = index;
    }
    const Eigen::Isometry3d estimated = T_odom_first_.inverse() * result.T_odom_camera;
    const Eigen::Isometry3d actual = truth_[first_].inverse() * truth_[index];
    return localCoordinates(estimated.inverse() * actual);
  }

 private:
  const std::vector<Eigen::Isometry3d>& truth_;
  int segment_ = -1;
  std::size_t first_ = 0;
  Eigen::Isometry3d T_odom_first_;
};

/// Receives deliveries, as OdometryNode does with messages.
class Receiver {
 public:
  Receiver(const TrueRecording& recording, const Parameters& parameters)
      : errors_(recording.T_world_camera),
        session_(parameters),
        order_([this](Delivery& delivery, bool is_new_time) { process(delivery, is_new_time); },
               [](Delivery&, StampFault) {}) {}

  void take(const Delivery& delivery) {
    is_right_ = false;
    const double begin = threadMilliseconds();
    order_.push(delivery.frame.stamp, delivery);
    outcome_.longest = std::max(outcome_.longest, 1e-3 * (threadMilliseconds() - begin));
  }

  /// Whether the last delivery was tracked, and right.
  bool isRight() const { return is_right_; }
  FaultOutcome& outcome() { return outcome_; }

 private:
  void process(const Delivery& delivery, bool is_new_time) {
    if (is_new_time) session_.restart();
    try {
      session_.setCamera(delivery.camera);
    } catch (const Error&) {
      return;  // skipped and counted, in the node
    }
    if (!findFault(delivery.frame, delivery.camera).empty()) return;
    if (repeated_.check(delivery.frame)) return;
    judge(session_.process(delivery.frame, nullptr), delivery.index);
  }

  void judge(const TrackingResult& result, std::size_t index) {
    if (!result.isMeasured()) return;
    const Vector6 error = errors_.of(result, index);
    if (result.state != TrackingState::kTracking) return;
    const bool is_wrong =
        error.head<3>().norm() > kWrongDistance || error.tail<3>().norm() > kWrongAngle;
    const Vector6 deviations = result.covariance.diagonal().cwiseSqrt();
    const bool is_overconfident =
        (error.cwiseAbs().array() > kWrongDeviations * deviations.array()).any();
    if (is_wrong) ++outcome_.wrong;
    if (is_overconfident) ++outcome_.overconfident;
    is_right_ = !is_wrong;
  }

  SegmentErrors errors_;
  TrackingSession session_;
  RepeatedImage repeated_;
  FrameOrder<Delivery> order_;
  FaultOutcome outcome_;
  bool is_right_ = false;
};

}  // namespace

FaultOutcome track(const TrueRecording& recording, const FaultRun& run,
                   const Parameters& parameters) {
  FrameFaults faults(run.fault, run.rate, run.seed);
  Receiver receiver(recording, parameters);
  const std::size_t third = recording.deliveries.size() / 3;
  for (std::size_t i = 0; i < 2 * third; ++i) {
    const Delivery& delivery = recording.deliveries[i];
    if (i < third) {
      receiver.take(delivery);
      continue;
    }
    for (const Delivery& faulty : faults.pass(delivery)) receiver.take(faulty);
  }
  for (const Delivery& late : faults.end()) receiver.take(late);
  bool has_recovered = false;
  for (std::size_t i = 2 * third; i < recording.deliveries.size(); ++i) {
    receiver.take(recording.deliveries[i]);
    has_recovered = has_recovered || receiver.isRight();
    if (!has_recovered) ++receiver.outcome().recovery;
  }
  return receiver.outcome();
}

}  // namespace mivo
