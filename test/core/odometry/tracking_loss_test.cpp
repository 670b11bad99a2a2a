// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <limits>
#include <opencv2/core.hpp>

#include "mivo/core/odometry.h"
#include "support/camera_path.h"
#include "support/random_pose.h"

// Odometry with frames that are unusable, broken or absurd.

namespace mivo {
namespace {

using testing::kFramePeriod;
using testing::Random;
using testing::Recording;

const Recording& walk() {
  static const Recording recording = testing::recordWalk(16);
  return recording;
}

double distance(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
  return localCoordinates(a.inverse() * b).norm();
}

Frame stamped(Frame frame, double stamp) {
  frame.stamp = stamp;
  return frame;
}

Frame coveredLens(double stamp) {
  Frame frame;
  frame.image = cv::Mat(walk().camera.height, walk().camera.width, CV_8UC1, cv::Scalar(2));
  frame.depth = cv::Mat::zeros(walk().camera.height, walk().camera.width, CV_32FC1);
  return stamped(frame, stamp);
}

/// The other side of the room.
Frame anotherPlace(double stamp) {
  const Eigen::Isometry3d behind = retract((Vector6() << 0.0, 0.0, 0.4, 0.1, 2.9, 0.2).finished());
  return stamped(testing::render(testing::roomScene(), walk().camera, behind), stamp);
}

class TrackingLossTest : public ::testing::TestWithParam<Method> {
 protected:
  TrackingLossTest() : odometry_(walk().camera, parameters()) {
    for (std::size_t i = 0; i < 4; ++i) odometry_.process(walk().frames[i]);
  }

  static Parameters parameters() {
    Parameters parameters;
    parameters.alignment.method = GetParam();
    return parameters;
  }

  void expectGuess(const TrackingResult& result) const {
    EXPECT_EQ(result.state, TrackingState::kLost);
    EXPECT_NE(result.reason, TrackingReason::kNone);
    EXPECT_GT(result.covariance(0, 0), 0.5);
    EXPECT_GT(result.covariance(5, 5), 0.5);
    EXPECT_LT(distance(result.T_odom_camera, walk().T_first_camera[4]), 0.1);
  }

  Odometry odometry_;
};

TEST_P(TrackingLossTest, ACoveredLensIsALoss) {
  const TrackingResult& result = odometry_.process(coveredLens(walk().frames[4].stamp));
  expectGuess(result);
  EXPECT_EQ(result.reason, TrackingReason::kNothingInCommon);
}

TEST_P(TrackingLossTest, AnotherPlaceIsALoss) {
  expectGuess(odometry_.process(anotherPlace(walk().frames[4].stamp)));
}

TEST_P(TrackingLossTest, AShortLossEndsWhereTheCameraIs) {
  odometry_.process(coveredLens(walk().frames[4].stamp));
  odometry_.process(coveredLens(walk().frames[5].stamp));
  const TrackingResult& result = odometry_.process(walk().frames[6]);
  EXPECT_EQ(result.state, TrackingState::kTracking);
  EXPECT_EQ(result.segment, 0);
  EXPECT_LT(distance(result.T_odom_camera, walk().T_first_camera[6]), 0.015);
}

TEST_P(TrackingLossTest, ALongLossStartsANewSegmentFromTheBestGuess) {
  const int lost_frames = odometry_.parameters().loss.lost_frames;
  double stamp = walk().frames[3].stamp;
  for (int i = 0; i < lost_frames; ++i) {
    EXPECT_EQ(odometry_.result().segment, 0);
    odometry_.process(anotherPlace(stamp += kFramePeriod));
  }
  EXPECT_EQ(odometry_.result().segment, 1);
  EXPECT_TRUE(odometry_.result().new_keyframe);
  const Eigen::Isometry3d guess = odometry_.result().T_odom_camera;
  EXPECT_LT(distance(guess, walk().T_first_camera[3]), 0.15);
  const TrackingResult& result = odometry_.process(anotherPlace(stamp + kFramePeriod));
  EXPECT_EQ(result.state, TrackingState::kTracking);
  EXPECT_EQ(result.segment, 1);
  EXPECT_LT(distance(result.T_odom_camera, guess), 1e-3);
}

TEST_P(TrackingLossTest, BackInAKnownPlaceTheCameraIsBackInItsSegment) {
  double stamp = walk().frames[3].stamp;
  for (int i = 0; i < odometry_.parameters().loss.lost_frames + 2; ++i) {
    odometry_.process(anotherPlace(stamp += kFramePeriod));
  }
  ASSERT_EQ(odometry_.result().segment, 1);
  for (int i = 0; i < 3; ++i) odometry_.process(stamped(walk().frames[2], stamp += kFramePeriod));
  const TrackingResult& result = odometry_.result();
  EXPECT_EQ(result.state, TrackingState::kTracking);
  EXPECT_EQ(result.segment, 0);
  EXPECT_LT(distance(result.T_odom_camera, walk().T_first_camera[2]), 0.015);
  EXPECT_LT(result.covariance(0, 0), 0.01);
}

TEST_P(TrackingLossTest, ANewSegmentKnowsThatItsPoseIsAGuess) {
  double stamp = walk().frames[3].stamp;
  for (int i = 0; i < odometry_.parameters().loss.lost_frames + 1; ++i) {
    odometry_.process(anotherPlace(stamp += kFramePeriod));
  }
  EXPECT_EQ(odometry_.result().state, TrackingState::kTracking);
  EXPECT_GT(odometry_.result().covariance(0, 0), 0.5);
}

TEST_P(TrackingLossTest, ADarkFrameMakesNoKeyframeHoweverLongItLasts) {
  double stamp = walk().frames[3].stamp;
  const int keyframes = odometry_.result().keyframes;
  for (int i = 0; i < 12; ++i) odometry_.process(coveredLens(stamp += kFramePeriod));
  EXPECT_EQ(odometry_.result().keyframes, keyframes);
  EXPECT_EQ(odometry_.result().state, TrackingState::kLost);
  // The camera did not move meanwhile.
  const TrackingResult& result = odometry_.process(stamped(walk().frames[3], stamp + kFramePeriod));
  EXPECT_EQ(result.state, TrackingState::kTracking);
  EXPECT_LT(distance(result.T_odom_camera, walk().T_first_camera[3]), 0.01);
}

TEST_P(TrackingLossTest, WithoutDepthInTheLiveFrameTheImageIsEnough) {
  Frame frame = walk().frames[4];
  frame.depth = cv::Mat::zeros(frame.depth.size(), CV_32FC1);
  const TrackingResult& result = odometry_.process(frame);
  EXPECT_EQ(result.state, TrackingState::kTracking);
  EXPECT_LT(distance(result.T_odom_camera, walk().T_first_camera[4]), 0.02);
}

TEST_P(TrackingLossTest, AFrameWithoutDepthIsNoFirstKeyframe) {
  Odometry odometry(walk().camera, parameters());
  Frame frame = walk().frames[0];
  frame.depth = cv::Mat::zeros(frame.depth.size(), CV_32FC1);
  const TrackingResult& result = odometry.process(frame);
  EXPECT_EQ(result.state, TrackingState::kInitializing);
  EXPECT_EQ(result.reason, TrackingReason::kTooFewPoints);
  EXPECT_FALSE(odometry.hasKeyframe());
  EXPECT_EQ(odometry.process(walk().frames[1]).state, TrackingState::kTracking);
  EXPECT_EQ(odometry.result().T_odom_camera.matrix(), Eigen::Matrix4d::Identity());
}

TEST_P(TrackingLossTest, FasterThanTheLimitsIsALoss) {
  Parameters slow = odometry_.parameters();
  slow.loss.lost_speed = 0.05;
  odometry_.setParameters(slow);
  const TrackingResult& result = odometry_.process(walk().frames[4]);
  EXPECT_EQ(result.state, TrackingState::kLost);
  EXPECT_EQ(result.reason, TrackingReason::kImplausibleMotion);
}

std::string nameOf(const ::testing::TestParamInfo<Method>& method) {
  const char* const names[] = {"Ssd", "Mi", "Hybrid"};
  return names[static_cast<int>(method.param)];
}

INSTANTIATE_TEST_SUITE_P(Methods, TrackingLossTest,
                         ::testing::Values(Method::kSsd, Method::kMi, Method::kHybrid), nameOf);

TEST(InvalidFrameTest, AFrameThatDoesNotFitChangesNothing) {
  Odometry odometry(walk().camera, {});
  Odometry undisturbed(walk().camera, {});
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t i = 0; i < 6; ++i) {
    const TrackingResult expected = undisturbed.process(walk().frames[i]);
    const TrackingResult result = odometry.process(walk().frames[i]);
    EXPECT_EQ(result.T_odom_camera.matrix(), expected.T_odom_camera.matrix());
    EXPECT_EQ(result.state, expected.state);
    const Frame good = stamped(walk().frames[i], walk().frames[i].stamp + 0.01);
    std::vector<Frame> bad(7, good);
    bad[0].stamp = nan;
    bad[1].stamp = walk().frames[i].stamp;        // not newer
    bad[2].stamp = walk().frames[i].stamp - 5.0;  // older
    bad[3].image = cv::Mat(10, 10, CV_8UC1, cv::Scalar(0));
    bad[4].image = cv::Mat();
    bad[5].depth = cv::Mat();
    bad[6].depth = cv::Mat(good.depth.size(), CV_8UC1, cv::Scalar(1));
    for (const Frame& frame : bad) {
      const TrackingResult& refused = odometry.process(frame);
      EXPECT_TRUE(refused.isRefused());
      EXPECT_EQ(refused.T_odom_camera.matrix(), result.T_odom_camera.matrix());
      EXPECT_EQ(refused.keyframes, result.keyframes);
      EXPECT_TRUE(std::isfinite(refused.stamp));
    }
  }
}

bool isFinite(const TrackingResult& result) {
  bool finite = result.T_odom_camera.matrix().allFinite() && result.covariance.allFinite() &&
                result.velocity.allFinite();
  for (const double number : {result.stamp, result.overlap, result.mutual_information,
                              result.residual_scale, result.milliseconds.total}) {
    finite = finite && std::isfinite(number);
  }
  for (const LevelRecord& record : result.levels) finite = finite && std::isfinite(record.cost);
  return finite;
}

bool isRigid(const Eigen::Isometry3d& T) {
  return (T.linear().transpose() * T.linear() - Eigen::Matrix3d::Identity()).norm() < 1e-9 &&
         T.linear().determinant() > 0.0;
}

/// Frames that no camera should deliver.
class AbsurdFrames {
 public:
  explicit AbsurdFrames(std::uint64_t seed) : random_(seed) {}

  Frame next() {
    Frame frame;
    frame.stamp = stamp_ += kFramePeriod * random_.uniform(0.001, 3.0);
    frame.image = image(static_cast<int>(random_.uniform(0.0, 8.0)));
    frame.depth = depth(static_cast<int>(random_.uniform(0.0, 7.0)));
    return frame;
  }

 private:
  template <typename Value, typename Pixel>
  cv::Mat filled(int type, const Pixel& pixel) {
    cv::Mat result(walk().camera.height, walk().camera.width, type);
    for (int y = 0; y < result.rows; ++y) {
      for (int x = 0; x < result.cols; ++x)
        result.at<Value>(y, x) = static_cast<Value>(pixel(x, y));
    }
    return result;
  }

  cv::Mat image(int kind) {
    switch (kind) {
      case 0:
        return filled<unsigned char>(CV_8UC1, [](int, int) { return 0; });
      case 1:
        return filled<unsigned char>(CV_8UC1, [](int, int) { return 255; });
      case 2: {
        const double gray = random_.uniform(0.0, 255.0);
        return filled<unsigned char>(CV_8UC1, [=](int, int) { return gray; });
      }
      case 3:
        return filled<unsigned char>(CV_8UC1,
                                     [&](int, int) { return random_.uniform(0.0, 256.0); });
      case 4:  // vanishes on the coarser levels
        return filled<unsigned char>(CV_8UC1,
                                     [](int x, int y) { return (x / 2 + y / 2) % 2 * 200; });
      case 5: {  // one bright pixel
        cv::Mat result = filled<unsigned char>(CV_8UC1, [](int, int) { return 0; });
        result.at<unsigned char>(60, 80) = 255;
        return result;
      }
      default:
        return walk().frames[static_cast<std::size_t>(random_.uniform(0.0, 16.0))].image;
    }
  }

  cv::Mat depth(int kind) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double infinity = std::numeric_limits<double>::infinity();
    switch (kind) {
      case 0:
        return filled<float>(CV_32FC1, [](int, int) { return 0.0; });
      case 1:
        return filled<float>(CV_32FC1, [=](int, int) { return nan; });
      case 2:
        return filled<float>(CV_32FC1, [&](int, int) {
          const double number = random_.uniform(0.0, 4.0);
          return number < 1.0 ? nan : number < 2.0 ? infinity : number < 2.5 ? -1.0 : number;
        });
      case 3:
        return filled<float>(CV_32FC1, [&](int, int) { return random_.uniform(0.0, 12.0); });
      case 4:
        return filled<unsigned short>(CV_16UC1,
                                      [&](int, int) { return random_.uniform(0.0, 65536.0); });
      case 5:
        return filled<float>(CV_32FC1, [](int, int) { return 1.5; });
      default:
        return walk().frames[static_cast<std::size_t>(random_.uniform(0.0, 16.0))].depth;
    }
  }

  Random random_;
  double stamp_ = 0.0;
};

TEST(AbsurdFramesTest, NoFrameMakesTheResultNotFinite) {
  for (const Method method : {Method::kSsd, Method::kMi, Method::kHybrid}) {
    Parameters parameters;
    parameters.alignment.method = method;
    parameters.loss.lost_frames = 2;
    Odometry odometry(walk().camera, parameters);
    AbsurdFrames frames(static_cast<std::uint64_t>(method) + 1);
    for (int i = 0; i < 70; ++i) {
      const TrackingResult& result = odometry.process(frames.next());
      ASSERT_TRUE(isFinite(result)) << "method " << static_cast<int>(method) << " frame " << i;
      ASSERT_TRUE(isRigid(result.T_odom_camera)) << i;
      const Eigen::SelfAdjointEigenSolver<Matrix6> solver(result.covariance);
      ASSERT_GT(solver.eigenvalues().minCoeff(), 0.0) << i;
      ASSERT_TRUE(odometry.predictedPose(result.stamp + 1.0).matrix().allFinite());
    }
    // Afterwards a sequence is tracked again.
    const double stamp = odometry.result().stamp;
    odometry.reset();
    for (std::size_t i = 0; i < 5; ++i) {
      odometry.process(stamped(walk().frames[i], stamp + kFramePeriod * static_cast<double>(i)));
    }
    EXPECT_EQ(odometry.result().state, TrackingState::kTracking);
    // The maximum of mutual information is flat.
    EXPECT_LT(distance(odometry.result().T_odom_camera, walk().T_first_camera[4]), 0.02);
  }
}

TEST(AbsurdFramesTest, TinyAndOddCamerasWork) {
  for (const cv::Size& size : {cv::Size(1, 1), cv::Size(3, 2), cv::Size(5, 5), cv::Size(33, 17)}) {
    Camera camera = walk().camera;
    camera.width = size.width;
    camera.height = size.height;
    camera.fx = camera.fy = size.width;  // a wide view, as any camera's
    camera.cx = 0.5 * (size.width - 1);
    camera.cy = 0.5 * (size.height - 1);
    Odometry odometry(camera, {});
    Frame frame;
    frame.image = cv::Mat(size, CV_8UC1);
    frame.depth = cv::Mat(size, CV_32FC1, cv::Scalar(1.0F));
    for (int i = 0; i < 4; ++i) {
      cv::randu(frame.image, 0, 256);
      frame.stamp = i;
      EXPECT_TRUE(isFinite(odometry.process(frame))) << size.width;
    }
  }
}

}  // namespace
}  // namespace mivo
