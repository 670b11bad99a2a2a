// SPDX-License-Identifier: BSD-3-Clause
#include "core/terms/image_agreement.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/agreement_statistics.h"
#include "support/analytic_points.h"
#include "support/numeric_derivative.h"
#include "support/projection.h"
#include "support/random_pose.h"

namespace mivo {
namespace {

using testing::analyticCamera;
using testing::largestCorrelation;
using testing::Random;
using testing::relativeError;

constexpr std::size_t kAllPoints = 100000;

class ImageAgreementTest : public ::testing::Test {
 protected:
  Agreement agreementWith(const cv::Mat& live, const Eigen::Isometry3d& T_live_ref,
                          std::size_t most_points = kAllPoints) {
    LiveSamples samples;
    warp_.sample(points_, points_.size(), T_live_ref, live, samples);
    return imageAgreement(points_, {live, nullptr}, samples, samples.visible, warp_, T_live_ref,
                          most_points);
  }

  Vector6 keyframeDerivative(std::size_t i) const {
    Vector6 J;
    for (std::size_t k = 0; k < 6; ++k) {
      J[static_cast<int>(k)] = static_cast<double>(points_.jacobian[k][i]);
    }
    return J;
  }

  Camera camera_ = analyticCamera();
  ReferencePoints points_ = testing::analyticPoints(testing::waves(), camera_, 2);
  Warp warp_{camera_, {}, 1};
};

TEST_F(ImageAgreementTest, TheSameImageAgrees) {
  const cv::Mat same = testing::rasterized(testing::waves(), camera_.width, camera_.height);
  const Agreement agreement = agreementWith(same, Eigen::Isometry3d::Identity());
  EXPECT_EQ(agreement.points, static_cast<int>(points_.size()));
  // Central differences over two pixels are a few percent less steep than waves of thirty.
  EXPECT_LT(relativeError(agreement.live, agreement.keyframe), 0.05);
  EXPECT_LT(relativeError(agreement.both, agreement.keyframe), 0.05);
}

TEST_F(ImageAgreementTest, LiveDerivativesAreThoseOfTheWarpedLiveImage) {
  const testing::AnalyticImage image = testing::litWaves();
  const cv::Mat live = testing::rasterized(image, camera_.width, camera_.height);
  Random random(4);
  for (int trial = 0; trial < 3; ++trial) {
    const Eigen::Isometry3d T = random.pose(0.1, 0.1);
    Agreement expected;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const Eigen::Vector3d point = testing::pointAt(points_, i);
      const auto pixel = testing::project(camera_, T * point);
      if (!pixel || pixel->x() < 1.0 || pixel->y() < 1.0 || pixel->x() >= camera_.width - 2 ||
          pixel->y() >= camera_.height - 2) {
        continue;
      }
      const auto brightness = [&](const Vector6& d) {
        return image(*testing::project(camera_, T * testing::warped(point, d))).value;
      };
      expected.add(keyframeDerivative(i),
                   testing::numericGradient<6>(brightness, Vector6::Zero(), 1e-5));
    }
    const Agreement agreement = agreementWith(live, T);
    EXPECT_NEAR(agreement.points, expected.points, 3);
    EXPECT_LT(relativeError(agreement.keyframe, expected.keyframe), 0.01);
    // Bilinear pixels and central differences flatten the image.
    EXPECT_LT(relativeError(agreement.live, expected.live), 0.08);
    EXPECT_LT(relativeError(agreement.both, expected.both), 0.08);
  }
}

TEST_F(ImageAgreementTest, ANegativeDisagreesAlikeInAllDirections) {
  const cv::Mat negative =
      200.0 - testing::rasterized(testing::waves(), camera_.width, camera_.height);
  const Agreement agreement = agreementWith(negative, Eigen::Isometry3d::Identity());
  EXPECT_LT(relativeError(Matrix6(-agreement.both), agreement.keyframe), 0.05);
}

TEST_F(ImageAgreementTest, FewerPointsAreSpreadOverAll) {
  const cv::Mat same = testing::rasterized(testing::waves(), camera_.width, camera_.height);
  const Agreement all = agreementWith(same, Eigen::Isometry3d::Identity());
  const Agreement some = agreementWith(same, Eigen::Isometry3d::Identity(), points_.size() / 3);
  EXPECT_NEAR(some.points, all.points / 3, all.points / 30);
  EXPECT_LT(relativeError(Matrix6(3.0 * some.live), all.live), 0.15);
}

TEST_F(ImageAgreementTest, HiddenPointsDoNotCount) {
  const cv::Mat same = testing::rasterized(testing::waves(), camera_.width, camera_.height);
  LiveSamples samples;
  const Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  warp_.sample(points_, points_.size(), T, same, samples);
  const std::vector<float> hidden(points_.size(), 0.0F);
  EXPECT_EQ(imageAgreement(points_, {same, nullptr}, samples, hidden, warp_, T, kAllPoints).points,
            0);
}

cv::Mat noiseImage(const Camera& camera, std::uint64_t seed) {
  Random random(seed);
  cv::Mat image(camera.height, camera.width, CV_32FC1);
  for (int i = 0; i < static_cast<int>(image.total()); ++i) {
    image.at<float>(i / image.cols, i % image.cols) =
        static_cast<float>(128.0 + 2.0 * random.normal());
  }
  return image;
}

TEST_F(ImageAgreementTest, AnotherNoiseDoesNotAgreeInAnyDirection) {
  const cv::Mat depth(camera_.height, camera_.width, CV_32FC1, cv::Scalar(2.0F));
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const cv::Mat keyframe = noiseImage(camera_, seed);
    makeReferencePoints({keyframe}, {depth}, camera_, {}, false, points_);
    const Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
    const Agreement other = agreementWith(noiseImage(camera_, seed + 100), T);
    for (int axis = 0; axis < 6; ++axis) {
      EXPECT_LT(largestCorrelation(other, {axis}), 6.0 / std::sqrt(other.points)) << seed;
    }
    // The worst of all directions, and neighbors share pixels, whose noise then counts twice.
    EXPECT_LT(largestCorrelation(other, {0, 1, 2, 3, 4, 5}), 10.0 / std::sqrt(other.points))
        << seed;
    // Its own noise would: that is why the keyframe alone cannot tell.
    const Agreement own = agreementWith(keyframe, T);
    // Smoothed across, the live derivatives of its own noise are not quite the same.
    EXPECT_GT(largestCorrelation(own, {0, 1, 2, 3, 4, 5}), 0.85) << seed;
  }
}

}  // namespace
}  // namespace mivo
