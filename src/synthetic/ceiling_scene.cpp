// SPDX-License-Identifier: BSD-3-Clause
#include <utility>

#include "synthetic/scene_builder.h"
#include "synthetic/scenes.h"
#include "synthetic/texture_patterns.h"

namespace mivo {
namespace {

constexpr float kCeiling = 2.7F;  // m
constexpr float kPanel = 0.6F;    // repeated exactly
constexpr float kBar = 0.024F;
constexpr int kPanels = 12;  // along each axis

// Bars between panels of one color, a little below them.
void addGrid(SceneBuilder& b, int bar) {
  constexpr float kExtent = kPanel * static_cast<float>(kPanels);
  for (int k = 0; k <= kPanels; ++k) {
    const float at = (static_cast<float>(k) - 0.5F * static_cast<float>(kPanels)) * kPanel;
    b.levelPanel({at, 0.0F, kCeiling - 0.008F}, kBar, kExtent, false, bar);
    b.levelPanel({0.0F, at, kCeiling - 0.009F}, kExtent, kBar, false, bar);
  }
}

// What tells one panel from another: an air outlet, a smoke detector and a sprinkler.
void addFittings(SceneBuilder& b) {
  const int white = b.plain({0.8F, 0.8F, 0.8F}, 0.2F, 5);
  const int slot = b.plain({0.08F, 0.08F, 0.08F}, 0.0F, 5);
  const float x = 0.9F;
  const float y = b.uniform(0.0F, 1.0F) < 0.5F ? 0.9F : -0.9F;
  b.levelPanel({x, y, kCeiling - 0.006F}, 0.56F, 0.56F, false, white);
  for (int k = -2; k <= 2; ++k) {
    b.levelPanel({x + 0.1F * static_cast<float>(k), y, kCeiling - 0.012F}, 0.03F, 0.46F, false,
                 slot);
  }
  b.cylinder({2.1F, -0.5F * y, kCeiling - 0.06F}, 0.05F, 0.06F, 0.05F, white);
  b.cylinder({0.3F, -0.4F * y, kCeiling - 0.05F}, 0.02F, 0.02F, 0.045F, slot);
}

}  // namespace

Scene makeCeiling(std::uint64_t seed) {
  SceneBuilder b(seed);
  const int panel = b.plain({0.66F, 0.68F, 0.68F}, 0.0F, 5);
  const int bar = b.plain({0.5F, 0.5F, 0.5F}, 0.0F, 5);
  const int wall = b.plain({0.42F, 0.48F, 0.5F}, 0.0F, 5);
  const int floor = b.plain({0.2F, 0.22F, 0.24F}, 0.0F, 5);
  constexpr float kHalf = 0.5F * kPanel * static_cast<float>(kPanels);
  b.shell({-kHalf, -kHalf, 0.0F}, {kHalf, kHalf, kCeiling}, floor, panel, {wall, wall, wall, wall});
  b.place(0.0F, 0.0F, 0.0F, 0.0F);
  addGrid(b, bar);
  // Each luminaire fills one panel, as office lamps do.
  b.lamps({1.5F, 0.0F}, 2.4F, 3.0F, kCeiling);
  b.place(0.0F, 0.0F, 0.0F, 0.0F);
  addFittings(b);

  b.scene.reference_point = {0.6F, 0.0F, 1.0F};
  b.scene.viewpoint.center = {-0.3F, 0.0F, 1.1F};
  b.scene.viewpoint.reach = {0.6F, 0.7F, 0.25F};
  b.scene.viewpoint.yaw_reach = 0.6;
  b.scene.viewpoint.pitch_reach = 0.15;
  b.scene.viewpoint.pitch = 1.0;
  b.scene.moving_lamp_center = {0.8F, 0.0F, 1.9F};
  b.scene.moving_lamp_reach = {0.3F, 1.0F, 0.2F};
  return std::move(b.scene);
}

}  // namespace mivo
