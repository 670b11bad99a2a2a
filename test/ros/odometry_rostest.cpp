// SPDX-License-Identifier: BSD-3-Clause
// What the odometry nodelet publishes, by value.
#include <gtest/gtest.h>
#include <sensor_msgs/point_cloud2_iterator.h>
#include <visualization_msgs/MarkerArray.h>

#include <Eigen/Eigenvalues>
#include <cmath>

#include "mivo/core/se3.h"
#include "programs/plane_sequence.h"
#include "ros/node_fixture.h"
#include "ros/pose_conversion.h"

namespace mivo {
namespace {

// The tracker's error on these small images is 3 mm and 3 mrad after ten frames, during which the
// base moves by 90 mm: a wrong frame or axis gives far more.
constexpr double kTolerance = 0.006;

// Pause between frames while topics connect; tracking itself takes almost no time.
constexpr std::chrono::milliseconds kPatience(100);

template <typename Array>
Matrix6 toMatrix(const Array& covariance) {
  return Eigen::Map<const Eigen::Matrix<double, 6, 6, Eigen::RowMajor>>(covariance.data());
}

TEST_F(NodeTest, OdometryIsTheMotionOfTheBase) {
  publishCameraOnBase();
  load();
  for (int i = 0; i < 12; ++i) track(i);
  ASSERT_TRUE(waitFor([&] { return odometries_.size() == 12U; }));
  for (int i = 0; i < 12; ++i) EXPECT_LT(poseError(i, truth(i)), kTolerance) << i;

  const nav_msgs::Odometry last = odometryOf(11);
  EXPECT_EQ(frame("odom"), last.header.frame_id);
  EXPECT_EQ(frame("base_link"), last.child_frame_id);
  const Vector6 twist = localCoordinates(truth(10).inverse() * truth(11)) * 30.0;
  const geometry_msgs::Twist& published = last.twist.twist;
  Vector6 measured;
  measured << published.linear.x, published.linear.y, published.linear.z, published.angular.x,
      published.angular.y, published.angular.z;
  EXPECT_LT((twist - measured).norm(), 30.0 * kTolerance);
  for (const Matrix6& covariance :
       {toMatrix(last.pose.covariance), toMatrix(last.twist.covariance)}) {
    EXPECT_TRUE(covariance.allFinite());
    EXPECT_LT((covariance - covariance.transpose()).norm(), 1e-12 * covariance.norm());
    EXPECT_GT(Eigen::SelfAdjointEigenSolver<Matrix6>(covariance).eigenvalues().minCoeff(), 0.0);
    EXPECT_LT(covariance.diagonal().maxCoeff(), 1.0);
  }
}

TEST_F(NodeTest, TransformPathAndStatusAgreeWithTheOdometry) {
  publishCameraOnBase();
  load();
  for (int i = 0; i < 6; ++i) track(i);
  ASSERT_TRUE(waitFor([&] {
    return hasOdometry(5) && tf_.canTransform(frame("odom"), frame("base_link"), stampOf(5));
  }));
  const Eigen::Isometry3d T =
      toIsometry(tf_.lookupTransform(frame("odom"), frame("base_link"), stampOf(5)).transform);
  EXPECT_LT(poseError(5, T), 1e-12);

  const TrackingStatus status = statusOf(5);
  EXPECT_EQ(TrackingStatus::TRACKING, status.state);
  EXPECT_EQ("tracking", status.state_text);
  EXPECT_EQ(6U, status.frames);
  EXPECT_EQ(0U, status.skipped_frames);
  EXPECT_GE(status.keyframe, 1);
  EXPECT_GT(status.overlap, 0.5);
  EXPECT_GT(status.points, 100);
  EXPECT_GT(status.total_cpu_ms, 0.0);
  EXPECT_FALSE(status.levels.empty());
  EXPECT_EQ(frame("optical"), status.header.frame_id);

  // The path is sent at most five times a second, however fast frames are tracked, and may overtake
  // the odometry that it holds.
  const auto has_path = [&] {
    if (paths_.empty() || paths_.back().poses.empty()) return false;
    return odometries_.count(paths_.back().poses.back().header.stamp) > 0;
  };
  publishUntil(has_path, 5, 6);
  ASSERT_TRUE(holds(has_path));
  const std::lock_guard<std::mutex> lock(mutex_);
  EXPECT_EQ(frame("odom"), paths_.back().header.frame_id);
  for (const geometry_msgs::PoseStamped& pose : paths_.back().poses) {
    const geometry_msgs::Pose& published = odometries_[pose.header.stamp].pose.pose;
    EXPECT_EQ(published.position.x, pose.pose.position.x);
    EXPECT_EQ(published.orientation.z, pose.pose.orientation.z);
  }
}

TEST_F(NodeTest, NothingIsPublishedBeforeTheCameraIsKnownOnTheBase) {
  load();
  for (int i = 0; i < 4; ++i) track(i);
  EXPECT_TRUE(holds([&] { return odometries_.empty(); }));
  EXPECT_FALSE(tf_.canTransform(frame("odom"), frame("base_link"), ros::Time(0)));
  publishCameraOnBase();
  int i = 4;
  const auto is_known = [&] { return !odometries_.empty(); };
  while (i < 60 && !waitFor(is_known, kPatience)) track(i++);
  // What was tracked in between counts: odom is where the base was at the first frame.
  ASSERT_TRUE(waitFor([&] { return isDone(i - 1); }));
  EXPECT_LT(poseError(i - 1, truth(i - 1)), kTolerance);
}

TEST_F(NodeTest, DisplayTopicsShowThePlane) {
  publishCameraOnBase();
  std::vector<sensor_msgs::PointCloud2> clouds;
  std::vector<visualization_msgs::MarkerArray> markers;
  std::vector<sensor_msgs::Image> references;
  std::vector<sensor_msgs::Image> residuals;
  const ros::Subscriber subscribers[] = {
      collect("keyframe_cloud", clouds), collect("keyframes", markers),
      collect("reference/image", references), collect("residual/image", residuals)};
  load();
  const auto all = [&] {
    return !clouds.empty() && !markers.empty() && !references.empty() && !residuals.empty();
  };
  // Topics connect while frames are sent; latched messages reach late subscribers, too.
  for (int i = 0; i < 40 && !waitFor(all, kPatience); ++i) track(i);
  ASSERT_TRUE(waitFor(all));
  const std::lock_guard<std::mutex> lock(mutex_);
  EXPECT_EQ(planeCamera().camera.width, static_cast<int>(references.back().width));
  EXPECT_EQ("mono8", references.back().encoding);
  EXPECT_EQ(planeCamera().camera.width / 2, static_cast<int>(residuals.back().width));
  EXPECT_EQ(frame("odom"), markers.back().markers.at(0).header.frame_id);
  EXPECT_EQ(0U, markers.back().markers.at(0).points.size() % 16);  // four sides of a pyramid

  // In odom the plane of the sequence: n . (T_camera_base p) = 1.5 m.
  const Eigen::Vector3d normal = Eigen::Vector3d(0.2, -0.1, 1.0).normalized();
  sensor_msgs::PointCloud2ConstIterator<float> point(clouds.back(), "x");
  ASSERT_GT(clouds.back().width, 1000U);
  for (; point != point.end(); ++point) {
    const Eigen::Vector3d in_camera =
        cameraOnBase().inverse() * Eigen::Vector3d(point[0], point[1], point[2]);
    ASSERT_NEAR(1.5, normal.dot(in_camera), 2.0 * kTolerance);
  }
}

TEST_F(NodeTest, StateMarkersTellStateAndReason) {
  publishCameraOnBase();
  std::vector<visualization_msgs::MarkerArray> arrays;
  const ros::Subscriber subscriber = collect("state_markers", arrays);
  load();
  const auto marker = [&](const std::string& ns) {
    for (const visualization_msgs::Marker& one : arrays.back().markers) {
      if (one.ns == ns) return one;
    }
    return visualization_msgs::Marker();
  };
  const auto shows = [&](const std::string& state) {
    return !arrays.empty() && marker("state").text == state;
  };
  const int last = publishUntil([&] { return shows("tracking"); }, 0, 0);
  spoil_ = [this] { blacken(); };
  track(1, last + 1);
  ASSERT_TRUE(waitFor([&] { return shows("lost"); }));
  EXPECT_EQ("image has nothing in\ncommon with the keyframe", marker("reason").text);
  const auto color_of_lost = marker("camera").color;
  const visualization_msgs::Marker path = marker("path");
  spoil_ = [] {};
  track(1, last + 2);
  ASSERT_TRUE(waitFor([&] { return shows("tracking"); }));
  const std::lock_guard<std::mutex> lock(mutex_);
  EXPECT_EQ(frame("odom"), marker("state").header.frame_id);
  EXPECT_EQ(visualization_msgs::Marker::DELETE, marker("reason").action);
  EXPECT_NE(color_of_lost.r, marker("camera").color.r);
  EXPECT_EQ(16U, marker("camera").points.size());  // four sides of a pyramid
  // The lost frame is not on the path; each step has two points and their colors.
  EXPECT_EQ(path.points.size() + 2, marker("path").points.size());
  EXPECT_EQ(marker("path").points.size(), marker("path").colors.size());
  const Eigen::Isometry3d T_odom_camera = truth(1) * cameraOnBase();
  const geometry_msgs::Point& end = marker("path").points.back();
  EXPECT_LT((Eigen::Vector3d(end.x, end.y, end.z) - T_odom_camera.translation()).norm(),
            kTolerance);
  EXPECT_GT(marker("state").pose.position.z, T_odom_camera.translation().z());
}

TEST_F(NodeTest, TwoDModeStaysInThePlane) {
  publishCameraOnBase();
  setParameter("two_d_mode", true);
  load();
  for (int i = 0; i < 5; ++i) track(i);
  ASSERT_TRUE(waitFor([&] { return isDone(4); }));
  const nav_msgs::Odometry last = odometryOf(4);
  EXPECT_EQ(0.0, last.pose.pose.position.z);
  EXPECT_EQ(0.0, last.pose.pose.orientation.x);
  EXPECT_EQ(0.0, last.pose.pose.orientation.y);
  EXPECT_NEAR(truth(4).translation().x(), last.pose.pose.position.x, kTolerance);
  EXPECT_EQ(0.0, last.twist.twist.linear.z);
}

TEST_F(NodeTest, LostFramesHaveAStatusButNoOdometry) {
  publishCameraOnBase();
  load();
  for (int i = 0; i < 4; ++i) track(i);
  spoil_ = [this] { blacken(); };
  track(4);
  EXPECT_EQ(TrackingStatus::LOST, statusOf(4).state);
  EXPECT_NE(TrackingStatus::REASON_NONE, statusOf(4).reason);
  diagnosis("tracking", [](const std::string& text) { return text.find("lost") == 0; });
  spoil_ = [] {};
  track(5);  // light is back: tracking again
  EXPECT_EQ(TrackingStatus::TRACKING, statusOf(5).state);
  ASSERT_TRUE(waitFor([&] { return isDone(5); }));
  EXPECT_FALSE(holds([&] { return hasOdometry(4); }));
  EXPECT_LT(poseError(5, truth(5)), kTolerance);
}

TEST_F(NodeTest, WhenAskedForLostFramesAreUncertain) {
  publishCameraOnBase();
  setParameter("publish_when_lost", true);
  load();
  for (int i = 0; i < 3; ++i) track(i);
  spoil_ = [this] { blacken(); };
  track(3);
  ASSERT_TRUE(waitFor([&] { return isDone(3); }));
  const Matrix6 covariance = toMatrix(odometryOf(3).pose.covariance);
  EXPECT_GE(covariance.diagonal().minCoeff(), 1e3);
  EXPECT_LE(covariance.diagonal().maxCoeff(), 1e6);
}

}  // namespace
}  // namespace mivo
