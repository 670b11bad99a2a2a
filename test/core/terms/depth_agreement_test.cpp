// SPDX-License-Identifier: BSD-3-Clause
#include "core/terms/depth_agreement.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/agreement_statistics.h"
#include "support/numeric_derivative.h"
#include "support/projection.h"
#include "support/random_pose.h"
#include "support/scene.h"

namespace mivo {
namespace {

using testing::largestCorrelation;
using testing::Random;
using testing::relativeError;

constexpr std::size_t kAllPoints = 100000;

/// Into a corner of the room: three walls fix all six directions.
const Eigen::Isometry3d kIntoCorner =
    retract((Vector6() << 0.3, 0.2, -0.3, 0.0, 0.7, 0.0).finished()) *
    retract((Vector6() << 0.0, 0.0, 0.0, -0.5, 0.0, 0.0).finished());

Frame noisyDepth(const Frame& frame, double deviation, std::uint64_t seed) {
  Random random(seed);
  Frame noisy = frame;
  noisy.depth = frame.depth.clone();
  for (int i = 0; i < static_cast<int>(noisy.depth.total()); ++i) {
    noisy.depth.at<float>(i / noisy.depth.cols, i % noisy.depth.cols) +=
        static_cast<float>(deviation * random.normal());
  }
  return noisy;
}

class DepthAgreementTest : public ::testing::Test {
 protected:
  void lookAtKeyframe(const Frame& keyframe) {
    makeGeometricPoints(keyframe.depth, camera_, {}, 1500, 1500, points_);
  }

  Agreement agreementWith(const Frame& live, const Eigen::Isometry3d& T_live_ref,
                          std::size_t most_points = kAllPoints) const {
    const std::size_t n = points_.size();
    std::vector<float> u(n, 0.0F);
    std::vector<float> v(n, 0.0F);
    std::vector<float> visible(n, 0.0F);
    for (std::size_t i = 0; i < n; ++i) {
      const Eigen::Vector3d X =
          Eigen::Vector3f(points_.x[i], points_.y[i], points_.z[i]).cast<double>();
      const auto pixel = testing::project(camera_, T_live_ref * X);
      if (!pixel || pixel->x() < 0.0 || pixel->y() < 0.0 || pixel->x() >= camera_.width - 1 ||
          pixel->y() >= camera_.height - 1) {
        continue;
      }
      u[i] = static_cast<float>(pixel->x());
      v[i] = static_cast<float>(pixel->y());
      visible[i] = 1.0F;
    }
    return depthAgreement(points_, live, camera_, u, v, visible, T_live_ref, most_points);
  }

  Camera camera_ = testing::smallCamera();
  GeometricPoints points_;
};

TEST_F(DepthAgreementTest, TheSameSurfacesAgreeFromWhereverTheyAreSeen) {
  lookAtKeyframe(testing::render(testing::roomScene(), camera_, kIntoCorner));
  Random random(3);
  for (const double size : {0.0, 0.05, 0.1}) {
    const Eigen::Isometry3d T_live_ref = random.pose(size, size);
    const Frame live =
        testing::render(testing::roomScene(), camera_, kIntoCorner * T_live_ref.inverse());
    const Agreement agreement = agreementWith(live, T_live_ref);
    EXPECT_GT(agreement.points, static_cast<int>(points_.size()) * 3 / 4) << size;
    // Patches across an edge have a normal of neither wall.
    EXPECT_LT(relativeError(agreement.live, agreement.keyframe), 0.05) << size;
    EXPECT_LT(relativeError(agreement.both, agreement.keyframe), 0.05) << size;
  }
}

TEST_F(DepthAgreementTest, BehindALensTheSameSurfacesAgree) {
  for (const Camera& camera : {testing::distortedCamera(), testing::fisheyeCamera()}) {
    camera_ = camera;
    lookAtKeyframe(testing::render(testing::roomScene(), camera_, kIntoCorner));
    const Eigen::Isometry3d T_live_ref = Random(3).pose(0.1, 0.1);
    const Frame live =
        testing::render(testing::roomScene(), camera_, kIntoCorner * T_live_ref.inverse());
    const Agreement agreement = agreementWith(live, T_live_ref);
    EXPECT_GT(agreement.points, static_cast<int>(points_.size()) * 3 / 4);
    // A patch of the wide view is larger, and more of them lie across an edge: 0.12. With the rays
    // of a pinhole it would be 1.5.
    const double bound = camera.distortion.model == LensModel::kEquidistant ? 0.15 : 0.05;
    EXPECT_LT(relativeError(agreement.live, agreement.keyframe), bound);
    EXPECT_LT(relativeError(agreement.both, agreement.keyframe), bound);
  }
}

TEST_F(DepthAgreementTest, FewerPointsAreSpreadOverAll) {
  const Frame frame = testing::render(testing::roomScene(), camera_, kIntoCorner);
  lookAtKeyframe(frame);
  const Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  const Agreement all = agreementWith(frame, T);
  const Agreement some = agreementWith(frame, T, points_.size() / 3);
  EXPECT_NEAR(some.points, all.points / 3, all.points / 10);
}

TEST_F(DepthAgreementTest, WithoutLiveDepthNothingIsCompared) {
  Frame frame = testing::render(testing::roomScene(), camera_, kIntoCorner);
  lookAtKeyframe(frame);
  frame.depth = cv::Mat::zeros(frame.depth.size(), CV_32FC1);
  EXPECT_EQ(agreementWith(frame, Eigen::Isometry3d::Identity()).points, 0);
}

// Noise tilts the planes of a wall, and the tilts have curvature along it and about its normal.
TEST_F(DepthAgreementTest, NoiseOfAWallDoesNotAgreeAlongIt) {
  const Frame wall = testing::render(testing::wallScene(), camera_, Eigen::Isometry3d::Identity());
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    lookAtKeyframe(noisyDepth(wall, 0.004, seed));
    const Agreement agreement =
        agreementWith(noisyDepth(wall, 0.004, seed + 100), Eigen::Isometry3d::Identity());
    ASSERT_GT(agreement.points, 300);
    EXPECT_LT(largestCorrelation(agreement, {0, 1, 5}), 6.0 / std::sqrt(agreement.points)) << seed;
    EXPECT_GT(largestCorrelation(agreement, {2}), 0.95) << seed;
  }
}

}  // namespace
}  // namespace mivo
