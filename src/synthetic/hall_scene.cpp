// SPDX-License-Identifier: BSD-3-Clause
#include <utility>

#include "synthetic/scene_builder.h"
#include "synthetic/scenes.h"
#include "synthetic/texture_patterns.h"

namespace mivo {
namespace {

constexpr float kFront = 11.0F;  // m: far beyond what the depth sensor measures
constexpr float kSide = 5.5F;
constexpr float kHeight = 4.2F;

// On the far wall: doors, windows of another tone and a clock. No depth there.
void addFarWall(SceneBuilder& b) {
  const int door = b.plain({0.2F, 0.28F, 0.36F}, 0.1F, 5);
  const int pane = b.plain({0.75F, 0.74F, 0.7F}, 0.1F, 5);
  const int white = b.plain({0.8F, 0.8F, 0.8F}, 0.1F, 5);
  for (const float y : {-3.0F, 2.6F}) {
    b.uprightPanel({kFront - 0.02F, y + b.uniform(-0.4F, 0.4F), 1.1F}, kPi, 1.8F, 2.2F, door);
  }
  for (int k = -2; k <= 2; ++k) {
    b.uprightPanel({kFront - 0.02F, 1.9F * static_cast<float>(k), 3.2F}, kPi, 1.2F, 0.8F, pane);
  }
  b.uprightPanel({kFront - 0.02F, b.uniform(-0.6F, 0.6F), 2.1F}, kPi, 0.5F, 0.5F, white);
}

// Within reach of the depth sensor: the floor with a line on it, two pillars and a bench.
void addNearThings(SceneBuilder& b) {
  const int pillar = b.plain({0.55F, 0.57F, 0.57F}, 0.0F, 5);
  const int wood = b.plain({0.16F, 0.26F, 0.38F}, 0.1F, 5);
  const int line = b.plain({0.1F, 0.55F, 0.65F}, 0.0F, 5);
  b.box({3.2F, -1.5F, 0.0F}, {0.4F, 0.4F, kHeight}, pillar);
  b.box({4.0F, 1.9F, 0.0F}, {0.4F, 0.4F, kHeight}, pillar);
  b.box({2.6F, b.uniform(0.3F, 0.7F), 0.0F}, {0.4F, 1.3F, 0.45F}, wood);
  b.levelPanel({3.0F, -0.5F, 0.002F}, 6.0F, 0.1F, true, line);
}

}  // namespace

Scene makeHall(std::uint64_t seed) {
  SceneBuilder b(seed);
  const int paint = b.plain({0.52F, 0.56F, 0.56F}, 0.0F, 5);
  const int ceiling = b.plain({0.6F, 0.6F, 0.6F}, 0.0F, 5);
  const int floor = b.plain({0.26F, 0.29F, 0.31F}, 0.1F, 6);
  b.shell({-3.0F, -kSide, 0.0F}, {kFront, kSide, kHeight}, floor, ceiling,
          {paint, paint, paint, paint});
  b.lamps({3.0F, 0.0F}, 5.0F, 4.0F, kHeight);
  b.place(0.0F, 0.0F, 0.0F, 0.0F);
  addFarWall(b);
  addNearThings(b);

  b.scene.reference_point = {2.0F, 0.0F, 1.0F};
  b.scene.viewpoint.center = {0.0F, 0.0F, 1.4F};
  b.scene.viewpoint.reach = {0.6F, 0.7F, 0.3F};
  b.scene.viewpoint.yaw_reach = 0.5;
  b.scene.viewpoint.pitch_reach = 0.15;
  b.scene.viewpoint.pitch = -0.2;
  b.scene.moving_lamp_center = {2.0F, 0.0F, 1.8F};
  b.scene.moving_lamp_reach = {0.3F, 1.5F, 0.4F};
  return std::move(b.scene);
}

}  // namespace mivo
