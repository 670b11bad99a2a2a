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

#include "ros/frame_input.h"
#include "ros/frame_queue.h"
#include "ros/input_warnings.h"
#include "ros/message_frame.h"
#include "ros/motion_guess.h"
#include "ros/node_parameters.h"
#include "ros/odometry_diagnostics.h"
#include "ros/odometry_output.h"
#include "ros/odometry_services.h"
#include "ros/reconfigure_server.h"
#include "ros/skipped_frames.h"
#include "ros/state_log.h"
#include "ros/status_conversion.h"
#include "ros/trajectory_recorder.h"
#include "ros/transform_source.h"
#include "session/frame_order.h"
#include "session/repeated_image.h"
#include "session/tracking_session.h"

namespace mivo {

/// The odometry as a ROS node. Three threads of its own never block a nodelet manager: one receives
/// and pairs images, one tracks, one answers services.
class OdometryNode : private OdometryActions {
 public:
  /// Throws Error for invalid parameters.
  OdometryNode(const ros::NodeHandle& node, const ros::NodeHandle& private_node,
               OdometryDiagnostics& diagnostics);

  /// Tracks waiting frames (with drop_frames: false) before it returns.
  ~OdometryNode();

 private:
  void enqueue(const ImagePair& pair);
  void work();
  void process(ImagePair pair, bool is_new_time);
  void refuse(const ImagePair& pair, StampFault fault);
  void locateDepth(ImagePair& pair);
  void track(const ImagePair& pair, const MessageFrame& input, double conversion_ms);
  const TrackingResult& follow(const MessageFrame& input);
  void publishStatus(const TrackingResult& result, FrameAccount& account);
  void publish(const ImagePair& pair, const std::optional<Eigen::Isometry3d>& T_base_camera,
               FrameAccount& account);
  void record(const TrackingResult& result);
  void restartAfterJump();
  void startTrajectory();
  void publishDiagnostics();

  void reset() override;
  void setPose(const Eigen::Isometry3d& T_odom_base) override;
  void setPaused(bool paused) override;
  std::string saveTrajectory(const std::string& path, bool force, std::size_t& poses) override;
  void setParameters(const Parameters& parameters);

  NodeParameters parameters_;
  OdometryDiagnostics& diagnostics_;

  ros::CallbackQueue input_queue_;
  ros::CallbackQueue service_queue_;
  FrameQueue<ImagePair> frames_;
  SkippedFrames skipped_;
  std::atomic<bool> paused_{false};
  InputWarnings warnings_;       // used by the worker only, as the next three
  FrameOrder<ImagePair> order_;  // whose stamps are believed
  std::optional<FrameMaker> frame_maker_;
  RepeatedImage repeated_;
  std::atomic<bool> has_reset_{false};  // told to the worker

  std::mutex mutex_;  // guards the members up to the empty line
  TrackingSession session_;
  TrajectoryRecorder trajectory_;
  OdometryOutput output_;
  StateLog state_log_;
  std::uint64_t num_frames_ = 0;

  TransformSource transforms_;
  MotionGuess guess_;  // used by the worker only
  std::unique_ptr<FrameInput> input_;
  std::unique_ptr<OdometryServices> services_;
  std::unique_ptr<ReconfigureServer> reconfigure_;
  ros::WallTimer diagnostics_timer_;
  std::unique_ptr<ros::AsyncSpinner> input_spinner_;
  std::unique_ptr<ros::AsyncSpinner> service_spinner_;
  std::thread worker_;
};

}  // namespace mivo
