// SPDX-License-Identifier: BSD-3-Clause
#include "session/tracking_session.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "programs/plane_sequence.h"
#include "ros/expect_error.h"
#include "session/twist_covariance.h"

namespace mivo {
namespace {

// The tracker's error on this sequence is far smaller, that of a wrong frame far larger.
constexpr double kTolerance = 0.003;  // m and rad

Frame makeFrame(int i, double stamp) {
  Frame frame;
  frame.stamp = stamp;
  renderPlane(planePose(i), frame.image, frame.depth);
  return frame;
}

Frame makeFrame(int i) {
  return makeFrame(i, planeStamp(i));
}

double distance(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
  return localCoordinates(a.inverse() * b).norm();
}

class TrackingSessionTest : public ::testing::Test {
 protected:
  TrackingSessionTest() : session_(Parameters()) { session_.setCamera(planeCamera().camera); }

  const TrackingResult& track(int i) { return session_.process(makeFrame(i), nullptr); }

  TrackingSession session_;
};

TEST_F(TrackingSessionTest, FollowsTheCamera) {
  for (int i = 0; i <= 5; ++i) track(i);
  EXPECT_EQ(TrackingState::kTracking, session_.result().state);
  EXPECT_LT(distance(planePose(5), session_.result().T_odom_camera), kTolerance);
  EXPECT_EQ(0, session_.result().segment);
}

TEST_F(TrackingSessionTest, CalibrationThatChangesByRoundingIsTheSame) {
  for (int i = 0; i <= 5; ++i) {
    Camera camera = planeCamera().camera;
    camera.fx *= 1.0 + 1e-9 * i;
    camera.cy -= 1e-9 * i;
    camera.distortion.k1 = 1e-9 * i;
    EXPECT_FALSE(session_.setCamera(camera));
    track(i);
  }
  EXPECT_EQ(0, session_.result().segment);
  EXPECT_EQ(TrackingState::kTracking, session_.result().state);
}

TEST_F(TrackingSessionTest, TrueChangeOfTheCalibrationKeepsThePose) {
  for (int i = 0; i <= 5; ++i) track(i);
  Camera camera = planeCamera().camera;
  camera.fx *= 1.001;
  EXPECT_TRUE(session_.setCamera(camera));
  EXPECT_LT(distance(planePose(5), track(5).T_odom_camera), kTolerance);
  EXPECT_EQ(1, session_.result().segment);
}

TEST_F(TrackingSessionTest, RestartKeepsThePoseThoughStampsBeginAnew) {
  for (int i = 0; i <= 5; ++i) track(i);
  session_.restart();
  const TrackingResult& result = session_.process(makeFrame(5, 3.0), nullptr);
  EXPECT_EQ(TrackingState::kTracking, result.state);
  EXPECT_EQ(1, result.segment);
  EXPECT_TRUE(result.new_keyframe);
  EXPECT_LT(distance(planePose(5), result.T_odom_camera), kTolerance);
  session_.process(makeFrame(6, 3.0 + 1.0 / 30.0), nullptr);
  EXPECT_EQ(1, session_.result().segment);
  EXPECT_LT(distance(planePose(6), session_.result().T_odom_camera), kTolerance);
}

TEST_F(TrackingSessionTest, ResetGoesToTheOrigin) {
  for (int i = 0; i <= 5; ++i) track(i);
  session_.reset();
  EXPECT_LT(distance(Eigen::Isometry3d::Identity(), track(6).T_odom_camera), kTolerance);
  EXPECT_EQ(1, session_.result().segment);
  session_.reset();
  EXPECT_EQ(2, track(7).segment);
}

TEST_F(TrackingSessionTest, AnotherCalibrationStartsAnewAtTheLastPose) {
  for (int i = 0; i <= 5; ++i) track(i);
  const int keyframes = session_.result().keyframes;
  EXPECT_FALSE(session_.setCamera(planeCamera().camera));
  Camera other = planeCamera().camera;
  other.fx += 1.0;
  EXPECT_TRUE(session_.setCamera(other));
  const TrackingResult& result = track(6);
  EXPECT_EQ(1, result.segment);
  EXPECT_EQ(keyframes + 1, result.keyframes);
  EXPECT_LT(distance(planePose(5), result.T_odom_camera), kTolerance);
}

TEST_F(TrackingSessionTest, TracksFromAGivenStart) {
  track(0);
  const Eigen::Isometry3d start = planePose(1);
  const TrackingResult& result = session_.process(makeFrame(1), &start);
  EXPECT_LT(distance(planePose(1), result.T_odom_camera), kTolerance);
}

TEST_F(TrackingSessionTest, TheLastMeasuredPoseStandsWhileTheCameraIsLost) {
  EXPECT_FALSE(session_.lastMeasured());
  for (int i = 0; i <= 3; ++i) track(i);
  ASSERT_TRUE(session_.lastMeasured());
  EXPECT_EQ(planeStamp(3), session_.lastMeasured()->stamp);
  EXPECT_LT(distance(planePose(3), session_.lastMeasured()->pose), kTolerance);
  for (int i = 4; i <= 6; ++i) {
    Frame dark = makeFrame(i);
    dark.image = cv::Scalar(0);
    dark.depth = cv::Scalar(0);
    EXPECT_EQ(TrackingState::kLost, session_.process(dark, nullptr).state);
    EXPECT_EQ(planeStamp(3), session_.lastMeasured()->stamp);
  }
  track(7);
  EXPECT_EQ(planeStamp(7), session_.lastMeasured()->stamp);
}

TEST_F(TrackingSessionTest, NothingIsMeasuredAfterAStartAtAnotherPlaceOrTime) {
  track(0);
  session_.restart();
  EXPECT_FALSE(session_.lastMeasured());
  session_.process(makeFrame(1, 3.0), nullptr);
  EXPECT_EQ(3.0, session_.lastMeasured()->stamp);
  session_.reset();
  EXPECT_FALSE(session_.lastMeasured());
}

TEST_F(TrackingSessionTest, AnotherCalibrationStartsAtTheGuessWhenThereIsOne) {
  for (int i = 0; i <= 3; ++i) track(i);
  Camera other = planeCamera().camera;
  other.fx += 1.0;
  session_.setCamera(other);
  ASSERT_TRUE(session_.lastMeasured());  // time goes on
  EXPECT_EQ(planeStamp(3), session_.lastMeasured()->stamp);
  const Eigen::Isometry3d start = planePose(20);
  EXPECT_LT(distance(start, session_.process(makeFrame(20), &start).T_odom_camera), 1e-9);
  EXPECT_EQ(1, session_.result().segment);
}

TEST_F(TrackingSessionTest, ARefusedFrameChangesNothing) {
  for (int i = 0; i <= 3; ++i) track(i);
  const TrackingResult before = session_.result();
  const Matrix6 twist_covariance = session_.twistCovariance();
  const TrackingResult& refused = session_.process(makeFrame(2), nullptr);
  EXPECT_TRUE(refused.isRefused());
  EXPECT_EQ(before.state, refused.state);
  EXPECT_EQ(before.segment, refused.segment);
  EXPECT_EQ(before.T_odom_camera.matrix(), refused.T_odom_camera.matrix());
  EXPECT_EQ(planeStamp(3), session_.lastMeasured()->stamp);
  EXPECT_EQ(twist_covariance, session_.twistCovariance());
  track(4);  // follows frame 3: the velocity is known
  EXPECT_LT(session_.twistCovariance().diagonal().maxCoeff(), 1.0);
}

TEST_F(TrackingSessionTest, ARefusedFrameBeginsNoSegment) {
  track(0);
  Frame broken = makeFrame(1);
  broken.depth = cv::Mat(3, 3, CV_32FC1, cv::Scalar(1.0));
  for (int i = 0; i < 2; ++i) {
    session_.reset();
    EXPECT_TRUE(session_.process(broken, nullptr).isRefused());
  }
  EXPECT_EQ(1, track(1).segment);
}

TEST_F(TrackingSessionTest, VelocityIsUnknownAtFirstAndMeasuredThen) {
  track(0);
  EXPECT_EQ(Matrix6(Matrix6::Identity() * kUnknownVariance), session_.twistCovariance());
  track(1);
  const Matrix6& covariance = session_.twistCovariance();
  EXPECT_LT(covariance.diagonal().maxCoeff(), 1.0);
  EXPECT_GT(Eigen::SelfAdjointEigenSolver<Matrix6>(covariance).eigenvalues().minCoeff(), 0.0);
  session_.restart();
  session_.process(makeFrame(2), nullptr);
  EXPECT_EQ(Matrix6(Matrix6::Identity() * kUnknownVariance), session_.twistCovariance());
}

TEST_F(TrackingSessionTest, ParametersOutlastTheCamera) {
  Parameters parameters;
  parameters.mi.mi_bins = 16;
  session_.setParameters(parameters);
  Camera other = planeCamera().camera;
  other.fx += 1.0;
  session_.setCamera(other);
  EXPECT_EQ(16, session_.odometry().parameters().mi.mi_bins);
  parameters.alignment.levels = 99;
  EXPECT_ERROR(session_.setParameters(parameters), "levels");
  EXPECT_EQ(16, session_.parameters().mi.mi_bins);
}

}  // namespace
}  // namespace mivo
