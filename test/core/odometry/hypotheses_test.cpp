// SPDX-License-Identifier: BSD-3-Clause
#include "core/odometry/hypotheses.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/alignment/pose_covariance.h"
#include "support/random_pose.h"

namespace mivo {
namespace {

constexpr double kExpected = 0.003;  // m and rad, standard deviation of the prediction
constexpr double kMeasured = 0.004;  // of an alignment: together 0.005

/// A keyframe, and a camera predicted at another pose.
class HypothesesTest : public ::testing::Test {
 protected:
  HypothesesTest() {
    testing::Random random(4);
    keyframes_.candidate().T_odom_keyframe = random.pose(1.0, 1.0);
    keyframes_.promote(0);
    prediction_.T_odom_camera = keyframes_.current().T_odom_keyframe * random.pose(0.1, 0.2);
    prediction_.covariance = diagonalCovariance(kExpected, kExpected);
  }

  /// A sight whose pose is this far from the prediction, along an axis of the camera.
  Sight sightAt(double offset, double correlation, int axis = 0) const {
    const Eigen::Isometry3d T_odom_camera =
        prediction_.T_odom_camera * retract(offset * Vector6::Unit(axis));
    Sight sight;
    sight.alignment.T_live_ref = T_odom_camera.inverse() * keyframes_.current().T_odom_keyframe;
    // The covariance of the increment that is isotropic in the camera's axes.
    const Matrix6 to_increment = adjoint(sight.alignment.T_live_ref.inverse());
    sight.alignment.covariance =
        to_increment * diagonalCovariance(kMeasured, kMeasured) * to_increment.transpose();
    sight.alignment.correlation = correlation;
    sight.alignment.points = 6400;
    return sight;
  }

  double evidenceOf(const Sight& sight) const { return evidence(input_, prediction_, sight); }

  OdometryState state_;
  KeyframeStore keyframes_;
  FramePyramid live_;
  Camera camera_;
  Parameters parameters_;
  Prediction prediction_;
  SearchInput input_{state_, keyframes_, live_, camera_, parameters_};
};

TEST_F(HypothesesTest, InnovationCountsInDeviationsOfPredictionAndAlignment) {
  EXPECT_NEAR(innovation(input_, prediction_, sightAt(0.0, 0.9)), 0.0, 1e-9);
  for (int axis = 0; axis < 6; ++axis) {
    EXPECT_NEAR(innovation(input_, prediction_, sightAt(0.015, 0.9, axis)), 9.0, 0.01) << axis;
  }
}

TEST_F(HypothesesTest, AHigherCorrelationIsWorthASurpriseButNotAnyOne) {
  const Sight expected = sightAt(0.0, 0.5);
  EXPECT_GT(evidenceOf(expected), evidenceOf(sightAt(0.1, 0.5)));
  EXPECT_GT(evidenceOf(sightAt(0.1, 0.9)), evidenceOf(expected));
  EXPECT_GT(evidenceOf(expected), evidenceOf(sightAt(0.1, 0.55)));
  // No correlation, or a negative one, is no evidence.
  EXPECT_NEAR(evidenceOf(sightAt(0.0, 0.0)), 0.0, 1e-6);
  EXPECT_NEAR(evidenceOf(sightAt(0.0, -0.5)), 0.0, 1e-6);
  EXPECT_TRUE(std::isfinite(evidenceOf(sightAt(0.0, 1.0))));
}

TEST_F(HypothesesTest, TwoPosesThatExplainTheFrameAlikeAreAmbiguous) {
  const Sight better = sightAt(0.02, 0.7);
  EXPECT_TRUE(isAmbiguous(input_, prediction_, better, sightAt(-0.02, 0.69)));
  EXPECT_FALSE(isAmbiguous(input_, prediction_, better, sightAt(-0.02, 0.6)));  // clearly worse
  EXPECT_FALSE(isAmbiguous(input_, prediction_, better, sightAt(0.022, 0.7)));  // the same pose
}

TEST_F(HypothesesTest, TheCovarianceOfAnAmbiguousSightCoversBothPoses) {
  const Sight better = sightAt(0.02, 0.7, 1);
  const Sight both = coveringBoth(input_, better, sightAt(-0.03, 0.7, 1));
  EXPECT_TRUE(both.is_ambiguous);
  EXPECT_TRUE(both.alignment.T_live_ref.isApprox(better.alignment.T_live_ref));
  const Matrix6 covariance =
      liveCovariance(both.alignment.T_live_ref, both.alignment.covariance, Matrix6::Zero());
  EXPECT_NEAR(std::sqrt(covariance(1, 1)), std::hypot(0.05, kMeasured), 1e-4);
  EXPECT_NEAR(std::sqrt(covariance(0, 0)), kMeasured, 1e-4);
}

}  // namespace
}  // namespace mivo
