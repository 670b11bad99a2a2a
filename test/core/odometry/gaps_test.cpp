// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "mivo/core/odometry.h"
#include "support/camera_path.h"

// Poses are extrapolated for at most half a second of the velocity: after a gap, and
// while parameters change with the lens covered.

namespace mivo {
namespace {

using testing::kFramePeriod;

constexpr double kSpeed = 0.25;   // m/s, to the right
constexpr double kHorizon = 0.5;  // s
constexpr int kMoving = 8;        // frames

double distance(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
  return (a.inverse() * b).translation().norm();
}

Frame stamped(Frame frame, double stamp) {
  frame.stamp = stamp;
  return frame;
}

Eigen::Isometry3d poseAt(int i) {
  return retract(kSpeed * kFramePeriod * i * Vector6::Unit(0));
}

/// The frames of the path, rendered once.
const Frame& view(int i) {
  static const std::vector<Frame> frames = [] {
    std::vector<Frame> rendered;
    for (int k = 0; k < kMoving; ++k) {
      rendered.push_back(testing::render(testing::boardScene(), testing::smallCamera(), poseAt(k)));
    }
    return rendered;
  }();
  return frames[static_cast<std::size_t>(i)];
}

const Frame& anotherPlace() {
  static const Frame frame =
      testing::render(testing::roomScene(), testing::smallCamera(),
                      retract((Vector6() << 0.0, 0.0, 0.4, 0.1, 2.9, 0.2).finished()));
  return frame;
}

Frame coveredLens() {
  Frame frame = view(0);
  frame.image = cv::Mat(frame.image.size(), CV_8UC1, cv::Scalar(2));
  frame.depth = cv::Mat::zeros(frame.depth.size(), CV_32FC1);
  return frame;
}

/// An odometry that has tracked the camera along the path.
class Traveled {
 public:
  Traveled() : odometry(testing::smallCamera(), {}) {
    for (int i = 0; i < kMoving; ++i) odometry.process(stamped(view(i), stamp += kFramePeriod));
    last = odometry.result();
  }

  /// After a gap of this length, the next pose must be within the extrapolation of the motion
  /// model.
  const TrackingResult& process(const Frame& frame, double seconds) {
    const TrackingResult& result = odometry.process(stamped(frame, stamp += seconds));
    EXPECT_LE(distance(result.T_odom_camera, last.T_odom_camera), most()) << stamp;
    EXPECT_LE(distance(odometry.predictedPose(stamp + seconds), last.T_odom_camera), 2.0 * most())
        << stamp;
    return result;
  }

  /// The distance at the camera's velocity, plus a millimeter.
  double most() const { return kHorizon * kSpeed + 1e-3; }

  double stamp = 10.0;
  Odometry odometry;
  TrackingResult last;  // of the last frame before the gap
};

class GapsTest : public ::testing::TestWithParam<double> {};

TEST_P(GapsTest, AfterAGapAnotherPlaceIsNoPoseFarAway) {
  Traveled camera;
  ASSERT_EQ(camera.last.state, TrackingState::kTracking);
  ASSERT_NEAR(camera.last.velocity[0], kSpeed, 0.05);
  EXPECT_EQ(camera.process(anotherPlace(), GetParam()).state, TrackingState::kLost);
  const int lost_frames = camera.odometry.parameters().loss.lost_frames;
  for (int i = 0; i < lost_frames + 2; ++i) camera.process(anotherPlace(), kFramePeriod);
  // The new segment begins there, and the camera does not move in it.
  EXPECT_EQ(camera.odometry.result().segment, 1);
  EXPECT_EQ(camera.odometry.result().state, TrackingState::kTracking);
}

TEST_P(GapsTest, AfterAGapTheSamePlaceIsFound) {
  Traveled camera;
  const TrackingResult& result = camera.process(view(kMoving - 1), GetParam());
  EXPECT_EQ(result.state, TrackingState::kTracking);
  EXPECT_EQ(result.segment, 0);
  EXPECT_LT(distance(result.T_odom_camera, poseAt(kMoving - 1)), 0.01);
  // The gap has no effect on later frames.
  EXPECT_LT(
      distance(camera.process(view(kMoving - 1), kFramePeriod).T_odom_camera, poseAt(kMoving - 1)),
      0.01);
}

INSTANTIATE_TEST_SUITE_P(Seconds, GapsTest, ::testing::Values(0.5, 2.0, 10.0, 60.0, 600.0));

TEST(LostAfterAGapTest, TheLongerTheGapTheLessIsKnown) {
  double before = 0.0;
  for (const double gap : {kFramePeriod, 0.5, 2.0, 10.0, 60.0, 600.0}) {
    Traveled camera;
    const double sigma = std::sqrt(camera.process(anotherPlace(), gap).covariance(0, 0));
    EXPECT_GT(sigma, before) << gap;
    EXPECT_GT(sigma, 0.5 * kSpeed * gap) << gap;
    before = sigma;
  }
}

struct Change {
  const char* name;
  std::function<void(Parameters&)> apply;
};

class CoveredLensTest : public ::testing::TestWithParam<Change> {};

// Keyframes of the old parameters cannot be used, but a new one must not be created at a wrong
// pose.
TEST_P(CoveredLensTest, ParametersThatChangeBehindItMoveNothing) {
  Traveled camera;
  const int keyframes = camera.odometry.result().keyframes;
  for (int i = 0; i < 10; ++i) camera.process(coveredLens(), kFramePeriod);
  Parameters parameters = camera.odometry.parameters();
  GetParam().apply(parameters);
  camera.odometry.setParameters(parameters);
  for (int i = 0; i < 60; ++i) {
    const TrackingResult& result = camera.process(coveredLens(), kFramePeriod);
    EXPECT_EQ(result.state, TrackingState::kLost) << i;
    EXPECT_EQ(result.segment, 0) << i;
    EXPECT_EQ(result.keyframes, keyframes) << i;
  }
  for (int i = 0; i < 3; ++i) {
    const TrackingResult& result = camera.process(view(kMoving - 1), kFramePeriod);
    EXPECT_EQ(result.state, TrackingState::kTracking) << i;
    EXPECT_EQ(result.segment, 0) << i;
    EXPECT_LT(distance(result.T_odom_camera, poseAt(kMoving - 1)), 0.01) << i;
  }
  // The change is in effect.
  EXPECT_GT(camera.odometry.result().keyframes, keyframes);
}

TEST_P(CoveredLensTest, AnotherPlaceAfterwardsIsAnotherSegment) {
  Traveled camera;
  camera.process(coveredLens(), kFramePeriod);
  Parameters parameters = camera.odometry.parameters();
  GetParam().apply(parameters);
  camera.odometry.setParameters(parameters);
  for (int i = 0; i < 20; ++i) camera.process(coveredLens(), kFramePeriod);
  for (int i = 0; i < 4 * parameters.loss.lost_frames; ++i) {
    const TrackingResult& result = camera.process(anotherPlace(), kFramePeriod);
    EXPECT_EQ(result.isMeasured(), result.segment == 1 && !result.new_keyframe) << i;
  }
  EXPECT_EQ(camera.odometry.result().state, TrackingState::kTracking);
  EXPECT_GT(camera.odometry.result().covariance(0, 0), 0.5);
}

std::string nameOf(const ::testing::TestParamInfo<Change>& change) {
  return change.param.name;
}

INSTANTIATE_TEST_SUITE_P(
    Parameters, CoveredLensTest,
    ::testing::Values(Change{"Bins", [](Parameters& p) { p.mi.mi_bins = 16; }},
                      Change{"Levels", [](Parameters& p) { p.alignment.levels = 3; }},
                      Change{"Photometric",
                             [](Parameters& p) {
                               p.alignment.photometric_model = PhotometricModel::kNone;
                             }},
                      Change{"MethodMi", [](Parameters& p) { p.alignment.method = Method::kMi; }},
                      Change{"MethodSsd", [](Parameters& p) { p.alignment.method = Method::kSsd; }},
                      Change{"Points", [](Parameters& p) { p.points.min_points = 800; }}),
    nameOf);

}  // namespace
}  // namespace mivo
