// SPDX-License-Identifier: BSD-3-Clause
#include <utility>

#include "synthetic/even_surface.h"
#include "synthetic/scenes.h"

namespace mivo {
namespace {

constexpr float kRadius = 1.3F;   // m
constexpr float kLength = 16.0F;  // its ends are never seen

// A tube along y around the camera, which looks at its wall, rolled by an angle of the seed.
Scene tubeOf(SceneBuilder& b, std::uint64_t seed, int material) {
  Patch tube;
  tube.shape = Shape::kFrustum;
  tube.origin = {0.0F, -0.5F * kLength, 0.0F};
  tube.edge_u = Eigen::Vector3f::UnitX();
  tube.edge_v = {0.0F, kLength, 0.0F};
  tube.first_radius = kRadius;
  tube.second_radius = kRadius;
  tube.material = material;
  b.scene.patches.push_back(tube);
  hideLamps(b.scene);
  b.scene.viewpoint.center = {0.0, 0.0, 0.0};
  b.scene.viewpoint.reach = {0.25, 5.0, 0.25};
  b.scene.viewpoint.yaw_reach = 0.3;
  b.scene.viewpoint.pitch_reach = 1.2;
  b.scene.viewpoint.roll = rollOfSeed(seed);
  return std::move(b.scene);
}

}  // namespace

Scene makeTube(std::uint64_t seed) {
  SceneBuilder b(seed);
  return tubeOf(b, seed, evenMaterial(b, stripesTexture(false, b.nextSeed())));
}

Scene makeRings(std::uint64_t seed) {
  SceneBuilder b(seed);
  return tubeOf(b, seed, evenMaterial(b, stripesTexture(true, b.nextSeed())));
}

}  // namespace mivo
