// SPDX-License-Identifier: BSD-3-Clause
// A seed gives the same scene and the same path with every compiler and on every processor: one
// that draws random numbers in another order gives other fingerprints. Rounding may differ.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "synthetic/camera_path.h"
#include "synthetic/shared_scene.h"

namespace mivo {
namespace {

/// Mean of numbers with a weight of their own each, so that exchanged numbers give another one.
class Fingerprint {
 public:
  void add(double number) {
    constexpr double kGoldenRatio = 0.618034;
    const double turns = kGoldenRatio * ++count_;
    sum_ += (1.0 + turns - std::floor(turns)) * number;
  }
  template <typename Vector>
  void addAll(const Vector& numbers) {
    for (Eigen::Index i = 0; i < numbers.size(); ++i) add(static_cast<double>(numbers[i]));
  }
  double value() const { return sum_ / count_; }

 private:
  int count_ = 0;
  double sum_ = 0.0;
};

double shapesOf(const Scene& scene) {
  Fingerprint shapes;
  for (const Patch& patch : scene.patches) {
    shapes.addAll(patch.position(0.3F, 0.4F));
    shapes.addAll(patch.size());
    shapes.addAll(patch.texture_origin);
  }
  return shapes.value();
}

/// At a grid of points: means of some texels, which rounding hardly changes.
double colorsOf(const Scene& scene) {
  constexpr int kSide = 16;
  constexpr float kFootprint = 8.0F;  // texels
  Fingerprint colors;
  for (const Texture& texture : scene.textures) {
    for (int i = 0; i < kSide * kSide; ++i) {
      const float x = static_cast<float>(texture.width() * (i % kSide)) / kSide;
      const float y = static_cast<float>(texture.height() * (i / kSide)) / kSide;
      colors.addAll(texture.sample(x, y, kFootprint));
    }
  }
  return colors.value();
}

TEST(FingerprintTest, ScenesAreTheSameWithEveryCompiler) {
  struct Expected {
    const char* scene;
    double shapes;  // m
    double colors;
  };
  const std::vector<Expected> all{
      {"room", 1.3302484, 0.5491306},
      {"office", 1.3942599, 0.5508508},
      {"corridor", 1.4287625, 0.6675349},
      {"wall", 1.7710015, 0.7041008},
      {"bare", 1.3893597, 0.7819871},
      {"hallway", 1.6484152, 1.0116164},
      {"ceiling", 2.4480511, 1.0881550},
      {"panels", 1.3525950, 1.0342291},
      {"hall", 3.5675119, 1.0766227},
      {"whiteboard", 1.6910891, 1.0094586},
      {"stripes", 18.3910517, 0.3973406},
      {"blank", 18.3910517, 0.9757644},
      {"tube", 4.1617124, 0.3973406},
      {"rings", 4.1617124, 0.3964856},
      {"floor", 13.5444830, 0.3973406},
      {"blank_floor", 13.5444830, 0.9757644},
      {"stripes_after_texture", 9.8465332, 0.3579488},
      {"blank_after_texture", 9.8465332, 0.6559613},
  };
  ASSERT_EQ(all.size(), sceneNames().size());
  for (const Expected& expected : all) {
    const Scene& scene = sharedScene(expected.scene);
    EXPECT_NEAR(shapesOf(scene), expected.shapes, 1e-6) << expected.scene;
    EXPECT_NEAR(colorsOf(scene), expected.colors, 1e-6) << expected.scene;
  }
}

TEST(FingerprintTest, PathsAreTheSameWithEveryCompiler) {
  struct Expected {
    const char* path;
    double poses;  // m and rotation matrices
  };
  const std::vector<Expected> all{
      {"static", 0.023507301},          {"translation", 0.045413746},   {"rotation", 0.044275485},
      {"figure_of_eight", 0.077170285}, {"fast_rotation", 0.037315585}, {"slide", 0.032275062},
  };
  ASSERT_EQ(all.size(), CameraPath::names().size());
  for (const Expected& expected : all) {
    const CameraPath path(expected.path, sharedScene("room").viewpoint, 1);
    Fingerprint poses;
    for (const double t : {0.0, 0.7, 1.9, 4.3}) {
      const Eigen::Matrix4d pose = path.poseAt(t).matrix();
      for (int column = 0; column < 4; ++column) poses.addAll(pose.col(column));
    }
    EXPECT_NEAR(poses.value(), expected.poses, 1e-8) << expected.path;
  }
}

}  // namespace
}  // namespace mivo
