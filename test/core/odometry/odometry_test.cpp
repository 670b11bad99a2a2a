// SPDX-License-Identifier: BSD-3-Clause
#include "mivo/core/odometry.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <limits>
#include <opencv2/core.hpp>

#include "mivo/core/error.h"
#include "support/camera_path.h"
#include "support/projection.h"
#include "support/random_pose.h"

namespace mivo {
namespace {

using testing::kFramePeriod;
using testing::Random;
using testing::Recording;

const Recording& walk() {
  static const Recording recording = testing::recordWalk(30);
  return recording;
}

/// Translation in m and rotation in rad between two poses.
Eigen::Vector2d distance(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
  const Vector6 d = localCoordinates(a.inverse() * b);
  return {d.head<3>().norm(), d.tail<3>().norm()};
}

void expectNear(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b, double translation,
                double rotation) {
  EXPECT_LT(distance(a, b)[0], translation);
  EXPECT_LT(distance(a, b)[1], rotation);
}

Frame stamped(Frame frame, double stamp) {
  frame.stamp = stamp;
  return frame;
}

std::vector<TrackingResult> run(Odometry& odometry, const std::vector<Frame>& frames) {
  std::vector<TrackingResult> results;
  for (const Frame& frame : frames) results.push_back(odometry.process(frame));
  return results;
}

TEST(OdometryTest, InvalidCamerasAndParametersAreRefused) {
  Camera camera = testing::smallCamera();
  camera.fx = 0.0;
  EXPECT_THROW(Odometry(camera, {}), Error);
  Parameters parameters;
  parameters.mi.mi_bins = 1;
  EXPECT_THROW(Odometry(testing::smallCamera(), parameters), Error);
}

TEST(OdometryTest, TheFirstPoseIsTheIdentity) {
  Odometry odometry(walk().camera, {});
  EXPECT_FALSE(odometry.hasKeyframe());
  const TrackingResult& result = odometry.process(walk().frames[0]);
  EXPECT_EQ(result.T_odom_camera.matrix(), Eigen::Matrix4d::Identity());
  EXPECT_EQ(result.state, TrackingState::kTracking);
  EXPECT_TRUE(result.new_keyframe);
  EXPECT_EQ(result.keyframes, 1);
  EXPECT_EQ(result.stamp, 10.0);
  EXPECT_TRUE(odometry.hasKeyframe());
}

TEST(OdometryTest, EveryMethodFollowsTheCamera) {
  struct Case {
    Method method;
    PhotometricModel model;
    double translation;  // m, over a walk of 35 cm
    double rotation;     // rad
  };
  for (const Case& c : {Case{Method::kSsd, PhotometricModel::kNone, 0.012, 0.006},
                        Case{Method::kMi, PhotometricModel::kNone, 0.04, 0.016},
                        Case{Method::kHybrid, PhotometricModel::kNone, 0.012, 0.006},
                        Case{Method::kSsd, PhotometricModel::kLcn, 0.012, 0.006},
                        Case{Method::kMi, PhotometricModel::kLcn, 0.04, 0.016},
                        Case{Method::kHybrid, PhotometricModel::kLcn, 0.012, 0.006}}) {
    SCOPED_TRACE(::testing::Message()
                 << static_cast<int>(c.method) << ' ' << static_cast<int>(c.model));
    Parameters parameters;
    parameters.alignment.method = c.method;
    parameters.alignment.photometric_model = c.model;
    Odometry odometry(walk().camera, parameters);
    const std::vector<TrackingResult> results = run(odometry, walk().frames);
    for (std::size_t i = 0; i < results.size(); ++i) {
      EXPECT_EQ(results[i].state, TrackingState::kTracking) << i;
      expectNear(results[i].T_odom_camera, walk().T_first_camera[i], c.translation, c.rotation);
    }
    EXPECT_GT(results.back().keyframes, 2);
    EXPECT_EQ(results.back().segment, 0);
  }
}

TEST(OdometryTest, IntegerAndDistortedInputIsFollowedToo) {
  Recording recording;
  recording.camera = testing::distortedCamera();
  testing::Sensor sensor;
  sensor.integer_depth = true;
  Odometry odometry(recording.camera, {});
  for (int i = 0; i < 6; ++i) {
    const Eigen::Isometry3d truth =
        retract(i * (Vector6() << 0.01, 0.005, 0.0, 0.0, 0.02, 0.01).finished());
    const Frame frame = stamped(
        testing::render(testing::roomScene(), recording.camera, truth, {}, sensor), 0.1 * i);
    expectNear(odometry.process(frame).T_odom_camera, truth, 0.004, 0.002);
  }
}

TEST(OdometryTest, VelocityIsThatOfTheCamera) {
  Odometry odometry(walk().camera, {});
  const std::vector<TrackingResult> results = run(odometry, walk().frames);
  EXPECT_EQ(results[0].velocity, Vector6::Zero());
  for (const std::size_t i : {5U, 15U, 25U}) {
    const Vector6 truth =
        logSe3(walk().T_first_camera[i - 1].inverse() * walk().T_first_camera[i]) / kFramePeriod;
    EXPECT_LT((results[i].velocity - truth).head<3>().norm(), 0.1);
    EXPECT_LT((results[i].velocity - truth).tail<3>().norm(), 0.05);
  }
}

TEST(OdometryTest, ThePredictionContinuesTheMotion) {
  Odometry odometry(walk().camera, {});
  for (std::size_t i = 0; i < 20; ++i) odometry.process(walk().frames[i]);
  const Eigen::Isometry3d predicted = odometry.predictedPose(walk().frames[20].stamp);
  expectNear(predicted, walk().T_first_camera[20], 0.012, 0.008);
  EXPECT_GT(distance(predicted, odometry.result().T_odom_camera)[1], 0.005);
}

TEST(OdometryTest, AGivenStartIsUsed) {
  // Two frames too far apart for the prediction.
  const std::size_t far = 14;
  Parameters parameters;
  parameters.loss.lost_speed = 1000.0;
  parameters.loss.lost_turn_rate = 1000.0;
  Odometry odometry(walk().camera, parameters);
  odometry.process(walk().frames[0]);
  const Eigen::Isometry3d start = walk().T_first_camera[far] * Random(1).pose(0.01, 0.01);
  const TrackingResult& result = odometry.process(walk().frames[far], start);
  EXPECT_EQ(result.state, TrackingState::kTracking);
  expectNear(result.T_odom_camera, walk().T_first_camera[far], 0.02, 0.01);
  // An invalid start pose is ignored.
  Eigen::Isometry3d broken = start;
  broken.translation().x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(odometry.process(walk().frames[far + 1], broken).T_odom_camera.matrix().allFinite());
}

TEST(OdometryTest, ResetStartsAnewAtThePose) {
  Odometry odometry(walk().camera, {});
  for (std::size_t i = 0; i < 5; ++i) odometry.process(walk().frames[i]);
  const int keyframes = odometry.result().keyframes;
  const Eigen::Isometry3d pose = Random(2).pose(3.0, 1.0);
  odometry.reset(pose);
  EXPECT_FALSE(odometry.hasKeyframe());
  // Stamps are reset, too: an earlier one is accepted now.
  const TrackingResult& first = odometry.process(walk().frames[0]);
  EXPECT_EQ(first.reason, TrackingReason::kNone);
  expectNear(first.T_odom_camera, pose, 1e-9, 1e-9);
  EXPECT_EQ(first.segment, 1);
  EXPECT_EQ(first.keyframes, keyframes + 1);
  EXPECT_EQ(first.velocity, Vector6::Zero());
  for (std::size_t i = 1; i < 5; ++i) odometry.process(walk().frames[i]);
  expectNear(odometry.result().T_odom_camera, pose * walk().T_first_camera[4], 0.005, 0.003);
}

TEST(OdometryTest, SetPoseMovesTheWorldAndTrackingGoesOn) {
  Odometry moved(walk().camera, {});
  Odometry still(walk().camera, {});
  for (std::size_t i = 0; i < 8; ++i) {
    moved.process(walk().frames[i]);
    still.process(walk().frames[i]);
  }
  const Eigen::Isometry3d pose = Random(3).pose(3.0, 2.0);
  const Eigen::Isometry3d T_new_old = pose * moved.result().T_odom_camera.inverse();
  moved.setPose(pose);
  expectNear(moved.result().T_odom_camera, pose, 1e-12, 1e-9);
  for (std::size_t i = 8; i < 20; ++i) {
    const TrackingResult& a = moved.process(walk().frames[i]);
    const TrackingResult& b = still.process(walk().frames[i]);
    expectNear(a.T_odom_camera, T_new_old * b.T_odom_camera, 1e-4, 1e-4);
    EXPECT_EQ(a.state, TrackingState::kTracking);
    EXPECT_EQ(a.new_keyframe, b.new_keyframe);
  }
  EXPECT_EQ(moved.result().segment, 0);
}

TEST(OdometryTest, PosesThatAreNoneAreRefused) {
  for (const double number : {std::numeric_limits<double>::quiet_NaN(), 0.0, -1.0, 1.01}) {
    Odometry odometry(walk().camera, {});
    Eigen::Isometry3d broken = Eigen::Isometry3d::Identity();
    broken.linear()(1, 1) = number;
    EXPECT_THROW(odometry.reset(broken), Error);
    EXPECT_THROW(odometry.setPose(broken), Error);
    odometry.process(walk().frames[0]);
    const TrackingResult& result = odometry.process(walk().frames[1], broken);
    EXPECT_EQ(result.state, TrackingState::kTracking);
    expectNear(result.T_odom_camera, walk().T_first_camera[1], 0.005, 0.005);
  }
}

TEST(OdometryTest, KeyframesChangeWithoutAJump) {
  Odometry odometry(walk().camera, {});
  const std::vector<TrackingResult> results = run(odometry, walk().frames);
  int changes = 0;
  for (std::size_t i = 1; i < results.size(); ++i) {
    if (!results[i].new_keyframe && !results[i - 1].new_keyframe) continue;
    ++changes;
    const Eigen::Isometry3d step =
        results[i - 1].T_odom_camera.inverse() * results[i].T_odom_camera;
    const Eigen::Isometry3d truth =
        walk().T_first_camera[i - 1].inverse() * walk().T_first_camera[i];
    expectNear(step, truth, 0.005, 0.0025);
  }
  EXPECT_GT(changes, 3);
}

TEST(OdometryTest, OneKeyframeIsKeptWhenToldSo) {
  Parameters parameters;
  parameters.keyframes.keyframe_policy = KeyframePolicy::kFirst;
  Odometry odometry(walk().camera, parameters);
  for (std::size_t i = 0; i < 12; ++i) odometry.process(walk().frames[i]);
  EXPECT_EQ(odometry.result().keyframes, 1);
  EXPECT_EQ(odometry.keyframePose().matrix(), Eigen::Matrix4d::Identity());
}

TEST(OdometryTest, CovarianceIsSymmetricAndPositiveDefinite) {
  Odometry odometry(walk().camera, {});
  for (const TrackingResult& result : run(odometry, walk().frames)) {
    EXPECT_EQ(result.covariance, result.covariance.transpose());
    EXPECT_GT(Eigen::SelfAdjointEigenSolver<Matrix6>(result.covariance).eigenvalues().minCoeff(),
              0.0);
  }
  // The deviation of a tracked frame is between a micrometer and a centimeter.
  const double deviation = std::sqrt(odometry.result().covariance(0, 0));
  EXPECT_LT(deviation, 0.01);
  EXPECT_GT(deviation, 1e-6);
}

// The standard deviation of the errors over several seeds of noise agrees with the covariance up to
// a factor of 3. Strong noise makes the systematic part of the covariance, which does not vary with
// the seed, negligible. The covariance of mutual information is larger than the errors: its windows
// are wider than this noise.
TEST(OdometryTest, CovarianceIsAboutTheSpreadOfTheErrors) {
  constexpr int kSeeds = 40;
  constexpr double kNoise = 15.0;
  struct Case {
    Method method;
    PhotometricModel model;
    double lowest;  // ratio of measured and predicted deviation
  };
  for (const Case& c : {Case{Method::kSsd, PhotometricModel::kNone, 1.0 / 3.0},
                        Case{Method::kMi, PhotometricModel::kNone, 1.0 / 6.0},
                        Case{Method::kHybrid, PhotometricModel::kLcn, 1.0 / 3.0}}) {
    SCOPED_TRACE(static_cast<int>(c.method));
    Parameters parameters;
    parameters.alignment.method = c.method;
    parameters.alignment.photometric_model = c.model;
    parameters.geometry.geometric_term = false;
    parameters.keyframes.keyframe_policy = KeyframePolicy::kFirst;
    std::vector<Vector6> errors;
    Vector6 mean = Vector6::Zero();
    Vector6 variance = Vector6::Zero();
    for (int seed = 0; seed < kSeeds; ++seed) {
      Odometry odometry(walk().camera, parameters);
      const auto salt = static_cast<std::uint64_t>(10 * seed);
      odometry.process(testing::withNoise(walk().frames[0], kNoise, salt + 1));
      const TrackingResult& result = odometry.process(
          testing::withNoise(walk().frames[2], kNoise, salt + 2), walk().T_first_camera[2]);
      errors.push_back(localCoordinates(result.T_odom_camera.inverse() * walk().T_first_camera[2]));
      mean += errors.back() / kSeeds;
      variance += result.covariance.diagonal() / kSeeds;
    }
    Vector6 spread = Vector6::Zero();
    for (const Vector6& error : errors) spread += (error - mean).cwiseAbs2() / (kSeeds - 1);
    for (int k = 0; k < 6; ++k) {
      const double ratio = std::sqrt(spread[k] / variance[k]);
      EXPECT_GT(ratio, c.lowest) << k;
      EXPECT_LT(ratio, 3.0) << k;
    }
  }
}

TEST(OdometryTest, TheCovarianceGrowsFromKeyframeToKeyframeUntilThePoseIsGiven) {
  Parameters parameters;
  parameters.keyframes.keyframe_rotation = 0.01;  // often
  Odometry odometry(walk().camera, parameters);
  double last = 0.0;
  for (std::size_t i = 0; i < 8; ++i) {
    const TrackingResult& result = odometry.process(walk().frames[i]);
    if (!result.new_keyframe) continue;
    EXPECT_GT(result.covariance.trace(), last);
    last = result.covariance.trace();
    EXPECT_LE(result.alignment_covariance.trace(), result.covariance.trace());
  }
  EXPECT_GT(odometry.result().keyframes, 2);
  odometry.reset();
  odometry.process(walk().frames[8]);
  EXPECT_LT(odometry.result().covariance.trace(), 1e-8);
}

TEST(OdometryTest, ParametersTakeEffectWithTheNextFrameOrNotAtAll) {
  Odometry odometry(walk().camera, {});
  for (std::size_t i = 0; i < 3; ++i) odometry.process(walk().frames[i]);
  Parameters parameters = odometry.parameters();
  parameters.alignment.max_iterations = 0;
  EXPECT_THROW(odometry.setParameters(parameters), Error);
  EXPECT_EQ(odometry.parameters().alignment.max_iterations, Parameters().alignment.max_iterations);
  parameters.alignment.max_iterations = 5;
  odometry.setParameters(parameters);
  EXPECT_FALSE(odometry.process(walk().frames[3]).new_keyframe);
  parameters.alignment.method = Method::kMi;
  odometry.setParameters(parameters);
  const TrackingResult& result = odometry.process(walk().frames[4]);
  EXPECT_TRUE(result.new_keyframe);
  EXPECT_EQ(result.segment, 0);
  for (std::size_t i = 5; i < 9; ++i) odometry.process(walk().frames[i]);
  expectNear(odometry.result().T_odom_camera, walk().T_first_camera[8], 0.03, 0.02);
}

TEST(OdometryTest, ViewsForDisplayFitTheFrame) {
  Odometry odometry(walk().camera, {});
  EXPECT_TRUE(odometry.keyframeCloud().empty());
  EXPECT_TRUE(odometry.residualImage().empty());
  odometry.process(walk().frames[0]);
  odometry.process(walk().frames[1]);
  EXPECT_EQ(cv::norm(odometry.keyframeImage(), walk().frames[0].image, cv::NORM_INF), 0.0);
  const std::vector<CloudPoint> cloud = odometry.keyframeCloud();
  ASSERT_EQ(cloud.size(), 80U * 60U);
  const Camera& camera = walk().camera;
  const auto pixel = testing::project(camera, {cloud[81].x, cloud[81].y, cloud[81].z});
  EXPECT_LT((*pixel - Eigen::Vector2d(2.0, 2.0)).norm(), 1e-3);
  EXPECT_EQ(cloud[81].column, 2);
  EXPECT_EQ(cloud[81].row, 2);
  EXPECT_EQ(cloud[81].intensity, walk().frames[0].image.at<unsigned char>(2, 2));
  const cv::Mat residual = odometry.residualImage();
  ASSERT_EQ(residual.size(), cv::Size(80, 60));
  cv::Scalar mean;
  cv::Scalar deviation;
  cv::meanStdDev(residual, mean, deviation);
  EXPECT_NEAR(mean[0], 128.0, 2.0);
  EXPECT_LT(deviation[0], 4.0);
}

bool isSame(const TrackingResult& a, const TrackingResult& b) {
  return a.T_odom_camera.matrix() == b.T_odom_camera.matrix() && a.covariance == b.covariance &&
         a.velocity == b.velocity && a.state == b.state && a.keyframes == b.keyframes &&
         a.mutual_information == b.mutual_information && a.residual_scale == b.residual_scale;
}

TEST(OdometryTest, TheSameInputGivesTheSameBitsForAnyNumberOfThreads) {
  // All pixels are points, so that several threads get chunks.
  Parameters parameters;
  parameters.points.point_fraction = 1.0;
  parameters.points.min_gradient = 0.0;
  const std::vector<Frame> frames(walk().frames.begin(), walk().frames.begin() + 6);
  Odometry first(walk().camera, parameters);
  const std::vector<TrackingResult> expected = run(first, frames);
  for (const int threads : {1, 2, 4}) {
    parameters.alignment.threads = threads;
    Odometry odometry(walk().camera, parameters);
    const std::vector<TrackingResult> results = run(odometry, frames);
    for (std::size_t i = 0; i < results.size(); ++i) {
      EXPECT_TRUE(isSame(results[i], expected[i])) << threads << " threads, frame " << i;
    }
  }
}

}  // namespace
}  // namespace mivo
