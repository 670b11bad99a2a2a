// SPDX-License-Identifier: BSD-3-Clause
#include "core/alignment/align.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <opencv2/core.hpp>

#include "core/alignment/pose_covariance.h"
#include "support/random_pose.h"
#include "support/scene.h"

namespace mivo {
namespace {

using testing::Light;
using testing::Random;

const Method kMethods[] = {Method::kSsd, Method::kMi, Method::kHybrid};

/// The method of the paper: intensities as they are, no depth term.
Parameters paperParameters(Method method) {
  Parameters parameters;
  parameters.alignment.method = method;
  parameters.alignment.photometric_model = PhotometricModel::kNone;
  parameters.geometry.geometric_term = false;
  return parameters;
}

/// Two frames of a room, half a degree and a few centimeters apart.
class AlignTest : public ::testing::Test {
 protected:
  Alignment run(const Parameters& parameters, const Eigen::Isometry3d& T_live_ref_start,
                bool backwards = false) const {
    const Frame& reference_frame = backwards ? live_ : reference_;
    const Frame& live_frame = backwards ? reference_ : live_;
    FramePyramid reference;
    reference.build(reference_frame, parameters);
    FramePyramid live;
    live.build(live_frame, parameters);
    Keyframe keyframe;
    keyframe.build(reference, camera_, Vector6::Zero(), {}, parameters);
    return align(taskFrom(keyframe, live, T_live_ref_start), parameters);
  }

  /// A camera at rest before and after.
  AlignmentTask taskFrom(const Keyframe& keyframe, const FramePyramid& live,
                         const Eigen::Isometry3d& T_live_ref_start) const {
    AlignmentTask task{keyframe, live, camera_};
    task.T_live_ref = T_live_ref_start;
    task.motion.T_previous_ref = T_live_ref_start;
    return task;
  }

  /// Translation error in m and rotation error in rad.
  static Eigen::Vector2d errorOf(const Eigen::Isometry3d& T, const Eigen::Isometry3d& truth) {
    const Vector6 d = localCoordinates(T * truth.inverse());
    return {d.head<3>().norm(), d.tail<3>().norm()};
  }

  void expectClose(const Alignment& alignment, const Eigen::Isometry3d& truth, double translation,
                   double rotation) const {
    const Eigen::Vector2d error = errorOf(alignment.T_live_ref, truth);
    EXPECT_LT(error[0], translation);
    EXPECT_LT(error[1], rotation);
    EXPECT_TRUE(alignment.sees_image);
  }

  void relight(const Light& light) {
    live_ = testing::render(testing::roomScene(), camera_, T_world_live_, light);
  }

  Camera camera_ = testing::smallCamera();
  Eigen::Isometry3d T_world_ref_ = Random(1).pose(0.2, 0.1);
  Eigen::Isometry3d T_world_live_ = T_world_ref_ * Random(2).pose(0.03, 0.02);
  Eigen::Isometry3d truth_ = T_world_live_.inverse() * T_world_ref_;
  Frame reference_ = testing::render(testing::roomScene(), camera_, T_world_ref_);
  Frame live_ = testing::render(testing::roomScene(), camera_, T_world_live_);
};

// At this size a tenth of a pixel is 2 mm at 2 m; the maximum of mutual information is flatter.
double translationTolerance(Method method) {
  return method == Method::kMi ? 0.006 : 0.003;
}
double rotationTolerance(Method method) {
  return method == Method::kMi ? 0.003 : 0.0015;
}

TEST_F(AlignTest, KnownMotionIsRecoveredFromDisturbedStarts) {
  struct Disturbance {
    double translation;
    double rotation;
  };
  Random random(3);
  for (const PhotometricModel model : {PhotometricModel::kNone, PhotometricModel::kLcn}) {
    for (const Method method : kMethods) {
      Parameters parameters = paperParameters(method);
      parameters.alignment.photometric_model = model;
      parameters.geometry.geometric_term = model == PhotometricModel::kLcn;
      for (const Disturbance& disturbance :
           {Disturbance{0.0, 0.0}, {0.05, 0.0}, {0.0, 0.03}, {0.04, 0.02}}) {
        SCOPED_TRACE(::testing::Message()
                     << "method " << static_cast<int>(method) << " model "
                     << static_cast<int>(model) << " start off by " << disturbance.translation
                     << " m " << disturbance.rotation << " rad");
        const Eigen::Isometry3d start =
            random.pose(disturbance.translation, disturbance.rotation) * truth_;
        expectClose(run(parameters, start), truth_, translationTolerance(method),
                    rotationTolerance(method));
      }
    }
  }
}

TEST_F(AlignTest, TheInverseMotionIsRecoveredToo) {
  for (const Method method : kMethods) {
    SCOPED_TRACE(static_cast<int>(method));
    const Alignment alignment = run(paperParameters(method), Eigen::Isometry3d::Identity(), true);
    expectClose(alignment, truth_.inverse(), translationTolerance(method),
                rotationTolerance(method));
  }
}

// With interpolation windows, mutual information is stationary at self-alignment only on average
// over the points.
TEST_F(AlignTest, AFrameAlignedWithItselfDoesNotMove) {
  live_ = reference_;
  for (const Method method : kMethods) {
    SCOPED_TRACE(static_cast<int>(method));
    const bool is_mi = method == Method::kMi;
    const Alignment alignment = run(paperParameters(method), Random(4).pose(0.01, 0.01));
    expectClose(alignment, Eigen::Isometry3d::Identity(), is_mi ? 2e-3 : 2e-4, is_mi ? 1e-3 : 1e-4);
  }
}

TEST_F(AlignTest, LevelsUseTheCostThatTheMethodSays) {
  Parameters parameters = paperParameters(Method::kHybrid);
  parameters.alignment.switch_level = 2;
  const Alignment alignment = run(parameters, Eigen::Isometry3d::Identity());
  ASSERT_EQ(alignment.num_levels, 4);  // 160 x 120 to 20 x 15
  for (int i = 0; i < alignment.num_levels; ++i) {
    const LevelRecord& record = alignment.levels[static_cast<std::size_t>(i)];
    EXPECT_EQ(record.level, 3 - i);
    EXPECT_EQ(record.mutual_information, record.level >= 2);
    EXPECT_GT(record.points, 100);
    EXPECT_GT(record.visible, record.points / 2);
    EXPECT_LE(record.visible, record.points);
    EXPECT_GE(record.evaluations, std::max(1, record.iterations));
  }
  EXPECT_GT(alignment.mutual_information, 0.0);
  EXPECT_GT(alignment.residual_scale, 0.0);
  EXPECT_GT(alignment.overlap, 0.5);
  EXPECT_EQ(alignment.points, alignment.levels[3].visible);
  EXPECT_EQ(run(paperParameters(Method::kSsd), truth_).mutual_information, 0.0);
  EXPECT_EQ(run(paperParameters(Method::kMi), truth_).residual_scale, 0.0);
}

TEST_F(AlignTest, ALevelWithTooFewPointsIsPassedOver) {
  for (const Method method : kMethods) {
    SCOPED_TRACE(static_cast<int>(method));
    Parameters parameters = paperParameters(method);
    parameters.loss.lost_points = 400;  // the coarsest level has 18 x 13 pixels
    const Alignment alignment = run(parameters, Eigen::Isometry3d::Identity());
    EXPECT_EQ(alignment.levels[0].iterations, 0);
    EXPECT_GT(alignment.levels[0].points, 0);
    expectClose(alignment, truth_, translationTolerance(method), rotationTolerance(method));
  }
}

TEST_F(AlignTest, AnotherLightIsNoMatterToMutualInformationButToSsd) {
  Light bright;
  bright.gain = 0.5;
  bright.offset = 0.35;
  relight(bright);
  const Eigen::Isometry3d start = Random(5).pose(0.02, 0.01) * truth_;
  expectClose(run(paperParameters(Method::kMi), start), truth_, 0.006, 0.003);
  const Alignment ssd = run(paperParameters(Method::kSsd), start);
  EXPECT_GT(errorOf(ssd.T_live_ref, truth_)[0], 0.02);
}

TEST_F(AlignTest, ACurvedResponseIsNoMatterToMutualInformation) {
  Light dark;
  dark.gain = 0.5;
  dark.gamma = 2.0;
  relight(dark);
  const Eigen::Isometry3d start = Random(6).pose(0.02, 0.01) * truth_;
  expectClose(run(paperParameters(Method::kMi), start), truth_, 0.008, 0.004);
}

TEST_F(AlignTest, NormalizedContrastStandsLightThatChangesAndMoves) {
  Light lamp;
  lamp.gain = 0.45;
  lamp.spot = 0.35;
  lamp.spot_center = {50.0, 40.0};
  lamp.spot_radius = 35.0;
  relight(lamp);
  const Eigen::Isometry3d start = Random(7).pose(0.02, 0.01) * truth_;
  for (const Method method : kMethods) {
    SCOPED_TRACE(static_cast<int>(method));
    Parameters parameters = paperParameters(method);
    parameters.alignment.photometric_model = PhotometricModel::kLcn;
    expectClose(run(parameters, start), truth_, 0.008, 0.004);
  }
}

TEST_F(AlignTest, ANegativeIsAlignedWhereThatIsAskedFor) {
  const Frame positive = live_;
  live_.image = 255 - positive.image;
  const Eigen::Isometry3d start = Random(7).pose(0.02, 0.01) * truth_;
  Parameters parameters = paperParameters(Method::kHybrid);
  parameters.alignment.photometric_model = PhotometricModel::kLcn;
  EXPECT_FALSE(run(parameters, start).sees_image);
  parameters.ssd.negative_images = true;
  const Alignment alignment = run(parameters, start);
  expectClose(alignment, truth_, translationTolerance(Method::kHybrid),
              rotationTolerance(Method::kHybrid));
  EXPECT_GT(alignment.correlation, parameters.loss.retry_correlation);
}

// No texture, only depth: a corner of the room, whose three walls constrain all six directions.
TEST_F(AlignTest, DepthAloneFindsTheWayInTheDark) {
  const Eigen::Isometry3d into_corner =
      retract((Vector6() << 0.3, 0.2, -0.3, 0.0, 0.7, 0.0).finished()) *
      retract((Vector6() << 0.0, 0.0, 0.0, -0.5, 0.0, 0.0).finished());
  reference_ = testing::render(testing::roomScene(), camera_, into_corner);
  live_ = testing::render(testing::roomScene(), camera_, into_corner * truth_.inverse());
  live_.image.setTo(3);
  Parameters parameters;
  const Eigen::Isometry3d start = Random(8).pose(0.02, 0.01) * truth_;
  const Alignment alignment = run(parameters, start);
  EXPECT_FALSE(alignment.sees_image);
  EXPECT_TRUE(alignment.sees_depth);
  EXPECT_LT(errorOf(alignment.T_live_ref, truth_)[0], 0.004);
  EXPECT_LT(errorOf(alignment.T_live_ref, truth_)[1], 0.003);
  parameters.geometry.geometric_term = false;
  const Alignment blind = run(parameters, start);
  EXPECT_FALSE(blind.sees_depth);
  EXPECT_FALSE(blind.sees_image);
}

// A wall without texture: depth constrains distance and inclination, the prior the position along
// it.
TEST_F(AlignTest, AlongAWallInTheDarkTheCameraKeepsItsVelocity) {
  reference_ = testing::render(testing::wallScene(), camera_, Eigen::Isometry3d::Identity());
  const Vector6 motion = (Vector6() << 0.02, -0.01, 0.015, 0.004, -0.006, 0.01).finished();
  const Eigen::Isometry3d truth = retract(motion).inverse();
  live_ = testing::render(testing::wallScene(), camera_, retract(motion));
  live_.image.setTo(3);
  Parameters parameters;
  FramePyramid reference;
  reference.build(reference_, parameters);
  FramePyramid live;
  live.build(live_, parameters);
  Keyframe keyframe;
  keyframe.build(reference, camera_, Vector6::Zero(), {}, parameters);
  // The prediction is off by 1 mm along the wall and by 5 mm towards it.
  const Eigen::Isometry3d predicted =
      retract((Vector6() << 0.001, 0.0, 0.005, 0.0, 0.0, 0.0).finished()) * truth;
  AlignmentTask task = taskFrom(keyframe, live, predicted);
  task.expected.is_known = true;
  task.expected.T_live_ref = predicted;
  task.expected.covariance = diagonalCovariance(0.002, 0.03);
  const Alignment alignment = align(task, parameters);
  ASSERT_TRUE(alignment.sees_depth);
  const Eigen::Vector3d error = (alignment.T_live_ref * truth.inverse()).translation();
  EXPECT_NEAR(error.x(), 0.001, 5e-4);
  EXPECT_NEAR(error.y(), 0.0, 5e-4);
  EXPECT_NEAR(error.z(), 0.0, 1e-3);
  // The covariance along the wall is that of the prior.
  EXPECT_GT(alignment.covariance(0, 0), 0.5 * 0.002 * 0.002);
  EXPECT_LT(alignment.covariance(2, 2), 0.25 * 0.002 * 0.002);
}

// The keyframe has no texture either, but earlier frames had: the pose must not change.
TEST_F(AlignTest, WhetherAViewIsDarkDependsOnTheLastThatWasNot) {
  reference_.image /= 10;
  live_.image /= 10;
  Parameters parameters;
  FramePyramid reference;
  reference.build(reference_, parameters);
  FramePyramid live;
  live.build(live_, parameters);
  Keyframe keyframe;
  keyframe.build(reference, camera_, Vector6::Zero(), {}, parameters);
  AlignmentTask task = taskFrom(keyframe, live, truth_);
  EXPECT_FALSE(align(task, parameters).isDepthOnly());
  task.last_lit_contrast = 40.0;
  const Alignment dark = align(task, parameters);
  EXPECT_TRUE(dark.is_keyframe_dark);
  EXPECT_TRUE(dark.is_live_dark);
}

TEST_F(AlignTest, AnUnrelatedViewIsSeenToBeOne) {
  live_ = testing::render(testing::roomScene(), camera_,
                          T_world_ref_ * retract((Vector6() << 0, 0, 0, 0, 3.0, 0).finished()));
  for (const Method method : kMethods) {
    SCOPED_TRACE(static_cast<int>(method));
    EXPECT_FALSE(run(paperParameters(method), Eigen::Isometry3d::Identity()).sees_image);
  }
}

// The camera turns by 4 degrees per frame, and its read-out takes 0.6 of the period. Modeling the
// rolling shutter removes the additional error.
TEST_F(AlignTest, RowsReadOneAfterTheOtherAreAllowedFor) {
  constexpr double kReadout = 0.6;
  for (const double turn : {0.09, -0.09}) {
    const Vector6 step = (Vector6() << 0.01, 0.0, 0.0, 0.0, turn, 0.0).finished();
    const Eigen::Isometry3d truth = retract(step).inverse();
    const auto errorWith = [&](double real, double assumed) -> Vector6 {
      Parameters parameters;
      parameters.alignment.min_step_pixels = 0.001;  // tests the model, not the convergence
      parameters.alignment.trusted_step_pixels = 0.0;
      parameters.alignment.min_cost_change = 0.0;
      FramePyramid reference;
      reference.build(
          testing::renderRolling(testing::roomScene(), camera_, T_world_ref_, real * step),
          parameters);
      FramePyramid live;
      live.build(testing::renderRolling(testing::roomScene(), camera_, T_world_ref_ * retract(step),
                                        real * step),
                 parameters);
      Keyframe keyframe;
      keyframe.build(reference, camera_, localCoordinates(truth), {assumed, 0.0}, parameters);
      AlignmentTask task = taskFrom(keyframe, live, truth);
      task.motion.T_previous_ref.setIdentity();
      task.shutter.readout = assumed;
      return localCoordinates(align(task, parameters).T_live_ref * truth.inverse());
    };
    const Vector6 global = errorWith(0.0, 0.0);
    const Vector6 ignored = errorWith(kReadout, 0.0);
    const Vector6 modeled = errorWith(kReadout, kReadout);
    EXPECT_GT((ignored - global).norm(), 1e-3);
    EXPECT_LT((modeled - global).norm(), 0.5 * (ignored - global).norm());
    EXPECT_LT(modeled.norm(), 0.003);
  }
}

}  // namespace
}  // namespace mivo
