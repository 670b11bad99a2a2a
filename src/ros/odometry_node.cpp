// SPDX-License-Identifier: BSD-3-Clause
#include "ros/odometry_node.h"

#include <ros/console.h>

#include "core/execution/cpu_clock.h"
#include "mivo/core/error.h"
#include "ros/camera_conversion.h"
#include "ros/depth_geometry.h"
#include "ros/guarded_call.h"
#include "ros/parameter_server.h"
#include "ros/stamp.h"

namespace mivo {
namespace {

constexpr double kLogPeriod = 5.0;          // s between messages of the same kind
constexpr std::size_t kLongBacklog = 300;   // frames
constexpr double kDiagnosticsPeriod = 1.0;  // s
constexpr double kMaxDrain = 10.0;  // s; roslaunch ends a node by force 15 s after asking it to

ros::NodeHandle withQueue(ros::NodeHandle node, ros::CallbackQueue& queue) {
  node.setCallbackQueue(&queue);
  return node;
}

}  // namespace

OdometryNode::OdometryNode(const ros::NodeHandle& node, const ros::NodeHandle& private_node,
                           OdometryDiagnostics& diagnostics)
    : parameters_(readNodeParameters(private_node)),
      diagnostics_(diagnostics),
      frames_(parameters_.drop_frames ? FrameQueue<ImagePair>::Policy::kNewest
                                      : FrameQueue<ImagePair>::Policy::kAll),
      warnings_(parameters_),
      order_([this](ImagePair& pair, bool is_new_time) { process(pair, is_new_time); },
             [this](ImagePair& pair, StampFault fault) { refuse(pair, fault); }),
      session_(readParameters(private_node)),
      trajectory_(parameters_),
      output_(private_node, parameters_),
      transforms_(node, parameters_.base_frame, parameters_.guess_frame_id),
      guess_(transforms_, parameters_) {
  ros::NodeHandle service_node = withQueue(private_node, service_queue_);
  input_ = std::make_unique<FrameInput>(withQueue(private_node, input_queue_), parameters_,
                                        [this](const ImagePair& pair) { enqueue(pair); });
  frame_maker_.emplace(isRectifiedTopic(input_->colorTopic()));
  services_ =
      std::make_unique<OdometryServices>(service_node, static_cast<OdometryActions&>(*this));
  reconfigure_ = std::make_unique<ReconfigureServer>(
      service_node, session_.parameters(),
      [this](const Parameters& parameters) { setParameters(parameters); });
  diagnostics_timer_ = service_node.createWallTimer(
      ros::WallDuration(kDiagnosticsPeriod), [this](const ros::WallTimerEvent&) {
        guardedCall("diagnostics", [this] { publishDiagnostics(); });
      });
  for (const std::string& fault : findUnknownParameters(private_node, nodeParameterNames())) {
    ROS_WARN_STREAM(fault);
  }
  worker_ = std::thread([this] { work(); });
  input_spinner_ = std::make_unique<ros::AsyncSpinner>(1, &input_queue_);
  service_spinner_ = std::make_unique<ros::AsyncSpinner>(1, &service_queue_);
  input_spinner_->start();
  service_spinner_->start();
}

OdometryNode::~OdometryNode() {
  input_spinner_->stop();
  service_spinner_->stop();
  diagnostics_timer_.stop();
  input_queue_.callAvailable();  // what has arrived, and the spinner has not come to
  input_->stop();
  frames_.close();
  worker_.join();
  for (const auto& [reason, number] : skipped_.counts().by_reason) {
    ROS_WARN_STREAM(number << " frames were skipped: " << reason);
  }
}

void OdometryNode::enqueue(const ImagePair& pair) {
  frames_.push(pair, pair.bytes());
  if (parameters_.drop_frames || frames_.dropped() == 0) return;
  ROS_WARN_THROTTLE(
      kLogPeriod,
      "%zu frames are waiting, and more are not kept: the oldest are dropped, %lu so far; play the "
      "bag more slowly (rate)",
      frames_.size(), static_cast<unsigned long>(frames_.dropped()));
}

void OdometryNode::work() {
  std::optional<ros::WallTime> closed;
  while (const std::optional<ImagePair> pair = frames_.pop()) {
    if (!ros::ok()) {
      if (!closed) closed = ros::WallTime::now();
      if ((ros::WallTime::now() - *closed).toSec() > kMaxDrain) {
        ROS_ERROR_STREAM("stopped with " << frames_.clear() + 1
                                         << " frames not tracked: play the bag more slowly (rate)");
        return;
      }
    }
    if (frames_.size() > kLongBacklog) {
      ROS_WARN_THROTTLE(kLogPeriod,
                        "%zu frames are waiting: tracking is slower than playback; play the bag "
                        "more slowly (rate)",
                        frames_.size());
    }
    guardedCall("tracking", [&] {
      if (has_reset_.exchange(false)) order_.restart();
      if (!paused_) order_.push(toSeconds(pair->color->header.stamp), *pair);
    });
  }
  guardedCall("tracking", [this] { order_.flush(); });
}

/// Depth of a camera beside the color camera is registered, as soon as it is known where that is.
void OdometryNode::locateDepth(ImagePair& pair) {
  const std::string& color = pair.color->header.frame_id;
  const std::string& depth = pair.depth->header.frame_id;
  const std::string& registered = parameters_.depth_registered;
  const bool is_beside = registered == "no" || (registered == "auto" &&
                                                isUnregistered(color, depth, input_->depthTopic()));
  if (!pair.depth_info || !is_beside) return;
  const std::optional<Eigen::Isometry3d> T_color_depth = transforms_.between(color, depth);
  if (!T_color_depth) {
    throw Error(
        describeMissingGeometry(color, depth, cameraInfoBeside(input_->depthTopic()), true));
  }
  pair.depth_geometry = DepthGeometry{pair.depth_info, *T_color_depth};
}

void OdometryNode::process(ImagePair pair, bool is_new_time) {
  if (is_new_time) restartAfterJump();
  try {
    if (!pair.fault.empty()) throw Error(pair.fault);
    const double begin = threadMilliseconds();
    locateDepth(pair);
    const MessageFrame input = frame_maker_->make(pair);
    if (repeated_.check(input.frame)) throw Error(RepeatedImage::kReason);
    track(pair, input, threadMilliseconds() - begin);
  } catch (const std::exception& error) {  // no exception may end the nodelet manager
    skipped_.add(error.what(), ros::WallTime::now());
  }
}

/// A frame of no time gets the status of the frame before, and is counted.
void OdometryNode::refuse(const ImagePair& pair, StampFault fault) {
  skipped_.add(describe(fault), ros::WallTime::now());
  FrameAccount account;
  account.header = pair.color->header;
  account.pairing_offset = pair.depth->header.stamp.toSec() - pair.color->header.stamp.toSec();
  const std::lock_guard<std::mutex> lock(mutex_);
  TrackingResult result = session_.result();
  result.reason = TrackingReason::kStaleStamp;
  publishStatus(result, account);
}

void OdometryNode::restartAfterJump() {
  ROS_WARN("time was set back (a looped bag?): tracking restarts at the last pose");
  const std::lock_guard<std::mutex> lock(mutex_);
  session_.restart();
  startTrajectory();
}

void OdometryNode::startTrajectory() {
  try {
    trajectory_.startAnew();
  } catch (const Error& error) {  // the poses stay in memory, as in record()
    ROS_ERROR("%s", error.what());
  }
}

void OdometryNode::track(const ImagePair& pair, const MessageFrame& input, double conversion_ms) {
  const std_msgs::Header& header = pair.color->header;
  const std::optional<Eigen::Isometry3d> T_base_camera =
      transforms_.baseCamera(header.frame_id, header.stamp);
  guess_.look(header.stamp,
              T_base_camera);  // waits for tf, without the mutex: services must not wait
  warnings_.lookAtFrames(pair, transforms_);
  warnings_.lookAtCamera(input.camera);

  const std::lock_guard<std::mutex> lock(mutex_);
  const TrackingResult& result = follow(input);
  FrameAccount account;
  account.header = header;
  account.conversion_cpu_ms = conversion_ms;
  account.pairing_offset = pair.depth->header.stamp.toSec() - header.stamp.toSec();
  if (result.isRefused()) {
    skipped_.add(describeReason(result), ros::WallTime::now());
  } else {
    ++num_frames_;
    record(result);
    state_log_.add(result, ros::WallTime::now());
    publish(pair, T_base_camera, account);
  }
  publishStatus(result, account);
  if (result.isRefused()) return;
  warnings_.lookAtDepth(input.frame, session_.parameters().depth);
  diagnostics_.addFrame(toMessage(result, account), sampleDepth(input.frame));
}

void OdometryNode::publishStatus(const TrackingResult& result, FrameAccount& account) {
  account.frames = num_frames_;
  account.skipped_frames = skipped_.counts().total;
  account.dropped_frames = frames_.dropped();
  // In doubles: a difference of times that do not belong together may not fit into a Duration.
  account.latency = ros::Time::now().toSec() - account.header.stamp.toSec();
  output_.publishStatus(toMessage(result, account));
}

const TrackingResult& OdometryNode::follow(const MessageFrame& input) {
  if (session_.setCamera(input.camera)) {
    ROS_WARN("the camera's calibration has changed: tracking restarts at the last pose");
  }
  const std::optional<Eigen::Isometry3d> start =
      guess_.start(session_.lastMeasured(), session_.parameters().loss);
  const TrackingResult& result = session_.process(input.frame, start ? &*start : nullptr);
  if (result.isMeasured()) guess_.keep();
  return result;
}

/// Poses that were measured; guesses only when asked for.
void OdometryNode::record(const TrackingResult& result) {
  const bool is_wanted = result.state == TrackingState::kLost && parameters_.write_lost;
  if (!result.isMeasured() && !is_wanted) return;
  try {
    trajectory_.add({result.stamp, result.T_odom_camera});
  } catch (const Error& error) {
    ROS_ERROR_THROTTLE(kLogPeriod, "%s", error.what());
  }
}

void OdometryNode::publish(const ImagePair& pair,
                           const std::optional<Eigen::Isometry3d>& T_base_camera,
                           FrameAccount& account) {
  if (T_base_camera) {
    output_.publishOdometry(session_, account.header.stamp, *T_base_camera, guess_.T_guess_base());
  }
  account.processing_latency = (ros::WallTime::now() - pair.arrival()).toSec();
  if (T_base_camera) output_.publishDisplay(session_, pair.color);
}

void OdometryNode::publishDiagnostics() {
  diagnostics_.publish(input_->counts(), skipped_.counts(), frames_.dropped());
}

void OdometryNode::reset() {
  const std::lock_guard<std::mutex> lock(mutex_);
  session_.reset();
  has_reset_ = true;
  num_frames_ = 0;
  startTrajectory();
  output_.reset();
  ROS_INFO("reset");
}

void OdometryNode::setPose(const Eigen::Isometry3d& T_odom_base) {
  const std::lock_guard<std::mutex> lock(mutex_);
  output_.setPose(T_odom_base, session_);
}

void OdometryNode::setPaused(bool paused) {
  paused_ = paused;
  diagnostics_.setPaused(paused);
}

/// Written without the mutex: tracking does not wait for the disk.
std::string OdometryNode::saveTrajectory(const std::string& path, bool force, std::size_t& poses) {
  const Overwrite overwrite = force ? Overwrite::kYes : Overwrite::kNo;
  std::string full_path;
  Trajectory trajectory;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    full_path = trajectory_.pathToSave(path, overwrite);
    trajectory = trajectory_.poses();
  }
  writeTrajectory(full_path, trajectory, overwrite, TrajectoryRecorder::kForceField);
  poses = trajectory.size();
  return full_path;
}

void OdometryNode::setParameters(const Parameters& parameters) {
  const std::lock_guard<std::mutex> lock(mutex_);
  session_.setParameters(parameters);
}

}  // namespace mivo
