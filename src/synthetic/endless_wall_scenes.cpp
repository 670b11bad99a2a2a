// SPDX-License-Identifier: BSD-3-Clause
#include <utility>

#include "synthetic/even_surface.h"
#include "synthetic/scenes.h"

namespace mivo {
namespace {

constexpr float kWall = 2.0F;      // m from the camera's usual place
constexpr float kNearWall = 1.0F;  // soon out of sight of a picture on it
constexpr float kExtent = 40.0F;   // m: its edges are never seen
constexpr float kHeight = 0.0F;    // of the camera; there is no floor
constexpr float kPictureWidth = 0.8F;
constexpr float kPictureHeight = 0.7F;

// Along y of the wall's texture, which is downwards; the camera is rolled.
int stripedPaint(SceneBuilder& b) {
  return evenMaterial(b, stripesTexture(false, b.nextSeed()));
}

void addWall(SceneBuilder& b, float distance, int material) {
  b.uprightPanel({distance, 0.0F, kHeight}, kPi, kExtent, kExtent, material);
}

void addPicture(SceneBuilder& b, double roll) {
  const int picture = b.picture(paintingTexture(b.nextSeed()));
  b.scene.materials[static_cast<std::size_t>(picture)].evenly_lit = true;
  // On the wall itself, as paint is, and square to the rolled camera.
  const Eigen::AngleAxisf turn(static_cast<float>(roll), Eigen::Vector3f::UnitX());
  b.uprightPanel({kNearWall - 1e-4F, 0.0F, kHeight}, kPi, kPictureWidth, kPictureHeight, picture);
  Patch& patch = b.scene.patches.back();
  patch.origin = turn * patch.origin;
  patch.edge_u = turn * patch.edge_u;
  patch.edge_v = turn * patch.edge_v;
}

Scene finished(SceneBuilder& b, std::uint64_t seed, double distance) {
  hideLamps(b.scene);
  b.scene.viewpoint.center = {0.0, 0.0, kHeight};
  b.scene.viewpoint.reach = {0.25 * distance, 5.0, 5.0};
  b.scene.viewpoint.yaw_reach = 0.35;
  b.scene.viewpoint.pitch_reach = 0.35;
  b.scene.viewpoint.roll = rollOfSeed(seed);
  return std::move(b.scene);
}

}  // namespace

Scene makeStripes(std::uint64_t seed) {
  SceneBuilder b(seed);
  addWall(b, kWall, stripedPaint(b));
  return finished(b, seed, kWall);
}

Scene makeBlank(std::uint64_t seed) {
  SceneBuilder b(seed);
  addWall(b, kWall, evenPaint(b));
  return finished(b, seed, kWall);
}

Scene makeStripesAfterTexture(std::uint64_t seed) {
  SceneBuilder b(seed);
  addWall(b, kNearWall, stripedPaint(b));
  addPicture(b, rollOfSeed(seed));
  return finished(b, seed, kNearWall);
}

Scene makeBlankAfterTexture(std::uint64_t seed) {
  SceneBuilder b(seed);
  addWall(b, kNearWall, evenPaint(b));
  addPicture(b, rollOfSeed(seed));
  return finished(b, seed, kNearWall);
}

}  // namespace mivo
