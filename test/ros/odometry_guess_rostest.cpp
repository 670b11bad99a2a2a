// SPDX-License-Identifier: BSD-3-Clause
// Motion guess from wheel odometry: the robot drives a meter with the lens covered.
#include <gtest/gtest.h>
#include <tf2_ros/transform_broadcaster.h>

#include <algorithm>
#include <cmath>

#include "mivo/core/se3.h"
#include "ros/node_fixture.h"
#include "ros/pose_conversion.h"

namespace mivo {
namespace {

constexpr double kTolerance = 0.006;  // as in odometry_rostest
constexpr double kWheelTolerance = 0.03;

constexpr int kLastSeen = 9;    // frame before the lens is covered
constexpr int kSeenAgain = 40;  // first frame after it
constexpr int kLast = 46;

// A meter along the plane, past which the robot drives.
const Eigen::Vector3d kDrive = Eigen::Vector3d(1.0, 0.0, -0.2).normalized();
constexpr double kTurn = -0.2;  // rad, back towards the previous view

class GuessTest : public NodeTest {
 protected:
  GuessTest() : wheels_(frame("wheels")) {
    setParameter("guess_frame_id", wheels_);
    // The transform of a frame is published just before its images.
    setParameter("tf_timeout", 0.5);
    filmed_from_ = [this](int i) { return T_elsewhere(i) * cameraAt(i); };
    spoil_ = [this] {
      const int i = frameOf(next_color_.header.stamp);
      if (i > kLastSeen && i < kSeenAgain) blacken();
      if (are_wheels_known_(i)) sendWheels(i);
    };
    publishCameraOnBase();
  }

  /// Pose of the camera in the world of the first plane.
  static Eigen::Isometry3d cameraAt(int i) {
    const double driven =
        std::clamp((i - kLastSeen) / static_cast<double>(kSeenAgain - kLastSeen), 0.0, 1.0);
    Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
    T.translation() = driven * kDrive;
    T.linear() = expSo3({0.0, driven * kTurn, 0.0});
    // Visible frames continue as before.
    return planePose(std::min(i, kLastSeen)) * T * planePose(std::max(0, i - kSeenAgain));
  }

  static Eigen::Isometry3d baseAt(int i) {
    return cameraOnBase() * cameraAt(i) * cameraOnBase().inverse();
  }

  /// Another part of the plane, from another distance and angle, without overlap with earlier
  /// views.
  Eigen::Isometry3d T_elsewhere(int i) const {
    Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
    if (is_elsewhere_ && i >= kSeenAgain) {
      T.translation() << 7.0, 0.0, -2.2;
      T.linear() = expSo3({0.0, 0.0, 1.0});
    }
    return T;
  }

  int frameOf(const ros::Time& stamp) const {
    return static_cast<int>(std::lround((stamp - stampOf(0)).toSec() * 30.0));
  }

  void sendWheels(int i) {
    geometry_msgs::TransformStamped transform;
    transform.header.stamp = stampOf(i);
    transform.header.frame_id = wheels_;
    transform.child_frame_id = frame("base_link");
    transform.transform = toTransform(T_wheels_odom_(i) * baseAt(i));
    broadcaster_.sendTransform(transform);
  }

  void drive() {
    for (int i = 0; i <= kLast; ++i) track(i);
    ASSERT_TRUE(waitFor([&] { return isDone(kLast); }));
    for (int i = kLastSeen + 1; i < kSeenAgain; ++i) {
      EXPECT_EQ(TrackingStatus::LOST, statusOf(i).state) << i;
    }
    EXPECT_EQ(TrackingStatus::TRACKING, statusOf(kLast).state);
  }

  const std::string wheels_;
  bool is_elsewhere_ = false;
  std::function<bool(int)> are_wheels_known_ = [](int /*i*/) { return true; };
  std::function<Eigen::Isometry3d(int)> T_wheels_odom_ = [](int /*i*/) {
    Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
    T.translation() << 5.0, 6.0, 0.0;
    T.linear() = expSo3({0.0, 0.0, 2.0});
    return T;
  };
  tf2_ros::TransformBroadcaster broadcaster_;
};

TEST_F(GuessTest, TheWheelsStayTheParentOfTheBase) {
  load();
  for (int i = 0; i < 5; ++i) track(i);
  ASSERT_TRUE(waitFor([&] {
    return hasOdometry(4) && tf_.canTransform(frame("odom"), frame("base_link"), stampOf(4));
  }));
  std::string parent;
  ASSERT_TRUE(tf_._getParent(frame("base_link"), ros::Time(0), parent));
  EXPECT_EQ(wheels_, parent);
  const Eigen::Isometry3d T =
      toIsometry(tf_.lookupTransform(frame("odom"), frame("base_link"), stampOf(4)).transform);
  EXPECT_LT(poseError(4, T), 1e-9);
  EXPECT_LT(poseError(4, baseAt(4)), kTolerance);
}

TEST_F(GuessTest, AMeterDrivenBehindACoveredLensLeadsBackToWhatIsKnown) {
  load();
  drive();
  EXPECT_EQ(statusOf(kLastSeen).segment, statusOf(kLast).segment);
  EXPECT_EQ(TrackingStatus::TRACKING, statusOf(kSeenAgain).state);
  EXPECT_LT(poseError(kLast, baseAt(kLast)), kWheelTolerance);
}

TEST_F(GuessTest, AMeterDrivenBehindACoveredLensEndsWhereTheNewSegmentBegins) {
  is_elsewhere_ = true;
  load();
  drive();
  EXPECT_EQ(statusOf(kLastSeen).segment + 1, statusOf(kLast).segment);
  EXPECT_LT(poseError(kLast, baseAt(kLast)), kWheelTolerance);
}

TEST_F(GuessTest, WhenAskedForPosesFollowTheWheelsBehindTheCoveredLens) {
  setParameter("publish_when_lost", true);
  load();
  drive();
  for (int i = kLastSeen + 1; i < kSeenAgain; ++i) {
    EXPECT_LT(poseError(i, baseAt(i)), kWheelTolerance) << i;
  }
}

TEST_F(GuessTest, WheelsThatAreLateForTheLastGoodFrameStillHelp) {
  setParameter("tf_timeout", 0.01);
  are_wheels_known_ = [](int i) { return i != kLastSeen; };
  load();
  drive();
  EXPECT_LT(poseError(kLast, baseAt(kLast)), kWheelTolerance);
}

TEST_F(GuessTest, WheelsThatAreResetAreNotBelieved) {
  is_elsewhere_ = true;
  const auto T_wheels_odom = T_wheels_odom_;
  T_wheels_odom_ = [=](int i) {
    return i < kLastSeen + 5 ? T_wheels_odom(i) : Eigen::Isometry3d::Identity();
  };
  load();
  drive();
  // The new segment begins at the last good pose, a meter off, not five or more.
  EXPECT_LT(poseError(kLast, baseAt(kLastSeen)), 0.2);
}

}  // namespace
}  // namespace mivo
