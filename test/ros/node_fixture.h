// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <diagnostic_msgs/DiagnosticArray.h>
#include <gtest/gtest.h>
#include <mivo/TrackingStatus.h>
#include <nav_msgs/Odometry.h>
#include <nav_msgs/Path.h>
#include <ros/ros.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <tf2_ros/buffer.h>
#include <tf2_ros/static_transform_broadcaster.h>
#include <tf2_ros/transform_listener.h>

#include <Eigen/Geometry>
#include <chrono>
#include <condition_variable>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "programs/plane_sequence.h"

namespace mivo {

/// The odometry nodelet in the manager of the test, fed with images of a plane that a camera moves
/// in front of. Each test has a nodelet of its own in a namespace of its own, which is unloaded at
/// its end. Simulated time follows the images.
class NodeTest : public ::testing::Test {
 protected:
  NodeTest();
  ~NodeTest() override;

  /// Loads the nodelet; parameters under its private name are to be set before, and the camera on
  /// the base is to be known when odometry is wanted. All topics are connected afterwards, and
  /// nothing has been tracked.
  void load();
  /// Loads it without waiting.
  void loadOnly();
  /// Unloads it. Returns whether the manager did.
  bool unload();

  template <typename Value>
  void setParameter(const std::string& name, const Value& value) {
    ros::param::set(privateName(name), value);
  }
  std::string privateName(const std::string& name) const { return ns_ + "/odometry/" + name; }
  /// Frames belong to one test: tf is shared by all.
  std::string frame(const std::string& name) const { return ns_.substr(1) + '_' + name; }

  /// Where the camera sits on the base: in front, above, turned.
  static Eigen::Isometry3d cameraOnBase();
  void publishCameraOnBase();

  /// True pose of the base in odom at frame i.
  static Eigen::Isometry3d truth(int i);

  /// Publishes clock, calibration, color and depth of frame i with the stamp of frame `at`.
  void publish(int i, int at, double depth_delay = 0.0);
  void publish(int i) { publish(i, i); }
  void publishClock(int i);
  /// Publishes a frame and waits for its status.
  void track(int i, int at);
  void track(int i) { track(i, i); }

  /// Publishes frame i with the stamps from frame `at` on until the condition holds, for messages
  /// on different connections overtake each other. Returns the last of the stamps.
  int publishUntil(const std::function<bool()>& condition, int i, int at);

  /// Waits for a condition that depends on messages; false after a timeout.
  bool waitFor(const std::function<bool()>& condition,
               std::chrono::milliseconds time = std::chrono::seconds(10));

  /// Whether the condition holds now.
  bool holds(const std::function<bool()>& condition);

  ros::Time stampOf(int i) const;
  // For the conditions of waitFor and holds.
  bool hasStatus(int at) { return statuses_.count(stampOf(at)) > 0; }
  bool hasOdometry(int at) { return odometries_.count(stampOf(at)) > 0; }

  bool isDone(int at) { return hasStatus(at) && hasOdometry(at); }
  // What was published for frame `at`; empty messages when nothing was.
  TrackingStatus statusOf(int at);
  nav_msgs::Odometry odometryOf(int at);

  /// Distance and angle between the published pose of frame `at` and a pose, as one number.
  double poseError(int at, const Eigen::Isometry3d& T_odom_base);

  /// Waits for an entry of a task ("tracking", "input", "processing") on /diagnostics whose message
  /// fits. Returns the last one that was there.
  diagnostic_msgs::DiagnosticStatus diagnosis(const std::string& task,
                                              const std::function<bool(const std::string&)>& fits);
  /// The same without waiting: a condition of waitFor.
  bool findDiagnosis(const std::string& task, const std::function<bool(const std::string&)>& fits,
                     diagnostic_msgs::DiagnosticStatus& found) const;
  /// The latest entry of a task; also for conditions.
  diagnostic_msgs::DiagnosticStatus latestDiagnosis(const std::string& task) const;
  static std::string valueOf(const diagnostic_msgs::DiagnosticStatus& status,
                             const std::string& key);

  /// Makes the next images black, and without depth: to be called by spoil_.
  void blacken();

  void connect();
  void forget();  // all messages so far

  template <typename Message>
  ros::Subscriber collect(const std::string& topic, std::vector<Message>& messages) {
    const boost::function<void(const boost::shared_ptr<const Message>&)> callback =
        [this, &messages](const boost::shared_ptr<const Message>& message) {
          notify([&] { messages.push_back(*message); });
        };
    return node_.subscribe<Message>(topic, 100, callback);
  }

  void notify(const std::function<void()>& change);

  const int number_;  // of the test
  const std::string ns_;
  ros::NodeHandle node_;
  ros::Publisher color_;
  ros::Publisher depth_;
  ros::Publisher camera_info_;
  ros::Publisher clock_;
  sensor_msgs::CameraInfo calibration_;
  sensor_msgs::Image next_color_;  // of frame i: changed by tests that want them broken
  sensor_msgs::Image next_depth_;
  bool has_depth_ = true;                // the depth image is published
  std::function<void()> spoil_ = [] {};  // called before the two are published
  // Where frame i is filmed, in the world of the plane.
  std::function<Eigen::Isometry3d(int)> filmed_from_ = planePose;

  std::mutex mutex_;  // guards the members below; locked while a condition is evaluated
  std::condition_variable changed_;
  std::map<ros::Time, nav_msgs::Odometry> odometries_;
  std::map<ros::Time, TrackingStatus> statuses_;
  std::vector<nav_msgs::Path> paths_;
  std::vector<diagnostic_msgs::DiagnosticArray> diagnostics_;

  tf2_ros::Buffer tf_;
  tf2_ros::TransformListener tf_listener_;
  tf2_ros::StaticTransformBroadcaster static_;
  std::vector<ros::Subscriber> subscribers_;
  bool loaded_ = false;
  bool camera_is_known_ = false;
  ros::AsyncSpinner spinner_;
};

}  // namespace mivo
