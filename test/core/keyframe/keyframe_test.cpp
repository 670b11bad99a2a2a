// SPDX-License-Identifier: BSD-3-Clause
#include "core/keyframe/keyframe.h"

#include <gtest/gtest.h>

#include "support/scene.h"

namespace mivo {
namespace {

Keyframe wallKeyframe(const Parameters& parameters) {
  const Camera camera = testing::smallCamera();
  FramePyramid pyramid;
  pyramid.build(testing::render(testing::wallScene(), camera, Eigen::Isometry3d::Identity()),
                parameters);
  Keyframe keyframe;
  keyframe.build(pyramid, camera, Vector6::Zero(), {}, parameters);
  return keyframe;
}

// Second derivatives need the eight neighbors, which border pixels lack.
std::size_t innerPixels(const Camera& camera) {
  return static_cast<std::size_t>((camera.width - 2) * (camera.height - 2));
}

TEST(KeyframeTest, TheCoarsestLevelUsesEveryPixelWithDepth) {
  const Keyframe keyframe = wallKeyframe({});
  const int coarsest = keyframe.numLevels() - 1;
  ASSERT_GT(coarsest, 0);
  EXPECT_EQ(keyframe.level(coarsest).points.size(),
            innerPixels(testing::smallCamera().atLevel(coarsest)));
  EXPECT_LT(keyframe.level(0).points.size(), innerPixels(testing::smallCamera()));
}

TEST(KeyframeTest, WithAFractionOfOneAllLevelsDo) {
  Parameters parameters;
  parameters.points.point_fraction = 1.0;
  const Keyframe keyframe = wallKeyframe(parameters);
  for (int l = 0; l < keyframe.numLevels(); ++l) {
    EXPECT_EQ(keyframe.level(l).points.size(), innerPixels(testing::smallCamera().atLevel(l)))
        << "level " << l;
  }
}

TEST(KeyframeTest, OnTheFinestLevelMorePointsFollowThoseThatLead) {
  Parameters parameters;
  parameters.points.min_points = 50;
  const Keyframe more = wallKeyframe(parameters);
  const ReferencePoints& points = more.level(0).points;
  EXPECT_GT(points.size(), 3 * points.num_leading / 2);
  EXPECT_EQ(more.level(1).points.num_leading, more.level(1).points.size());
  parameters.points.finest_point_fraction = parameters.points.point_fraction;
  const Keyframe few = wallKeyframe(parameters);
  EXPECT_EQ(few.level(0).points.size(), points.num_leading);
  EXPECT_EQ(few.level(0).points.num_leading, points.num_leading);
  // Raw intensities and mutual information, as in the paper.
  Parameters raw;
  raw.alignment.photometric_model = PhotometricModel::kNone;
  Parameters information;
  information.alignment.method = Method::kMi;
  for (Parameters paper : {raw, information}) {
    paper.points.min_points = 50;
    const Keyframe keyframe = wallKeyframe(paper);
    EXPECT_EQ(keyframe.level(0).points.num_leading, keyframe.level(0).points.size());
  }
}

}  // namespace
}  // namespace mivo
