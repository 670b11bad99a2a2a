// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <utility>

#include "synthetic/even_surface.h"
#include "synthetic/scenes.h"

namespace mivo {
namespace {

constexpr float kExtent = 40.0F;  // m: its edges are never seen
constexpr double kGoldenRatio = 0.618034;

// The stripes run along x turned about z by the fraction of pi that the seed times the golden ratio
// leaves: any direction, each seed another. The camera looks down, so that all of the view is the
// floor and within the depth sensor's range.
Scene floorOf(SceneBuilder& b, std::uint64_t seed, int material) {
  const double turns = kGoldenRatio * static_cast<double>(seed);
  const auto turn = static_cast<float>(kPi * (turns - std::floor(turns)));
  b.place(0.0F, 0.0F, 0.0F, turn);
  b.levelPanel({0.0F, 0.0F, 0.0F}, kExtent, kExtent, true, material);
  hideLamps(b.scene);
  b.scene.viewpoint.center = {0.0, 0.0, 1.3};
  b.scene.viewpoint.reach = {5.0, 5.0, 0.2};
  b.scene.viewpoint.yaw_reach = 0.6;
  b.scene.viewpoint.pitch_reach = 0.12;
  b.scene.viewpoint.pitch = -0.95;
  return std::move(b.scene);
}

}  // namespace

Scene makeStripedFloor(std::uint64_t seed) {
  SceneBuilder b(seed);
  return floorOf(b, seed, evenMaterial(b, stripesTexture(false, b.nextSeed())));
}

Scene makeBlankFloor(std::uint64_t seed) {
  SceneBuilder b(seed);
  return floorOf(b, seed, evenPaint(b));
}

}  // namespace mivo
