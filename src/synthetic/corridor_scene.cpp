// SPDX-License-Identifier: BSD-3-Clause
#include <utility>

#include "synthetic/scene_builder.h"
#include "synthetic/scenes.h"
#include "synthetic/texture_patterns.h"

namespace mivo {
namespace {

// One wall of the corridor, at x = `wall`, facing the camera at rest.
void addCorridorWall(SceneBuilder& b, float wall) {
  const int door = b.material(grainTexture({0.14F, 0.26F, 0.42F}, b.nextSeed()), glossy(0.3F, 5));
  const int frame = b.plain({0.5F, 0.5F, 0.5F}, 0.2F, 5);
  const int steel = b.plain({0.4F, 0.4F, 0.4F}, 0.8F, 6);
  const int red = b.plain({0.04F, 0.05F, 0.45F}, 0.6F, 6);
  const int cork = b.material(terrazzoTexture(b.nextSeed()));
  b.place(0.0F, 0.0F, 0.0F, 0.0F);
  for (const float y : {-2.2F, 1.1F}) {
    b.box({wall - 0.02F, y, 0.0F}, {0.06F, 1.06F, 2.12F}, frame);
    b.uprightPanel({wall - 0.055F, y, 1.04F}, kPi, 0.92F, 2.04F, door);
    b.sphere({wall - 0.10F, y + 0.38F, 1.05F}, 0.035F, steel);
    b.uprightPanel({wall - 0.058F, y, 1.6F}, kPi, 0.24F, 0.1F,
                   b.picture(printedPageTexture(b.nextSeed())));
  }
  // A notice board with sheets, some over others.
  b.box({wall - 0.015F, -0.55F, 1.05F}, {0.03F, 1.5F, 0.95F}, cork);
  for (int i = 0; i < 9; ++i) {
    const float y = -0.55F + 0.16F * static_cast<float>(i - 4) + b.uniform(-0.03F, 0.03F);
    const float height = b.uniform(0.2F, 0.34F);
    const float width = b.uniform(0.17F, 0.3F);
    const float z = 1.5F + b.uniform(-0.28F, 0.28F);
    b.uprightPanel(
        {wall - 0.034F - 0.002F * static_cast<float>(i), y, z}, kPi, width, height,
        b.picture(i % 3 == 0 ? paintingTexture(b.nextSeed()) : printedPageTexture(b.nextSeed())));
  }
  // Radiator and extinguisher.
  for (int rib = 0; rib < 14; ++rib) {
    b.cylinder({wall - 0.08F, -1.1F + 0.085F * static_cast<float>(rib), 0.12F}, 0.036F, 0.036F,
               0.6F, frame);
  }
  b.cylinder({wall - 0.12F, 0.38F, 0.75F}, 0.075F, 0.075F, 0.42F, red);
  b.cylinder({wall - 0.12F, 0.38F, 1.17F}, 0.03F, 0.02F, 0.08F, steel);
  b.uprightPanel({wall - 0.012F, 0.38F, 1.62F}, kPi, 0.3F, 0.3F,
                 b.picture(paintingTexture(b.nextSeed())));
  b.uprightPanel({wall - 0.012F, 2.1F, 1.55F}, kPi, 0.7F, 0.9F,
                 b.picture(paintingTexture(b.nextSeed())));
}

}  // namespace

Scene makeCorridor(std::uint64_t seed) {
  SceneBuilder b(seed);
  constexpr float kWall = 1.5F;
  constexpr float kHeight = 2.5F;
  const int paint = b.material(plasterTexture({0.40F, 0.50F, 0.50F}, 0.09, b.nextSeed()));
  const int bricks = b.material(brickTexture(b.nextSeed()));
  const int floor = b.material(terrazzoTexture(b.nextSeed()), glossy(0.4F, 6));
  const int ceiling = b.material(plasterTexture({0.65F, 0.68F, 0.68F}, 0.03, b.nextSeed()));
  b.shell({-1.0F, -3.2F, 0.0F}, {kWall, 3.2F, kHeight}, floor, ceiling,
          {paint, bricks, paint, bricks});
  b.lamps({0.3F, 0.0F}, 0.9F, 3.2F, kHeight);
  addCorridorWall(b, kWall);
  const int wood = b.material(grainTexture({0.12F, 0.22F, 0.36F}, b.nextSeed()), glossy(0.3F, 5));
  const int cardboard = b.material(cardboardTexture(b.nextSeed()));
  b.place(1.05F, 2.2F, 0.0F, -0.2F);
  b.box({0.0F, 0.0F, 0.0F}, {0.4F, 0.8F, 0.45F}, wood);
  b.box({0.0F, 0.1F, 0.45F}, {0.25F, 0.3F, 0.2F}, cardboard,
        b.picture(printedPageTexture(b.nextSeed())));
  b.place(1.1F, -1.35F, 0.0F, 0.3F);
  b.cylinder({0.0F, 0.0F, 0.0F}, 0.14F, 0.17F, 0.5F, b.picture(rugTexture(b.nextSeed()), 0.2F));

  b.scene.reference_point = {0.3F, 0.0F, 1.0F};
  b.scene.viewpoint.center = {-0.35F, -0.1F, 1.3F};
  b.scene.viewpoint.reach = {0.3F, 0.9F, 0.3F};
  b.scene.viewpoint.yaw_reach = 0.6;
  b.scene.viewpoint.pitch_reach = 0.2;
  b.scene.viewpoint.pitch = -0.1;
  b.scene.moving_lamp_center = {0.85F, 0.0F, 1.5F};
  b.scene.moving_lamp_reach = {0.2F, 1.1F, 0.4F};
  return std::move(b.scene);
}

Scene makeWall(std::uint64_t seed) {
  SceneBuilder b(seed);
  constexpr float kWall = 1.3F;
  constexpr float kHeight = 2.6F;
  const int bricks = b.material(brickTexture(b.nextSeed()));
  const int paint = b.material(plasterTexture({0.42F, 0.48F, 0.5F}, 0.12, b.nextSeed()));
  const int planks = b.material(plankTexture(b.nextSeed()), glossy(0.25F, 5));
  b.shell({-2.0F, -2.6F, 0.0F}, {kWall, 2.6F, kHeight}, planks, paint,
          {bricks, paint, paint, paint});
  b.lamps({-0.2F, 0.0F}, 1.6F, 2.2F, kHeight);
  b.place(0.0F, 0.0F, 0.0F, 0.0F);
  constexpr float kOff = 0.012F;
  for (int column = -2; column <= 2; ++column) {
    for (int row = 0; row < 2; ++row) {
      const float y = 0.72F * static_cast<float>(column) + b.uniform(-0.1F, 0.1F);
      const float z = 0.95F + 0.72F * static_cast<float>(row) + b.uniform(-0.08F, 0.08F);
      const int picture = (column + row) % 2 == 0 ? b.picture(paintingTexture(b.nextSeed()), 0.1F)
                                                  : b.picture(printedPageTexture(b.nextSeed()));
      const float height = b.uniform(0.3F, 0.58F);
      const float width = b.uniform(0.3F, 0.6F);
      b.uprightPanel({kWall - kOff, y, z}, kPi, width, height, picture);
    }
  }

  b.scene.reference_point = {0.0F, 0.0F, 1.0F};
  b.scene.viewpoint.center = {-0.4F, 0.0F, 1.35F};
  b.scene.viewpoint.reach = {0.35F, 0.8F, 0.3F};
  b.scene.viewpoint.yaw_reach = 0.45;
  b.scene.viewpoint.pitch_reach = 0.15;
  b.scene.viewpoint.pitch = -0.05;
  b.scene.moving_lamp_center = {0.7F, 0.0F, 1.4F};
  b.scene.moving_lamp_reach = {0.2F, 1.0F, 0.35F};
  return std::move(b.scene);
}

}  // namespace mivo
