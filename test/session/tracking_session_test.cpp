// SPDX-License-Identifier: BSD-3-Clause
#include "session/tracking_session.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "programs/plane_sequence.h"
#include "ros/expect_error.h"
#include "session/twist_covariance.h"

namespace mivo {
namespace {

// The tracker's error on this sequence is far below; a mixed-up frame is far above.
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
