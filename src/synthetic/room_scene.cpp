// SPDX-License-Identifier: BSD-3-Clause
#include <utility>

#include "synthetic/scene_builder.h"
#include "synthetic/scenes.h"
#include "synthetic/texture_patterns.h"

namespace mivo {
namespace {

void addFrontOfRoom(SceneBuilder& b, int wood, int dark_wood) {
  const int fabric =
      b.material(wovenTexture({0.30F, 0.17F, 0.12F}, {0.42F, 0.28F, 0.2F}, b.nextSeed()));
  const int cushion =
      b.material(wovenTexture({0.08F, 0.22F, 0.5F}, {0.3F, 0.5F, 0.6F}, b.nextSeed()));
  b.place(1.75F, 0.55F, 0.0F, 0.08F);
  b.sofa(1.7F, fabric, cushion);

  b.place(1.95F, -1.05F, 0.0F, -0.35F);
  std::vector<int> books;
  for (int i = 0; i < 5; ++i) {
    books.push_back(b.picture(bookRowTexture(b.nextSeed()), 0.1F));
  }
  b.bookshelf(1.0F, 1.85F, dark_wood, books);

  // A low table with things on it, shiny and matt.
  const int stone = b.material(stoneTexture({0.22F, 0.25F, 0.27F}, b.nextSeed()), glossy(0.5F, 6));
  const int china = b.plain({0.6F, 0.62F, 0.6F}, 0.6F, 7);
  const int clay = b.material(plasterTexture({0.10F, 0.19F, 0.36F}, 0.25, b.nextSeed()));
  const int cardboard = b.material(cardboardTexture(b.nextSeed()));
  const int label = b.picture(printedPageTexture(b.nextSeed()));
  b.place(0.95F, 0.25F, 0.0F, -0.2F);
  b.table(0.9F, 0.5F, 0.45F, stone, wood);
  b.cylinder({0.05F, -0.27F, 0.45F}, 0.06F, 0.09F, 0.10F, china);
  b.cylinder({0.05F, -0.27F, 0.55F}, 0.09F, 0.04F, 0.12F, china);
  b.sphere({-0.08F, 0.05F, 0.53F}, 0.08F, clay);
  b.box({0.08F, 0.26F, 0.45F}, {0.22F, 0.3F, 0.16F}, cardboard, label);
}

void addSides(SceneBuilder& b, int wood, int white) {
  // Left: a drawer cabinet with a lamp and a globe; right: a crate, a stool and a leaning board.
  b.place(1.1F, 1.72F, 0.0F, -0.5F * kPi);
  const int lacquer = b.plain({0.42F, 0.40F, 0.36F}, 0.5F, 6);
  b.box({0.0F, 0.0F, 0.0F}, {0.45F, 1.1F, 0.8F}, lacquer, wood);
  for (int row = 0; row < 3; ++row) {
    b.box({-0.235F, 0.0F, 0.12F + 0.24F * static_cast<float>(row)}, {0.012F, 1.02F, 0.2F}, wood);
    b.sphere({-0.25F, 0.0F, 0.22F + 0.24F * static_cast<float>(row)}, 0.02F, white);
  }
  const int globe = b.picture(paintingTexture(b.nextSeed()), 0.3F);
  b.sphere({0.0F, 0.3F, 0.97F}, 0.15F, globe);
  b.cylinder({0.0F, 0.3F, 0.80F}, 0.09F, 0.02F, 0.05F, wood);
  const int shade =
      b.material(wovenTexture({0.4F, 0.5F, 0.55F}, {0.25F, 0.35F, 0.4F}, b.nextSeed()));
  b.cylinder({0.02F, -0.32F, 0.80F}, 0.10F, 0.02F, 0.22F, white);
  b.cylinder({0.02F, -0.32F, 1.00F}, 0.17F, 0.11F, 0.22F, shade);

  const int cardboard = b.material(cardboardTexture(b.nextSeed()));
  const int print = b.picture(printedPageTexture(b.nextSeed()));
  b.place(0.75F, -1.5F, 0.0F, 0.4F);
  b.box({0.0F, 0.0F, 0.0F}, {0.45F, 0.55F, 0.42F}, cardboard, print);
  b.box({0.03F, 0.05F, 0.42F}, {0.3F, 0.35F, 0.26F}, cardboard);
  b.uprightPanel({-0.228F, 0.05F, 0.22F}, kPi, 0.3F, 0.2F, print);
  b.place(0.2F, -1.55F, 0.0F, 0.9F);
  b.cylinder({0.0F, 0.0F, 0.0F}, 0.2F, 0.17F, 0.5F, wood);
}

void addWallDecoration(SceneBuilder& b, float front, float side, int white) {
  b.place(0.0F, 0.0F, 0.0F, 0.0F);
  const auto painting = [&] { return b.picture(paintingTexture(b.nextSeed()), 0.15F); };
  constexpr float kOff = 0.012F;
  b.uprightPanel({front - kOff, 0.95F, 1.55F}, kPi, 0.9F, 0.65F, painting());
  b.uprightPanel({front - kOff, 0.05F, 1.70F}, kPi, 0.5F, 0.7F, painting());
  b.uprightPanel({front - kOff, 1.68F, 1.62F}, kPi, 0.36F, 0.5F,
                 b.picture(printedPageTexture(b.nextSeed())));
  b.uprightPanel({0.2F, side - kOff, 1.55F}, -0.5F * kPi, 0.8F, 0.6F, painting());
  b.uprightPanel({1.5F, side - kOff, 1.65F}, -0.5F * kPi, 0.6F, 0.8F, painting());
  // A white board, nothing on it: a part of the view without texture.
  b.uprightPanel({1.35F, -side + kOff, 1.45F}, 0.5F * kPi, 1.1F, 0.8F, white);
  b.uprightPanel({0.25F, -side + kOff, 1.5F}, 0.5F * kPi, 0.7F, 0.7F, painting());
}

}  // namespace

Scene makeRoom(std::uint64_t seed) {
  SceneBuilder b(seed);
  constexpr float kFront = 2.4F;
  constexpr float kSide = 2.0F;
  constexpr float kHeight = 2.6F;
  const int bricks = b.material(brickTexture(b.nextSeed()));
  const int paint = b.material(plasterTexture({0.36F, 0.45F, 0.48F}, 0.10, b.nextSeed()));
  const int paper = b.material(plasterTexture({0.30F, 0.38F, 0.34F}, 0.16, b.nextSeed()));
  const int planks = b.material(plankTexture(b.nextSeed()), glossy(0.25F, 5));
  const int wood = b.material(grainTexture({0.12F, 0.24F, 0.42F}, b.nextSeed()), glossy(0.3F, 5));
  const int dark_wood =
      b.material(grainTexture({0.05F, 0.09F, 0.17F}, b.nextSeed()), glossy(0.3F, 5));
  const int white = b.plain({0.72F, 0.73F, 0.72F}, 0.25F, 6);
  const int ceiling = b.material(plasterTexture({0.66F, 0.7F, 0.7F}, 0.03, b.nextSeed()));
  b.shell({-2.2F, -kSide, 0.0F}, {kFront, kSide, kHeight}, planks, ceiling,
          {bricks, paper, paint, paint});
  b.lamps({0.2F, 0.0F}, 2.2F, 2.2F, kHeight);
  addFrontOfRoom(b, wood, dark_wood);
  addSides(b, wood, white);
  addWallDecoration(b, kFront, kSide, white);
  b.place(0.0F, 0.0F, 0.0F, 0.0F);
  b.levelPanel({0.55F, 0.1F, 0.006F}, 1.5F, 2.0F, true, b.picture(rugTexture(b.nextSeed())));

  b.scene.reference_point = {0.1F, 0.0F, 1.0F};
  b.scene.viewpoint.center = {-0.75F, 0.0F, 1.3F};
  b.scene.viewpoint.reach = {0.5F, 0.7F, 0.3F};
  b.scene.viewpoint.yaw_reach = 0.6;
  b.scene.viewpoint.pitch_reach = 0.18;
  b.scene.viewpoint.pitch = -0.17;
  b.scene.moving_lamp_center = {0.95F, 0.0F, 1.55F};
  b.scene.moving_lamp_reach = {0.3F, 1.2F, 0.4F};
  return std::move(b.scene);
}

}  // namespace mivo
