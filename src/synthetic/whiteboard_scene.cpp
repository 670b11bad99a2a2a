// SPDX-License-Identifier: BSD-3-Clause
#include <utility>

#include "synthetic/scene_builder.h"
#include "synthetic/scenes.h"
#include "synthetic/texture_patterns.h"

namespace mivo {
namespace {

constexpr float kWall = 1.8F;  // m
constexpr float kSide = 2.2F;
constexpr float kHeight = 2.6F;
constexpr float kBoard = kWall - 0.02F;
constexpr float kBoardHeight = 1.45F;  // of its center

// A drawn stroke: a narrow strip on the board, level or upright.
void addStroke(SceneBuilder& b, float y, float z, float width, float height, int ink) {
  b.uprightPanel({kBoard - 0.002F, y, z}, kPi, width, height, ink);
}

// A table of a few lines, a box with an arrow, and two magnets: most of the board is empty.
void addDrawing(SceneBuilder& b) {
  const int blue = b.plain({0.5F, 0.2F, 0.1F}, 0.0F, 5);
  const int black = b.plain({0.08F, 0.08F, 0.08F}, 0.0F, 5);
  const int red = b.plain({0.1F, 0.1F, 0.55F}, 0.4F, 5);
  const float left = b.uniform(0.45F, 0.7F);
  for (int k = 0; k < 3; ++k) {
    addStroke(b, left, 1.6F - 0.12F * static_cast<float>(k), b.uniform(0.25F, 0.5F), 0.008F, blue);
  }
  const float right = b.uniform(-0.7F, -0.4F);
  addStroke(b, right, 1.5F, 0.3F, 0.008F, black);
  addStroke(b, right, 1.3F, 0.3F, 0.008F, black);
  addStroke(b, right - 0.15F, 1.4F, 0.008F, 0.2F, black);
  addStroke(b, right + 0.15F, 1.4F, 0.008F, 0.2F, black);
  addStroke(b, right + 0.3F, 1.4F, 0.3F, 0.008F, black);
  b.sphere({kBoard, b.uniform(-0.2F, 0.2F), 1.85F}, 0.015F, red);
  b.sphere({kBoard, b.uniform(0.8F, 1.0F), 1.2F}, 0.015F, red);
}

}  // namespace

Scene makeWhiteboard(std::uint64_t seed) {
  SceneBuilder b(seed);
  const int paint = b.plain({0.5F, 0.54F, 0.55F}, 0.0F, 5);
  const int floor = b.plain({0.22F, 0.24F, 0.26F}, 0.0F, 5);
  const int white = b.plain({0.78F, 0.79F, 0.79F}, 0.2F, 6);
  const int aluminium = b.plain({0.45F, 0.45F, 0.45F}, 0.5F, 6);
  b.shell({-2.2F, -kSide, 0.0F}, {kWall, kSide, kHeight}, floor, paint,
          {paint, paint, paint, paint});
  b.lamps({-0.8F, 0.0F}, 1.8F, 2.4F, kHeight);
  b.place(0.0F, 0.0F, 0.0F, 0.0F);
  constexpr float kWidth = 2.6F;
  constexpr float kTall = 1.2F;
  b.box({kWall - 0.005F, 0.0F, kBoardHeight - 0.5F * kTall - 0.02F},
        {0.03F, kWidth + 0.04F, kTall + 0.04F}, aluminium);
  b.uprightPanel({kBoard - 0.001F, 0.0F, kBoardHeight}, kPi, kWidth, kTall, white);
  b.box({kWall - 0.05F, 0.0F, kBoardHeight - 0.5F * kTall - 0.04F}, {0.08F, 0.5F, 0.02F},
        aluminium);
  addDrawing(b);

  b.scene.reference_point = {0.0F, 0.0F, 1.0F};
  b.scene.viewpoint.center = {-0.2F, 0.0F, 1.4F};
  b.scene.viewpoint.reach = {0.4F, 0.6F, 0.25F};
  b.scene.viewpoint.yaw_reach = 0.4;
  b.scene.viewpoint.pitch_reach = 0.14;
  b.scene.moving_lamp_center = {0.7F, 0.0F, 1.5F};
  b.scene.moving_lamp_reach = {0.25F, 0.9F, 0.3F};
  return std::move(b.scene);
}

}  // namespace mivo
