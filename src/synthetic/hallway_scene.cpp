// SPDX-License-Identifier: BSD-3-Clause
#include <utility>

#include "synthetic/scene_builder.h"
#include "synthetic/scenes.h"
#include "synthetic/texture_patterns.h"

namespace mivo {
namespace {

constexpr float kFront = 2.2F;  // m, the wall with the door
constexpr float kSide = 1.9F;
constexpr float kHeight = 2.6F;

// All there is to see: a door in its frame, a picture, a lamp, a switch and a skirting board.
void addDoorAndPicture(SceneBuilder& b) {
  const int white = b.plain({0.72F, 0.73F, 0.72F}, 0.2F, 5);
  const int door = b.plain({0.42F, 0.5F, 0.55F}, 0.2F, 5);
  const int steel = b.plain({0.35F, 0.35F, 0.35F}, 0.6F, 6);
  const float left = b.uniform(0.45F, 0.8F);
  b.box({kFront - 0.02F, left, 0.0F}, {0.05F, 1.02F, 2.1F}, white);
  b.uprightPanel({kFront - 0.048F, left, 1.02F}, kPi, 0.88F, 2.02F, door);
  b.sphere({kFront - 0.09F, left - 0.36F, 1.04F}, 0.03F, steel);
  b.box({kFront - 0.01F, left - 0.68F, 1.1F}, {0.02F, 0.08F, 0.08F}, white);
  b.box({kFront - 0.01F, 0.0F, 0.0F}, {0.02F, 2.0F * kSide, 0.08F}, white);
  const float right = b.uniform(-1.0F, -0.6F);
  b.box({kFront - 0.015F, right, 1.25F}, {0.03F, 0.66F, 0.5F}, steel);
  b.uprightPanel({kFront - 0.032F, right, 1.5F}, kPi, 0.6F, 0.44F,
                 b.picture(paintingTexture(b.nextSeed()), 0.1F));
}

void addStandingLamp(SceneBuilder& b) {
  const int shade = b.plain({0.6F, 0.68F, 0.74F}, 0.0F, 5);
  const int dark = b.plain({0.05F, 0.05F, 0.06F}, 0.3F, 5);
  b.place(1.8F, -1.5F, 0.0F, 0.0F);
  b.cylinder({0.0F, 0.0F, 0.0F}, 0.15F, 0.15F, 0.03F, dark);
  b.cylinder({0.0F, 0.0F, 0.03F}, 0.015F, 0.015F, 1.35F, dark);
  b.cylinder({0.0F, 0.0F, 1.38F}, 0.2F, 0.14F, 0.28F, shade);
}

}  // namespace

Scene makeHallway(std::uint64_t seed) {
  SceneBuilder b(seed);
  const int paint = b.plain({0.5F, 0.56F, 0.58F}, 0.0F, 5);
  const int ceiling = b.plain({0.7F, 0.72F, 0.72F}, 0.0F, 5);
  const int floor = b.plain({0.2F, 0.24F, 0.28F}, 0.15F, 6);
  b.shell({-2.4F, -kSide, 0.0F}, {kFront, kSide, kHeight}, floor, ceiling,
          {paint, paint, paint, paint});
  b.lamps({-0.6F, 0.0F}, 2.0F, 2.0F, kHeight);
  b.place(0.0F, 0.0F, 0.0F, 0.0F);
  addDoorAndPicture(b);
  addStandingLamp(b);

  b.scene.reference_point = {0.0F, 0.0F, 1.0F};
  b.scene.viewpoint.center = {-0.5F, 0.0F, 1.35F};
  b.scene.viewpoint.reach = {0.5F, 0.7F, 0.3F};
  b.scene.viewpoint.yaw_reach = 0.5;
  b.scene.viewpoint.pitch_reach = 0.16;
  b.scene.viewpoint.pitch = -0.1;
  b.scene.moving_lamp_center = {0.9F, 0.0F, 1.5F};
  b.scene.moving_lamp_reach = {0.25F, 1.1F, 0.4F};
  return std::move(b.scene);
}

}  // namespace mivo
