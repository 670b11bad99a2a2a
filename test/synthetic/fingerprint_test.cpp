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
      {"room", 1.330248, 0.549131},
      {"office", 1.394260, 0.550851},
      {"corridor", 1.428763, 0.667535},
      {"wall", 1.771001, 0.704101},
      {"bare", 1.389360, 0.781987},
      {"hallway", 1.648415, 1.011616},
      {"ceiling", 2.448051, 1.088155},
      {"panels", 1.352595, 1.034229},
      {"hall", 3.567512, 1.076623},
      {"whiteboard", 1.691089, 1.009459},
      {"stripes", 18.391052, 0.397341},
      {"blank", 18.391052, 0.975764},
      {"tube", 4.161712, 0.397341},
      {"rings", 4.161712, 0.396486},
      {"floor", 13.544483, 0.397341},
      {"blank_floor", 13.544483, 0.975764},
      {"stripes_after_texture", 9.846533, 0.357949},
      {"blank_after_texture", 9.846533, 0.655961},
  };
  ASSERT_EQ(all.size(), sceneNames().size());
  for (const Expected& expected : all) {
    const Scene& scene = sharedScene(expected.scene);
    EXPECT_NEAR(shapesOf(scene), expected.shapes, 1e-5) << expected.scene;
    EXPECT_NEAR(colorsOf(scene), expected.colors, 1e-5) << expected.scene;
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
