// SPDX-License-Identifier: BSD-3-Clause
#include "core/keyframe/keyframe_policy.h"

#include <gtest/gtest.h>

#include "support/scene.h"

namespace mivo {
namespace {

/// A keyframe of a wall 2 m away, and an alignment with it that needs no new one.
class KeyframePolicyTest : public ::testing::Test {
 protected:
  KeyframePolicyTest() {
    const Camera camera = testing::smallCamera();
    FramePyramid pyramid;
    pyramid.build(testing::render(testing::wallScene(), camera, Eigen::Isometry3d::Identity()),
                  parameters_);
    keyframe_.build(pyramid, camera, Vector6::Zero(), {}, parameters_);
    alignment_.overlap = 0.95;
    alignment_.mutual_information = 0.9;
    alignment_.residual_scale = 2.0;
  }

  bool isNeeded() const { return needsNewKeyframe(alignment_, keyframe_, first_, parameters_); }

  Parameters parameters_;
  Keyframe keyframe_;
  Alignment alignment_;
  KeyframeQuality first_{1.0, 2.0};
};

TEST_F(KeyframePolicyTest, AFrameCloseToTheKeyframeIsNone) {
  ASSERT_NEAR(keyframe_.medianDepth(), 2.0, 1e-6);
  EXPECT_FALSE(isNeeded());
}

TEST_F(KeyframePolicyTest, TranslationCountsAsAFractionOfTheDepth) {
  parameters_.keyframes.keyframe_translation = 0.1;
  alignment_.T_live_ref = retract(0.19 * Vector6::Unit(0));
  EXPECT_FALSE(isNeeded());
  alignment_.T_live_ref = retract(0.21 * Vector6::Unit(0));
  EXPECT_TRUE(isNeeded());
}

TEST_F(KeyframePolicyTest, RotationCountsAsAnAngle) {
  parameters_.keyframes.keyframe_rotation = 0.2;
  alignment_.T_live_ref = retract(0.19 * Vector6::Unit(4));
  EXPECT_FALSE(isNeeded());
  alignment_.T_live_ref = retract(0.21 * Vector6::Unit(4));
  EXPECT_TRUE(isNeeded());
}

TEST_F(KeyframePolicyTest, TooLittleInViewNeedsOne) {
  alignment_.overlap = parameters_.keyframes.keyframe_overlap - 0.01;
  EXPECT_TRUE(isNeeded());
}

TEST_F(KeyframePolicyTest, LessInformationThanAtFirstNeedsOne) {
  parameters_.keyframes.keyframe_mutual_information = 0.5;
  alignment_.mutual_information = 0.51;
  EXPECT_FALSE(isNeeded());
  alignment_.mutual_information = 0.49;
  EXPECT_TRUE(isNeeded());
}

TEST_F(KeyframePolicyTest, ABlurredFrameIsOneOnlyWhenThereIsNoOtherWay) {
  parameters_.keyframes.keyframe_rotation = 0.1;
  parameters_.keyframes.keyframe_sharpness = 0.8;
  first_.correlation = 0.9;
  alignment_.correlation = 0.73;  // as high as at first: the frame is sharp
  alignment_.T_live_ref = retract(0.15 * Vector6::Unit(4));
  EXPECT_TRUE(isNeeded());
  alignment_.correlation = 0.71;
  EXPECT_FALSE(isNeeded());
  alignment_.T_live_ref = retract(0.17 * Vector6::Unit(4));
  EXPECT_TRUE(isNeeded());
  alignment_.T_live_ref.setIdentity();
  alignment_.overlap = parameters_.keyframes.keyframe_overlap - 0.01;
  EXPECT_FALSE(isNeeded());
  parameters_.alignment.photometric_model = PhotometricModel::kNone;  // as in the paper
  EXPECT_TRUE(isNeeded());
  parameters_.alignment.photometric_model = PhotometricModel::kLcn;
  parameters_.keyframes.keyframe_sharpness = 0.0;
  EXPECT_TRUE(isNeeded());
}

TEST_F(KeyframePolicyTest, AfterAKeyframeOfTheDarkTheFirstLitFrameIsOne) {
  alignment_.is_keyframe_dark = true;
  alignment_.is_live_dark = true;
  EXPECT_FALSE(isNeeded());
  alignment_.is_live_dark = false;
  EXPECT_TRUE(isNeeded());
}

TEST_F(KeyframePolicyTest, WithSsdAloneTheResidualsSpeak) {
  parameters_.keyframes.keyframe_mutual_information = 0.5;
  first_.mutual_information = 0.0;
  alignment_.mutual_information = 0.0;
  alignment_.residual_scale = 3.9;
  EXPECT_FALSE(isNeeded());
  alignment_.residual_scale = 4.1;
  EXPECT_TRUE(isNeeded());
}

TEST_F(KeyframePolicyTest, WithoutAFirstFrameQualityDoesNotCount) {
  first_ = {};
  alignment_.mutual_information = 0.0;
  alignment_.residual_scale = 50.0;
  EXPECT_FALSE(isNeeded());
}

TEST_F(KeyframePolicyTest, TheFirstFrameStaysTheOnlyOneWhenToldSo) {
  parameters_.keyframes.keyframe_policy = KeyframePolicy::kFirst;
  alignment_.T_live_ref = retract((Vector6() << 5, 0, 0, 0, 1, 0).finished());
  alignment_.overlap = 0.0;
  alignment_.mutual_information = 0.0;
  EXPECT_FALSE(isNeeded());
}

}  // namespace
}  // namespace mivo
