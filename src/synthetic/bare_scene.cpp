// SPDX-License-Identifier: BSD-3-Clause
#include <utility>

#include "synthetic/scene_builder.h"
#include "synthetic/scenes.h"
#include "synthetic/texture_patterns.h"

namespace mivo {
namespace {

// Paint, cloth or floor with hardly any structure, and no stains.
int nearlyEven(SceneBuilder& b, const Reflectance& color, double contrast) {
  Material properties;
  properties.clean = true;
  return b.material(plasterTexture(color, contrast, b.nextSeed()), properties);
}

void addFurniture(SceneBuilder& b) {
  const int cloth = nearlyEven(b, {0.28F, 0.26F, 0.24F}, 0.03);
  const int cushion = nearlyEven(b, {0.10F, 0.16F, 0.34F}, 0.03);
  const int white = b.plain({0.62F, 0.64F, 0.64F}, 0.4F, 6);
  const int dark = b.plain({0.06F, 0.07F, 0.09F}, 0.4F, 6);
  const int china = b.plain({0.5F, 0.36F, 0.2F}, 0.6F, 7);
  b.place(1.75F, 0.45F, 0.0F, 0.08F);
  b.sofa(1.7F, cloth, cushion);
  b.place(1.95F, -1.2F, 0.0F, -0.3F);
  b.box({0.0F, 0.0F, 0.0F}, {0.5F, 0.9F, 1.1F}, white);
  b.cylinder({-0.05F, 0.2F, 1.1F}, 0.09F, 0.12F, 0.2F, china);
  b.sphere({-0.05F, -0.2F, 1.2F}, 0.1F, dark);
  b.place(0.95F, 0.2F, 0.0F, -0.2F);
  b.table(0.9F, 0.5F, 0.45F, dark, dark);
  b.cylinder({0.05F, -0.2F, 0.45F}, 0.05F, 0.08F, 0.2F, china);
  b.box({0.05F, 0.2F, 0.45F}, {0.2F, 0.28F, 0.05F}, white,
        b.picture(printedPageTexture(b.nextSeed())));
  b.place(1.2F, 1.75F, 0.0F, -0.5F * kPi);
  b.box({0.0F, 0.0F, 0.0F}, {0.4F, 1.0F, 0.75F}, white);
  b.cylinder({0.0F, 0.1F, 0.75F}, 0.1F, 0.03F, 0.3F, dark);
  b.cylinder({0.0F, 0.1F, 1.05F}, 0.18F, 0.12F, 0.2F, cloth);
  b.place(0.75F, -1.5F, 0.0F, 0.4F);
  b.box({0.0F, 0.0F, 0.0F}, {0.45F, 0.5F, 0.45F}, cushion);
}

}  // namespace

Scene makeBare(std::uint64_t seed) {
  SceneBuilder b(seed);
  constexpr float kFront = 2.4F;
  constexpr float kSide = 2.0F;
  constexpr float kHeight = 2.6F;
  const int paint = nearlyEven(b, {0.46F, 0.52F, 0.54F}, 0.012);
  const int floor = nearlyEven(b, {0.20F, 0.22F, 0.24F}, 0.05);
  b.shell({-2.2F, -kSide, 0.0F}, {kFront, kSide, kHeight}, floor, paint,
          {paint, paint, paint, paint});
  b.lamps({0.2F, 0.0F}, 2.2F, 2.2F, kHeight);
  addFurniture(b);
  b.place(0.0F, 0.0F, 0.0F, 0.0F);
  b.uprightPanel({kFront - 0.012F, 0.7F, 1.6F}, kPi, 0.7F, 0.5F,
                 b.picture(paintingTexture(b.nextSeed()), 0.15F));

  b.scene.reference_point = {0.1F, 0.0F, 1.0F};
  b.scene.viewpoint.center = {-0.75F, 0.0F, 1.3F};
  b.scene.viewpoint.reach = {0.5F, 0.7F, 0.3F};
  b.scene.viewpoint.yaw_reach = 0.5;
  b.scene.viewpoint.pitch_reach = 0.16;
  b.scene.viewpoint.pitch = -0.2;
  b.scene.moving_lamp_center = {0.95F, 0.0F, 1.55F};
  b.scene.moving_lamp_reach = {0.3F, 1.2F, 0.4F};
  return std::move(b.scene);
}

}  // namespace mivo
