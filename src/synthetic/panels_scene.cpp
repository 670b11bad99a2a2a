// SPDX-License-Identifier: BSD-3-Clause
#include <utility>

#include "synthetic/scene_builder.h"
#include "synthetic/scenes.h"
#include "synthetic/texture_patterns.h"

namespace mivo {
namespace {

constexpr float kWall = 1.9F;  // m
constexpr float kTile = 0.08F;
constexpr int kColumns = 46;
constexpr int kRows = 30;
constexpr float kJoint = 0.004F;

// A checkered wall: a shift by one tile turns light into dark, by two all is the same again.
void addTiles(SceneBuilder& b) {
  const int light = b.plain({0.62F, 0.64F, 0.64F}, 0.25F, 5);
  const int dark = b.plain({0.34F, 0.38F, 0.4F}, 0.25F, 5);
  for (int row = 0; row < kRows; ++row) {
    for (int column = 0; column < kColumns; ++column) {
      const float y = (static_cast<float>(column) + 0.5F - 0.5F * kColumns) * kTile;
      const float z = (static_cast<float>(row) + 0.5F) * kTile;
      b.uprightPanel({kWall - 0.003F, y, z}, kPi, kTile - kJoint, kTile - kJoint,
                     (row + column) % 2 == 0 ? light : dark);
    }
  }
}

// A row of equal wall cupboards, and the little that tells where one is.
void addFittings(SceneBuilder& b) {
  const int front = b.plain({0.58F, 0.6F, 0.6F}, 0.2F, 5);
  const int knob = b.plain({0.1F, 0.1F, 0.1F}, 0.5F, 6);
  const int white = b.plain({0.78F, 0.78F, 0.78F}, 0.2F, 5);
  for (int k = 0; k < 8; ++k) {
    const float y = 0.45F * (static_cast<float>(k) - 3.5F);
    b.box({kWall - 0.17F, y, 0.1F}, {0.34F, 0.44F, 0.7F}, front);
    b.sphere({kWall - 0.36F, y + 0.15F, 0.65F}, 0.02F, knob);
  }
  b.box({kWall - 0.015F, b.uniform(0.3F, 0.7F), 1.2F}, {0.03F, 0.09F, 0.09F}, white);
  b.uprightPanel({kWall - 0.008F, b.uniform(-0.8F, -0.4F), 1.75F}, kPi, 0.3F, 0.22F,
                 b.picture(printedPageTexture(b.nextSeed())));
}

}  // namespace

Scene makePanels(std::uint64_t seed) {
  SceneBuilder b(seed);
  const int joint = b.plain({0.5F, 0.5F, 0.5F}, 0.0F, 5);
  const int paint = b.plain({0.5F, 0.54F, 0.55F}, 0.0F, 5);
  const int floor = b.plain({0.22F, 0.24F, 0.26F}, 0.1F, 5);
  constexpr float kHeight = 2.6F;
  b.shell({-2.2F, -2.2F, 0.0F}, {kWall, 2.2F, kHeight}, floor, paint, {joint, paint, paint, paint});
  b.lamps({-0.5F, 0.0F}, 1.8F, 2.2F, kHeight);
  b.place(0.0F, 0.0F, 0.0F, 0.0F);
  addTiles(b);
  addFittings(b);

  b.scene.reference_point = {0.0F, 0.0F, 1.0F};
  b.scene.viewpoint.center = {-0.2F, 0.0F, 1.35F};
  b.scene.viewpoint.reach = {0.4F, 0.7F, 0.3F};
  b.scene.viewpoint.yaw_reach = 0.4;
  b.scene.viewpoint.pitch_reach = 0.15;
  b.scene.viewpoint.pitch = -0.08;
  b.scene.moving_lamp_center = {0.8F, 0.0F, 1.5F};
  b.scene.moving_lamp_reach = {0.25F, 1.0F, 0.3F};
  return std::move(b.scene);
}

}  // namespace mivo
