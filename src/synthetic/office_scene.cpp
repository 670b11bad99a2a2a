// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <utility>

#include "synthetic/scene_builder.h"
#include "synthetic/scenes.h"
#include "synthetic/texture_patterns.h"

namespace mivo {
namespace {

struct OfficeMaterials {
  int partition;
  int desk;
  int gray_metal;
  int black_plastic;
  int white;
  int seat;
  int cardboard;
};

OfficeMaterials makeMaterials(SceneBuilder& b) {
  OfficeMaterials m{};
  m.partition =
      b.material(wovenTexture({0.36F, 0.27F, 0.22F}, {0.45F, 0.38F, 0.32F}, b.nextSeed()));
  m.desk = b.material(grainTexture({0.32F, 0.45F, 0.55F}, b.nextSeed()), glossy(0.35F, 5));
  m.gray_metal = b.plain({0.32F, 0.32F, 0.31F}, 0.4F, 5);
  m.black_plastic = b.plain({0.03F, 0.03F, 0.03F}, 0.3F, 5);
  m.white = b.plain({0.75F, 0.76F, 0.75F}, 0.3F, 6);
  m.seat = b.material(wovenTexture({0.06F, 0.33F, 0.26F}, {0.04F, 0.18F, 0.14F}, b.nextSeed()));
  m.cardboard = b.material(cardboardTexture(b.nextSeed()));
  return m;
}

void addDesk(SceneBuilder& b, const OfficeMaterials& m, float x, float y, float yaw) {
  b.place(x, y, 0.0F, yaw);
  b.table(1.5F, 0.7F, 0.73F, m.desk, m.gray_metal);
  b.levelPanel({-0.18F, 0.05F, 0.755F}, 0.15F, 0.42F, true,
               b.picture(keyboardTexture(b.nextSeed())));
  b.box({-0.18F, 0.05F, 0.731F}, {0.16F, 0.43F, 0.018F}, m.black_plastic);
  b.levelPanel({-0.12F, -0.42F, 0.736F}, 0.3F, 0.21F, true,
               b.picture(printedPageTexture(b.nextSeed())));
  b.levelPanel({0.05F, -0.58F, 0.739F}, 0.3F, 0.21F, true,
               b.picture(printedPageTexture(b.nextSeed())));
  b.cylinder({-0.05F, 0.5F, 0.731F}, 0.04F, 0.042F, 0.1F,
             b.picture(paintingTexture(b.nextSeed()), 0.4F));
  b.box({0.15F, 0.6F, 0.731F}, {0.24F, 0.2F, 0.28F}, b.picture(bookRowTexture(b.nextSeed()), 0.1F),
        m.white);
  const auto screen = [&] { return b.picture(screenTexture(b.nextSeed()), 0.35F, true); };
  const int left = screen();
  const int right = screen();
  const Eigen::Rotation2Df turn(yaw);
  for (const float side : {-1.0F, 1.0F}) {
    const Eigen::Vector2f at = Eigen::Vector2f(x, y) + turn * Eigen::Vector2f(0.14F, side * 0.3F);
    b.place(at.x(), at.y(), 0.731F, yaw - side * 0.18F);
    b.monitor(side > 0 ? left : right, m.black_plastic);
  }
}

void addPlant(SceneBuilder& b, float x, float y) {
  const int pot = b.material(plasterTexture({0.12F, 0.2F, 0.38F}, 0.15, b.nextSeed()));
  const int leaves = b.material(plasterTexture({0.06F, 0.2F, 0.08F}, 0.45, b.nextSeed()));
  b.place(x, y, 0.0F, 0.0F);
  b.cylinder({0.0F, 0.0F, 0.0F}, 0.14F, 0.18F, 0.32F, pot);
  for (int i = 0; i < 14; ++i) {
    const float angle = b.uniform(0.0F, 6.28F);
    const float radius = b.uniform(0.02F, 0.2F);
    const float leaf = b.uniform(0.05F, 0.11F);
    const float z = b.uniform(0.4F, 1.0F);
    b.sphere({radius * std::cos(angle), radius * std::sin(angle), z}, leaf, leaves);
  }
}

}  // namespace

Scene makeOffice(std::uint64_t seed) {
  SceneBuilder b(seed);
  constexpr float kFront = 2.6F;
  constexpr float kHeight = 2.7F;
  const int paint = b.material(plasterTexture({0.42F, 0.52F, 0.56F}, 0.07, b.nextSeed()));
  const int carpet =
      b.material(wovenTexture({0.13F, 0.12F, 0.11F}, {0.25F, 0.22F, 0.16F}, b.nextSeed()));
  const int ceiling = b.material(terrazzoTexture(b.nextSeed()));
  const OfficeMaterials m = makeMaterials(b);
  b.shell({-2.4F, -2.2F, 0.0F}, {kFront, 2.2F, kHeight}, carpet, ceiling,
          {paint, paint, paint, paint});
  b.lamps({0.3F, 0.0F}, 2.4F, 2.2F, kHeight);

  b.place(0.0F, 0.0F, 0.0F, 0.0F);
  b.box({2.05F, -0.2F, 0.0F}, {0.06F, 3.2F, 1.35F}, m.partition, m.gray_metal);
  b.box({1.5F, 1.45F, 0.0F}, {1.1F, 0.06F, 1.35F}, m.partition, m.gray_metal);
  for (const float y : {-1.3F, -0.75F, 0.1F, 0.95F}) {
    const float height = b.uniform(0.28F, 0.38F);
    const float width = b.uniform(0.2F, 0.3F);
    const float z = 1.0F + b.uniform(-0.08F, 0.08F);
    b.uprightPanel({2.012F, y, z}, kPi, width, height, b.picture(printedPageTexture(b.nextSeed())));
  }
  addDesk(b, m, 1.5F, 0.25F, 0.0F);
  b.place(0.75F, 0.0F, 0.0F, 2.6F);
  b.chair(m.seat, m.black_plastic);
  b.place(0.95F, 1.95F, 0.0F, -0.5F * kPi);
  std::vector<int> books;
  for (int i = 0; i < 4; ++i) {
    books.push_back(b.picture(bookRowTexture(b.nextSeed()), 0.1F));
  }
  b.bookshelf(1.1F, 1.9F, m.desk, books);

  b.place(1.55F, -1.25F, 0.0F, 0.2F);
  b.box({0.0F, 0.0F, 0.0F}, {0.5F, 0.5F, 0.6F}, m.cardboard);
  b.box({0.02F, 0.04F, 0.6F}, {0.36F, 0.3F, 0.3F}, m.cardboard,
        b.picture(printedPageTexture(b.nextSeed())));
  b.place(0.85F, -1.75F, 0.0F, 0.5F * kPi);
  b.box({0.0F, 0.0F, 0.0F}, {0.5F, 0.42F, 1.25F}, m.gray_metal);
  b.cylinder({0.0F, 0.0F, 1.25F}, 0.12F, 0.15F, 0.22F, b.picture(paintingTexture(b.nextSeed())));
  addPlant(b, 0.15F, -1.75F);

  b.place(0.0F, 0.0F, 0.0F, 0.0F);
  b.uprightPanel({kFront - 0.012F, 0.5F, 1.85F}, kPi, 1.5F, 0.75F, m.white);
  b.uprightPanel({kFront - 0.012F, -0.95F, 1.85F}, kPi, 0.7F, 0.75F,
                 b.picture(paintingTexture(b.nextSeed())));
  b.uprightPanel({1.9F, -2.19F, 1.5F}, 0.5F * kPi, 0.8F, 1.0F,
                 b.picture(paintingTexture(b.nextSeed())));
  b.uprightPanel({0.1F, -2.19F, 1.6F}, 0.5F * kPi, 0.6F, 0.8F,
                 b.picture(printedPageTexture(b.nextSeed())));
  b.uprightPanel({1.95F, 2.19F, 1.7F}, -0.5F * kPi, 0.7F, 0.6F,
                 b.picture(paintingTexture(b.nextSeed())));

  b.scene.reference_point = {0.1F, 0.0F, 1.0F};
  b.scene.viewpoint.center = {-0.55F, 0.0F, 1.35F};
  b.scene.viewpoint.reach = {0.45F, 0.7F, 0.3F};
  b.scene.viewpoint.yaw_reach = 0.6;
  b.scene.viewpoint.pitch_reach = 0.17;
  b.scene.viewpoint.pitch = -0.22;
  b.scene.moving_lamp_center = {1.1F, 0.0F, 1.55F};
  b.scene.moving_lamp_reach = {0.25F, 1.1F, 0.25F};
  return std::move(b.scene);
}

}  // namespace mivo
