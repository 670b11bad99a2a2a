// SPDX-License-Identifier: BSD-3-Clause
#include "ros/odometry_node.h"

#include <ros/console.h>

#include "core/execution/cpu_clock.h"
#include "mivo/core/error.h"
#include "ros/camera_conversion.h"
#include "ros/parameter_server.h"
#include "ros/status_conversion.h"

namespace mivo {
namespace {

constexpr double kTimeJump = 1.0;           // s: time was set back, the frame is not merely late
constexpr int kStaleFramesOfAJump = 10;     // as many late frames in a row are a jump too
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
      session_(readParameters(private_node)),
      trajectory_(parameters_),
      publisher_(private_node, parameters_),
      display_(private_node, parameters_),
      transforms_(node, parameters_.base_frame, parameters_.guess_frame_id) {
  ros::NodeHandle service_node = withQueue(private_node, service_queue_);
  input_ = std::make_unique<FrameInput>(withQueue(private_node, input_queue_), parameters_,
                                        [this](const ImagePair& pair) { frames_.push(pair); });
  rectified_ = isRectifiedTopic(input_->colourTopic());
  services_ =
      std::make_unique<OdometryServices>(service_node, static_cast<OdometryActions&>(*this));
  reconfigure_ = std::make_unique<ReconfigureServer>(
      service_node, session_.parameters(),
      [this](const Parameters& parameters) { setParameters(parameters); });
  diagnostics_timer_ =
      service_node.createWallTimer(ros::WallDuration(kDiagnosticsPeriod),
                                   [this](const ros::WallTimerEvent&) { publishDiagnostics(); });
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
  input_->stop();
  frames_.close();
  worker_.join();
  if (skipped_ > 0) ROS_WARN_STREAM(skipped_ << " frames were skipped");
}

void OdometryNode::work() {
  std::optional<ros::WallTime> closed;
  while (const std::optional<ImagePair> pair = frames_.pop()) {
    if (!ros::ok()) {
      if (!closed) closed = ros::WallTime::now();
      if ((ros::WallTime::now() - *closed).toSec() > kMaxDrain) {
        ROS_ERROR_STREAM("ended before " << frames_.clear() + 1
                                         << " waiting frames were tracked: play slower (rate)");
        return;
      }
    }
    if (frames_.size() > kLongBacklog) {
      ROS_WARN_THROTTLE(kLogPeriod, "%zu frames wait: tracking is slower than the bag; play slower",
                        frames_.size());
    }
    if (!paused_) process(*pair);
  }
}

void OdometryNode::process(const ImagePair& pair) {
  try {
    const double begin = threadMilliseconds();
    const MessageFrame input = toFrame(pair, rectified_);
    track(pair, input, threadMilliseconds() - begin);
  } catch (const std::exception& error) {  // whatever it is: the manager's other nodelets go on
    skip(error.what());
  }
}

void OdometryNode::skip(const std::string& reason) {
  ++skipped_;
  diagnostics_.addSkipped(reason);
  ROS_WARN_THROTTLE(kLogPeriod, "frame skipped: %s", reason.c_str());
}

bool OdometryNode::acceptStamp(const ros::Time& stamp) {
  if (num_frames_ == 0 || stamp > last_stamp_) {
    stale_frames_ = 0;
    return true;
  }
  ++stale_frames_;
  if ((last_stamp_ - stamp).toSec() <= kTimeJump && stale_frames_ < kStaleFramesOfAJump) {
    return false;
  }
  stale_frames_ = 0;
  restartAfterJump(stamp);
  return true;
}

void OdometryNode::restartAfterJump(const ros::Time& stamp) {
  ROS_WARN("time was set back by %.3f s (a looped bag?): tracking starts anew at the last pose",
           (last_stamp_ - stamp).toSec());
  session_.restart();
  startTrajectory();
}

void OdometryNode::startTrajectory() {
  try {
    trajectory_.startAnew();
  } catch (const Error& error) {  // poses are kept all the same, as in record()
    ROS_ERROR("%s", error.what());
  }
}

void OdometryNode::track(const ImagePair& pair, const MessageFrame& input, double conversion_ms) {
  const ros::Time stamp = pair.colour->header.stamp;
  const std::optional<Eigen::Isometry3d> T_base_camera =
      transforms_.baseCamera(pair.colour->header.frame_id, stamp);
  warnings_.lookAtFrames(pair, transforms_);

  const std::lock_guard<std::mutex> lock(mutex_);
  if (!acceptStamp(stamp)) {
    skip("its stamp is not newer than that of the frame before");
    return;
  }
  if (session_.setCamera(input.camera)) {
    ROS_WARN("the camera's calibration has changed: tracking starts anew at the last pose");
  }
  std::optional<Eigen::Isometry3d> start;
  if (T_base_camera && num_frames_ > 0) start = guessedStart(stamp, *T_base_camera);
  const TrackingResult& result = session_.process(input.frame, start ? &*start : nullptr);
  last_stamp_ = stamp;
  ++num_frames_;
  record(result);
  logState(result);

  TrackingStatus status = toMessage(result);
  status.frames = num_frames_;
  status.conversion_cpu_ms = conversion_ms;
  publish(pair, status, T_base_camera);
  const DepthSample depth = sampleDepth(input.frame);
  warnings_.lookAtDepth(depth);
  diagnostics_.addFrame(status, depth);
}

std::optional<Eigen::Isometry3d> OdometryNode::guessedStart(
    const ros::Time& stamp, const Eigen::Isometry3d& T_base_camera) {
  if (parameters_.guess_frame_id.empty() || stamp <= last_stamp_) return std::nullopt;
  const std::optional<Eigen::Isometry3d> motion =
      transforms_.baseMotion(last_stamp_, stamp, ros::WallDuration(parameters_.tf_timeout));
  if (!motion) {
    ROS_WARN_THROTTLE(kLogPeriod,
                      "tf does not know how %s moved in %s between the last two frames: tracking "
                      "starts from its own prediction",
                      parameters_.base_frame.c_str(), parameters_.guess_frame_id.c_str());
    return std::nullopt;
  }
  return session_.result().T_odom_camera * T_base_camera.inverse() * *motion * T_base_camera;
}

void OdometryNode::record(const TrackingResult& result) {
  try {
    trajectory_.add({result.stamp, result.T_odom_camera});
  } catch (const Error& error) {
    ROS_ERROR_THROTTLE(kLogPeriod, "%s", error.what());
  }
}

void OdometryNode::publish(const ImagePair& pair, TrackingStatus& status,
                           const std::optional<Eigen::Isometry3d>& T_base_camera) {
  const std_msgs::Header& header = pair.colour->header;
  if (T_base_camera) {
    T_base_camera_ = *T_base_camera;
    // The odometry frame is the first pose of the base.
    if (!T_odom_world_) T_odom_world_ = T_base_camera_;
    publishOdometry(header.stamp, T_base_camera_);
  }
  status.processing_latency = (ros::WallTime::now() - pair.arrival()).toSec();
  if (T_base_camera) {
    display_.publish(session_.odometry(), session_.result().keyframes, *T_odom_world_, header);
  }
  status.header = header;
  status.skipped_frames = skipped_;
  status.dropped_frames = frames_.dropped();
  status.pairing_offset = (pair.depth->header.stamp - header.stamp).toSec();
  status.latency = (ros::Time::now() - header.stamp).toSec();
  publisher_.publish(status);
}

void OdometryNode::publishOdometry(const ros::Time& stamp, const Eigen::Isometry3d& T_base_camera) {
  const TrackingResult& result = session_.result();
  const bool measured =
      result.state == TrackingState::kTracking || result.state == TrackingState::kDegraded;
  if (!measured && !parameters_.publish_when_lost) return;
  BaseOdometry odometry = toBase(result, session_.twistCovariance(), *T_odom_world_, T_base_camera);
  if (!measured) {
    odometry.pose_covariance = odometry.twist_covariance = Matrix6::Identity() * kUnknownVariance;
  }
  if (parameters_.two_d_mode) odometry = inPlane(odometry);
  std::optional<Eigen::Isometry3d> T_guess_base;
  if (!parameters_.guess_frame_id.empty()) T_guess_base = transforms_.guessBase(stamp);
  publisher_.publish(odometry, stamp, T_guess_base);
}

void OdometryNode::logState(const TrackingResult& result) {
  if (result.state == last_state_) return;
  last_state_ = result.state;
  if (result.state == TrackingState::kTracking) {
    ROS_INFO("tracking, keyframe %d", result.keyframes);
  } else {
    ROS_WARN("%s: %s", toString(result.state), toString(result.reason));
  }
}

void OdometryNode::publishDiagnostics() {
  diagnostics_.publish(input_->counts(), skipped_, frames_.dropped());
}

void OdometryNode::reset() {
  const std::lock_guard<std::mutex> lock(mutex_);
  session_.reset();
  T_odom_world_.reset();
  num_frames_ = 0;
  startTrajectory();
  publisher_.clearPath();
  display_.clear();
  ROS_INFO("reset");
}

void OdometryNode::setPose(const Eigen::Isometry3d& T_odom_base) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!T_odom_world_) {
    throw Error(
        "no pose has been published yet: there is no frame, or tf does not know the camera");
  }
  const Eigen::Isometry3d T_odom_world =
      T_odom_base * T_base_camera_ * session_.result().T_odom_camera.inverse();
  const Eigen::Isometry3d T_new_old = T_odom_world * T_odom_world_->inverse();
  T_odom_world_ = T_odom_world;
  publisher_.movePath(T_new_old);
  display_.move(T_new_old);
}

void OdometryNode::setPaused(bool paused) {
  paused_ = paused;
  diagnostics_.setPaused(paused);
}

std::string OdometryNode::saveTrajectory(const std::string& path, bool force, std::size_t& poses) {
  const std::lock_guard<std::mutex> lock(mutex_);
  poses = trajectory_.size();
  return trajectory_.save(path, force ? Overwrite::kYes : Overwrite::kNo);
}

void OdometryNode::setParameters(const Parameters& parameters) {
  const std::lock_guard<std::mutex> lock(mutex_);
  session_.setParameters(parameters);
}

}  // namespace mivo
