// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/callback_queue.h>
#include <ros/spinner.h>

#include <atomic>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "ros/display_publisher.h"
#include "ros/frame_input.h"
#include "ros/frame_queue.h"
#include "ros/input_warnings.h"
#include "ros/message_frame.h"
#include "ros/node_parameters.h"
#include "ros/odometry_diagnostics.h"
#include "ros/odometry_publisher.h"
#include "ros/odometry_services.h"
#include "ros/reconfigure_server.h"
#include "ros/trajectory_recorder.h"
#include "ros/transform_source.h"
#include "session/tracking_session.h"

namespace mivo {

/// The odometry as a ROS node: three threads of its own, so that a manager is never held up. One
/// receives and pairs images, one tracks, one answers services.
class OdometryNode : private OdometryActions {
 public:
  /// Throws Error for parameters that cannot be used.
  OdometryNode(const ros::NodeHandle& node, const ros::NodeHandle& private_node,
               OdometryDiagnostics& diagnostics);

  /// Tracks what still waits (with drop_frames: false), then ends.
  ~OdometryNode();

 private:
  void work();
  void process(const ImagePair& pair);
  bool acceptStamp(const ros::Time& stamp);
  std::optional<Eigen::Isometry3d> guessedStart(const ros::Time& stamp,
                                                const Eigen::Isometry3d& T_base_camera);
  void track(const ImagePair& pair, const MessageFrame& input, double conversion_ms);
  void publish(const ImagePair& pair, TrackingStatus& status,
               const std::optional<Eigen::Isometry3d>& T_base_camera);
  void publishOdometry(const ros::Time& stamp, const Eigen::Isometry3d& T_base_camera);
  void record(const TrackingResult& result);
  void restartAfterJump(const ros::Time& stamp);
  void startTrajectory();
  void skip(const std::string& reason);
  void logState(const TrackingResult& result);
  void publishDiagnostics();

  void reset() override;
  void setPose(const Eigen::Isometry3d& T_odom_base) override;
  void setPaused(bool paused) override;
  std::string saveTrajectory(const std::string& path, bool force, std::size_t& poses) override;
  void setParameters(const Parameters& parameters);

  NodeParameters parameters_;
  OdometryDiagnostics& diagnostics_;
  bool rectified_ = false;

  ros::CallbackQueue input_queue_;
  ros::CallbackQueue service_queue_;
  FrameQueue<ImagePair> frames_;
  std::atomic<std::uint64_t> skipped_{0};
  std::atomic<bool> paused_{false};
  InputWarnings warnings_;  // the worker's own

  std::mutex mutex_;  // guards the tracker and what belongs to it, from here to the empty line
  TrackingSession session_;
  TrajectoryRecorder trajectory_;
  OdometryPublisher publisher_;
  DisplayPublisher display_;
  std::optional<Eigen::Isometry3d> T_odom_world_;  // known once tf has said where the camera sits
  Eigen::Isometry3d T_base_camera_ = Eigen::Isometry3d::Identity();  // of the last frame
  ros::Time last_stamp_;
  std::uint64_t num_frames_ = 0;
  int stale_frames_ = 0;  // in a row
  TrackingState last_state_ = TrackingState::kInitialising;

  TransformSource transforms_;
  std::unique_ptr<FrameInput> input_;
  std::unique_ptr<OdometryServices> services_;
  std::unique_ptr<ReconfigureServer> reconfigure_;
  ros::WallTimer diagnostics_timer_;
  std::unique_ptr<ros::AsyncSpinner> input_spinner_;
  std::unique_ptr<ros::AsyncSpinner> service_spinner_;
  std::thread worker_;
};

}  // namespace mivo
