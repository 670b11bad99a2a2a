// SPDX-License-Identifier: BSD-3-Clause
#include "ros/node_fixture.h"

#include <cv_bridge/cv_bridge.h>
#include <nodelet/NodeletLoad.h>
#include <nodelet/NodeletUnload.h>
#include <rosgraph_msgs/Clock.h>
#include <std_srvs/Trigger.h>

#include <algorithm>
#include <chrono>

#include "mivo/core/se3.h"
#include "ros/camera_conversion.h"
#include "ros/pose_conversion.h"
#include "ros/stamp.h"

namespace mivo {
namespace {

constexpr std::chrono::milliseconds kRetry(20);  // for conditions that no message announces

// Each test's clock starts this much later than the previous one's, so that time never goes back.
constexpr double kTestPeriod = 1000.0;  // s
constexpr int kWarmUpFrames = 200;
constexpr std::chrono::milliseconds kWarmUpPeriod(20);

int nextNumber() {
  static int number = 0;
  return ++number;
}

}  // namespace

NodeTest::NodeTest()
    : number_(nextNumber()),
      ns_("/test_" + std::to_string(number_)),
      node_(ns_),
      calibration_(toCameraInfo(planeCamera().camera)),
      tf_listener_(tf_, node_, true),
      spinner_(2) {
  color_ = node_.advertise<sensor_msgs::Image>("rgb/image", 100);
  depth_ = node_.advertise<sensor_msgs::Image>("depth/image", 100);
  camera_info_ = node_.advertise<sensor_msgs::CameraInfo>("rgb/camera_info", 100);
  clock_ = node_.advertise<rosgraph_msgs::Clock>("/clock", 100);
  const boost::function<void(const nav_msgs::OdometryConstPtr&)> on_odometry =
      [this](const nav_msgs::OdometryConstPtr& message) {
        notify([&] { odometries_[message->header.stamp] = *message; });
      };
  const boost::function<void(const TrackingStatusConstPtr&)> on_status =
      [this](const TrackingStatusConstPtr& message) {
        notify([&] { statuses_[message->header.stamp] = *message; });
      };
  subscribers_.push_back(node_.subscribe<nav_msgs::Odometry>("odom", 100, on_odometry));
  subscribers_.push_back(node_.subscribe<TrackingStatus>("status", 100, on_status));
  subscribers_.push_back(collect("path", paths_));
  subscribers_.push_back(collect("/diagnostics", diagnostics_));
  setParameter("base_frame", frame("base_link"));
  setParameter("odom_frame", frame("odom"));
  setParameter("drop_frames", false);
  spinner_.start();
}

NodeTest::~NodeTest() {
  if (loaded_) {
    EXPECT_TRUE(unload());
  }
  spinner_.stop();
  subscribers_.clear();
  ros::param::del(ns_);
}

void NodeTest::loadOnly() {
  nodelet::NodeletLoad call;
  call.request.name = ns_ + "/odometry";
  call.request.type = "mivo/OdometryNodelet";
  ASSERT_TRUE(ros::service::waitForService("/manager/load_nodelet", 10000));
  ASSERT_TRUE(ros::service::call("/manager/load_nodelet", call));
  ASSERT_TRUE(call.response.success);
  loaded_ = true;
}

void NodeTest::load() {
  loadOnly();
  connect();
}

void NodeTest::connect() {
  ASSERT_TRUE(waitFor([this] {
    return color_.getNumSubscribers() > 0 && depth_.getNumSubscribers() > 0 &&
           camera_info_.getNumSubscribers() > 0;
  }));
  // A subscriber cannot know when a publisher is connected: frames are sent until they arrive.
  const auto connected = [this] {
    return !statuses_.empty() && (!odometries_.empty() || !camera_is_known_);
  };
  for (int at = -kWarmUpFrames; at < 0 && !waitFor(connected, kWarmUpPeriod); ++at) {
    publish(0, at);
  }
  ASSERT_TRUE(holds(connected));
  std_srvs::Trigger reset;
  ASSERT_TRUE(ros::service::call(privateName("reset"), reset));
  forget();
}

void NodeTest::forget() {
  const std::lock_guard<std::mutex> lock(mutex_);
  statuses_.clear();
  odometries_.clear();
  paths_.clear();
}

bool NodeTest::unload() {
  nodelet::NodeletUnload call;
  call.request.name = ns_ + "/odometry";
  loaded_ = false;
  return ros::service::call("/manager/unload_nodelet", call) && call.response.success;
}

Eigen::Isometry3d NodeTest::cameraOnBase() {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  T.linear() = expSo3({0.0, 0.2, 0.1}) * T.linear();
  T.translation() << 0.3, 0.05, 0.4;
  return T;
}

void NodeTest::publishCameraOnBase() {
  geometry_msgs::TransformStamped transform;
  transform.header.frame_id = frame("base_link");
  transform.child_frame_id = frame("optical");
  transform.transform = toTransform(cameraOnBase());
  static_.sendTransform(transform);
  camera_is_known_ = true;
}

Eigen::Isometry3d NodeTest::truth(int i) {
  return cameraOnBase() * planePose(i) * cameraOnBase().inverse();
}

ros::Time NodeTest::stampOf(int i) const {
  return toTime(planeStamp(i) + kTestPeriod * number_);
}

void NodeTest::blacken() {
  std::fill(next_color_.data.begin(), next_color_.data.end(), 0);
  std::fill(next_depth_.data.begin(), next_depth_.data.end(), 0);
}

void NodeTest::publishClock(int i) {
  rosgraph_msgs::Clock clock;
  clock.clock = stampOf(i);
  clock_.publish(clock);
}

void NodeTest::publish(int i, int at, double depth_delay) {
  cv::Mat image;
  cv::Mat depth;
  renderPlane(filmed_from_(i), image, depth);
  std_msgs::Header header;
  header.stamp = stampOf(at);
  header.frame_id = frame("optical");
  next_color_ = *cv_bridge::CvImage(header, "mono8", image).toImageMsg();
  next_depth_ = *cv_bridge::CvImage(header, "32FC1", depth).toImageMsg();
  next_depth_.header.stamp += ros::Duration(depth_delay);
  calibration_.header = header;
  spoil_();
  publishClock(at);
  camera_info_.publish(calibration_);
  color_.publish(next_color_);
  if (has_depth_) depth_.publish(next_depth_);
}

void NodeTest::track(int i, int at) {
  publish(i, at);
  ASSERT_TRUE(waitFor([&] { return hasStatus(at); })) << "no status of frame " << at;
}

void NodeTest::notify(const std::function<void()>& change) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    change();
  }
  changed_.notify_all();
}

bool NodeTest::waitFor(const std::function<bool()>& condition, std::chrono::milliseconds time) {
  const auto deadline = std::chrono::steady_clock::now() + time;
  std::unique_lock<std::mutex> lock(mutex_);
  while (!condition()) {
    if (std::chrono::steady_clock::now() > deadline) return false;
    changed_.wait_for(lock, kRetry);
  }
  return true;
}

bool NodeTest::holds(const std::function<bool()>& condition) {
  const std::lock_guard<std::mutex> lock(mutex_);
  return condition();
}

TrackingStatus NodeTest::statusOf(int at) {
  const std::lock_guard<std::mutex> lock(mutex_);
  return statuses_[stampOf(at)];
}

nav_msgs::Odometry NodeTest::odometryOf(int at) {
  const std::lock_guard<std::mutex> lock(mutex_);
  return odometries_[stampOf(at)];
}

int NodeTest::publishUntil(const std::function<bool()>& condition, int i, int at) {
  constexpr int kMaxFrames = 100;
  constexpr std::chrono::milliseconds kPatience(200);
  for (int end = at + kMaxFrames; at < end; ++at) {
    publish(i, at);
    if (waitFor(condition, kPatience)) return at;
  }
  ADD_FAILURE() << "what the frames were published for has not come about";
  return at;
}

double NodeTest::poseError(int at, const Eigen::Isometry3d& T_odom_base) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto odometry = odometries_.find(stampOf(at));
  if (odometry == odometries_.end()) {
    ADD_FAILURE() << "no odometry of frame " << at;
    return 1e9;
  }
  return localCoordinates(T_odom_base.inverse() * toIsometry(odometry->second.pose.pose)).norm();
}

bool NodeTest::findDiagnosis(const std::string& task,
                             const std::function<bool(const std::string&)>& fits,
                             diagnostic_msgs::DiagnosticStatus& found) const {
  const std::string name = ns_ + "/odometry: " + task;
  for (const auto& array : diagnostics_) {
    for (const auto& status : array.status) {
      // The updater shortens names by the slash at their beginning.
      if (status.name != name && '/' + status.name != name) continue;
      found = status;
      if (fits(status.message)) return true;
    }
  }
  return false;
}

diagnostic_msgs::DiagnosticStatus NodeTest::latestDiagnosis(const std::string& task) const {
  diagnostic_msgs::DiagnosticStatus latest;
  findDiagnosis(
      task, [](const std::string& /*text*/) { return false; }, latest);
  return latest;
}

std::string NodeTest::valueOf(const diagnostic_msgs::DiagnosticStatus& status,
                              const std::string& key) {
  const auto value = std::find_if(
      status.values.begin(), status.values.end(),
      [&](const diagnostic_msgs::KeyValue& candidate) { return candidate.key == key; });
  return value == status.values.end() ? std::string() : value->value;
}

diagnostic_msgs::DiagnosticStatus NodeTest::diagnosis(
    const std::string& task, const std::function<bool(const std::string&)>& fits) {
  diagnostic_msgs::DiagnosticStatus found;
  EXPECT_TRUE(waitFor([&] { return findDiagnosis(task, fits, found); }))
      << "last: " << found.message;
  return found;
}

}  // namespace mivo
