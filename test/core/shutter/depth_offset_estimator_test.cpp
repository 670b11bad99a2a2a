// SPDX-License-Identifier: BSD-3-Clause
#include "core/shutter/depth_offset_estimator.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/alignment/align.h"
#include "core/terms/geometric_term.h"
#include "support/random_pose.h"
#include "support/scene.h"

namespace mivo {
namespace {

using testing::Random;

/// A view into a corner of the room: three walls constrain all six directions.
const Eigen::Isometry3d kIntoCorner =
    retract((Vector6() << 0.3, 0.2, -0.3, 0.0, 0.7, 0.0).finished()) *
    retract((Vector6() << 0.0, 0.0, 0.0, -0.5, 0.0, 0.0).finished());

/// Motion of the scene in the camera's axes when the camera moves by a step.
Vector6 sceneTwist(const Vector6& step) {
  return localCoordinates(retract(step).inverse());
}

/// A camera that moves by steps a and b per frame period at two frames, with depth taken `offset`
/// periods after color.
class DepthOffsetTest : public ::testing::Test {
 protected:
  Frame film(const Eigen::Isometry3d& T_world_camera, const Vector6& step, double offset) const {
    Frame frame = testing::render(scene_, camera_, T_world_camera);
    frame.depth = testing::render(scene_, camera_, T_world_camera * retract(offset * step)).depth;
    return frame;
  }

  /// The measurement from the pair, with `assumed` as the offset in use.
  DepthOffsetMeasurement measure(double offset, double assumed) const {
    Parameters parameters;
    parameters.shutter.depth_time_offset_estimation = true;
    FramePyramid reference;
    reference.build(film(kIntoCorner, before_, offset), parameters);
    FramePyramid live;
    live.build(film(kIntoCorner * T_live_ref_.inverse(), after_, offset), parameters);
    Keyframe keyframe;
    keyframe.build(reference, camera_, sceneTwist(before_), {0.0, assumed}, parameters);
    const AlignmentTask task{
        keyframe, live, camera_, T_live_ref_, {retract(after_) * T_live_ref_, 1.0}, {0.0, assumed}};
    return align(task, parameters).depth_offset;
  }

  Camera camera_ = testing::smallCamera();
  testing::Scene scene_ = testing::roomScene();
  Vector6 before_ = (Vector6() << 0.01, 0.0, 0.005, 0.0, 0.03, 0.02).finished();
  Vector6 after_ = (Vector6() << -0.01, 0.01, 0.0, 0.02, -0.04, 0.0).finished();
  Eigen::Isometry3d T_live_ref_ =
      retract((Vector6() << 0.01, -0.01, 0.02, 0.01, 0.02, -0.01).finished());
};

// At the edge between two walls a reading may jump from one to the other, which the gradient does
// not describe: hence the wide step and the tolerance.
TEST_F(DepthOffsetTest, TheGradientIsThatOfTheGeometricTerm) {
  constexpr double kStep = 0.04;
  for (const double offset : {0.0, 0.3}) {
    const Parameters parameters;
    const Frame reference = film(kIntoCorner, before_, offset);
    FramePyramid live;
    live.build(film(kIntoCorner * T_live_ref_.inverse(), after_, offset), parameters);
    for (const std::uint64_t seed : {1, 2, 3}) {
      // Not at the minimum, where the gradient is zero.
      const Eigen::Isometry3d pose = T_live_ref_ * Random(seed).pose(0.004, 0.002);
      const auto modelAt = [&](double assumed) {
        GeometricPoints points;
        makeGeometricPoints(reference.depth, camera_, {sceneTwist(before_), 0.0, assumed}, 5000,
                            5000, points);
        const Warp warp(camera_, {sceneTwist(after_), 0.0, assumed}, 1);
        GeometricTerm term(points, 5000, live, warp, parameters);
        term.evaluate(pose);
        EXPECT_EQ(term.scale(), 1.0) << "costs of different scales cannot be compared";
        return term.linearize(0);
      };
      const double numeric =
          (modelAt(offset + kStep).cost - modelAt(offset - kStep).cost) / (2.0 * kStep);
      const RowVelocities velocities{sceneTwist(after_), sceneTwist(before_), pose};
      EXPECT_GT(std::abs(numeric), 100.0);
      EXPECT_NEAR(depthOffsetGradient(modelAt(offset), velocities) / numeric, 1.0, 0.15)
          << "offset " << offset << ", seed " << seed;
    }
  }
}

TEST_F(DepthOffsetTest, APairOfFramesTellsItWithItsSign) {
  for (const double offset : {-0.3, -0.2, 0.0, 0.2, 0.3}) {
    const DepthOffsetMeasurement measurement = measure(offset, 0.0);
    EXPECT_NEAR(measurement.correction, offset, 0.1) << offset;  // to first order
    EXPECT_GT(measurement.information, 100.0) << offset;
  }
}

TEST_F(DepthOffsetTest, OfTheRightOneNothingIsLeft) {
  for (const double offset : {-0.3, 0.3}) {
    EXPECT_NEAR(measure(offset, offset).correction, 0.0, 0.04) << offset;
  }
}

TEST_F(DepthOffsetTest, ASteadyMotionSaysNothing) {
  after_ = before_;
  T_live_ref_ = retract(before_).inverse();
  EXPECT_LT(measure(0.3, 0.0).information, 1.0);
}

class DepthOffsetEstimatorTest : public ::testing::Test {
 protected:
  /// A keyframe all of whose frames measure the same correction.
  void keyframe(double correction, double information = 80.0) {
    for (int i = 0; i < 4; ++i) estimator_.add({correction, information});
    estimator_.endKeyframe();
  }

  DepthOffsetEstimator estimator_;
};

TEST_F(DepthOffsetEstimatorTest, WithoutAnOffsetItStaysZero) {
  Random random(1);
  for (int i = 0; i < 500; ++i) {
    keyframe(random.uniform(-0.4, 0.4));
    ASSERT_EQ(estimator_.offset(), 0.0) << i;
  }
}

TEST_F(DepthOffsetEstimatorTest, LittleIsNotToldFromNone) {
  for (int i = 0; i < 50; ++i) keyframe(0.08);
  EXPECT_EQ(estimator_.offset(), 0.0);
}

TEST_F(DepthOffsetEstimatorTest, FewKeyframesAreNotEnough) {
  keyframe(1.0);
  keyframe(1.0);
  EXPECT_EQ(estimator_.offset(), 0.0);
}

TEST_F(DepthOffsetEstimatorTest, KeyframesWithoutInformationDoNotCount) {
  for (int i = 0; i < 50; ++i) keyframe(0.3, 1.0);
  EXPECT_EQ(estimator_.offset(), 0.0);
}

TEST_F(DepthOffsetEstimatorTest, ItSettlesAtTheTruth) {
  for (const double truth : {-0.6, -0.2, 0.3, 0.8}) {
    estimator_ = DepthOffsetEstimator();
    Random random(2);
    for (int i = 0; i < 40; ++i) {
      keyframe(truth - estimator_.offset() + random.uniform(-0.1, 0.1));
    }
    EXPECT_NEAR(estimator_.offset(), truth, 0.04);
  }
}

TEST_F(DepthOffsetEstimatorTest, ItChangesInSmallStepsAndOnlyWithAKeyframe) {
  double last = 0.0;
  for (int i = 0; i < 20; ++i) {
    for (int frame = 0; frame < 4; ++frame) {
      estimator_.add({0.5 - last, 80.0});
      EXPECT_EQ(estimator_.offset(), last);
    }
    estimator_.endKeyframe();
    EXPECT_LE(std::abs(estimator_.offset() - last), 0.1 + 1e-12);
    last = estimator_.offset();
  }
  EXPECT_NEAR(last, 0.5, 0.01);
}

TEST_F(DepthOffsetEstimatorTest, WhatLaterKeyframesContradictIsGivenUp) {
  for (int i = 0; i < 5; ++i) keyframe(0.3 - estimator_.offset());
  ASSERT_GT(estimator_.offset(), 0.1);
  for (int i = 0; i < 30; ++i) keyframe(-estimator_.offset());
  EXPECT_EQ(estimator_.offset(), 0.0);
}

TEST_F(DepthOffsetEstimatorTest, ItStaysWithinAPeriod) {
  for (int i = 0; i < 60; ++i) keyframe(0.9);
  EXPECT_LE(estimator_.offset(), 1.0);
  for (int i = 0; i < 120; ++i) keyframe(-0.9);
  EXPECT_GE(estimator_.offset(), -1.0);
}

}  // namespace
}  // namespace mivo
