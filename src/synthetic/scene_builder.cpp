// SPDX-License-Identifier: BSD-3-Clause
#include "synthetic/scene_builder.h"

#include <cmath>
#include <utility>

#include "synthetic/pixel_noise.h"

namespace mivo {
namespace {

constexpr float kHalfPi = 0.5F * kPi;
// Surfaces that would coincide are this far apart.
constexpr float kGap = 0.004F;

}  // namespace

Material glossy(float specular, int doublings) {
  Material properties;
  properties.specular = specular;
  properties.gloss_doublings = doublings;
  return properties;
}

int SceneBuilder::material(Texture texture, const Material& properties) {
  scene.textures.push_back(std::move(texture));
  scene.materials.push_back(properties);
  scene.materials.back().texture = static_cast<int>(scene.textures.size()) - 1;
  return static_cast<int>(scene.materials.size()) - 1;
}

int SceneBuilder::plain(const Reflectance& color, float specular, int doublings) {
  Material properties = glossy(specular, doublings);
  properties.clean = true;
  return material(plainTexture(color), properties);
}

int SceneBuilder::picture(Texture texture, float specular, bool absorbs_infrared) {
  Material properties;
  properties.stretched = true;
  properties.specular = specular;
  properties.absorbs_infrared = absorbs_infrared;
  return material(std::move(texture), properties);
}

void SceneBuilder::place(float x, float y, float z, float yaw) {
  T_scene_local_ = Eigen::Translation3f(x, y, z) * Eigen::AngleAxisf(yaw, Eigen::Vector3f::UnitZ());
}

float SceneBuilder::uniform(float low, float high) {
  return low + (high - low) * uniformFrom(hashOf(seed_, 0x5ce7e, draws_++));
}

void SceneBuilder::add(Patch patch) {
  patch.origin = T_scene_local_ * patch.origin;
  patch.edge_u = T_scene_local_.linear() * patch.edge_u;
  patch.edge_v = T_scene_local_.linear() * patch.edge_v;
  // Two surfaces of the same material show different parts of it.
  patch.texture_origin = {uniform(0.0F, 3.0F), uniform(0.0F, 3.0F)};
  scene.patches.push_back(patch);
}

void SceneBuilder::uprightPanel(const Eigen::Vector3f& center, float facing, float width,
                                float height, int material) {
  // The right of somebody who looks at the panel.
  const Eigen::Vector3f right(-std::sin(facing), std::cos(facing), 0.0F);
  Patch patch;
  patch.edge_u = width * right;
  patch.edge_v = Eigen::Vector3f(0.0F, 0.0F, -height);
  patch.origin = center - 0.5F * patch.edge_u - 0.5F * patch.edge_v;
  patch.material = material;
  add(patch);
}

void SceneBuilder::levelPanel(const Eigen::Vector3f& center, float size_x, float size_y, bool up,
                              int material) {
  // Seen from the camera at rest, the far edge (+x) of a table top is the upper edge of its
  // picture.
  Patch patch;
  patch.edge_u = Eigen::Vector3f(0.0F, up ? -size_y : size_y, 0.0F);
  patch.edge_v = Eigen::Vector3f(-size_x, 0.0F, 0.0F);
  patch.origin = center - 0.5F * patch.edge_u - 0.5F * patch.edge_v;
  patch.material = material;
  add(patch);
}

void SceneBuilder::box(const Eigen::Vector3f& bottom, const Eigen::Vector3f& size, int material,
                       int top) {
  const Eigen::Vector3f center = bottom + Eigen::Vector3f(0.0F, 0.0F, 0.5F * size.z());
  const Eigen::Vector3f x(0.5F * size.x(), 0.0F, 0.0F);
  const Eigen::Vector3f y(0.0F, 0.5F * size.y(), 0.0F);
  uprightPanel(center + x, 0.0F, size.y(), size.z(), material);
  uprightPanel(center + y, kHalfPi, size.x(), size.z(), material);
  uprightPanel(center - x, kPi, size.y(), size.z(), material);
  uprightPanel(center - y, -kHalfPi, size.x(), size.z(), material);
  const Eigen::Vector3f z(0.0F, 0.0F, 0.5F * size.z());
  levelPanel(center + z, size.x(), size.y(), true, top >= 0 ? top : material);
  if (bottom.z() > 0.0F) {
    levelPanel(center - z, size.x(), size.y(), false, material);
  }
}

void SceneBuilder::cylinder(const Eigen::Vector3f& bottom, float bottom_radius, float top_radius,
                            float height, int material) {
  Patch wall;
  wall.shape = Shape::kFrustum;
  wall.origin = bottom + Eigen::Vector3f(0.0F, 0.0F, height);
  wall.edge_u = Eigen::Vector3f::UnitX();
  wall.edge_v = Eigen::Vector3f(0.0F, 0.0F, -height);
  wall.first_radius = top_radius;
  wall.second_radius = bottom_radius;
  wall.material = material;
  add(wall);
  if (top_radius > 0.0F) {
    Patch lid = wall;
    lid.edge_v = Eigen::Vector3f(0.0F, 0.0F, -1e-4F);
    lid.first_radius = 0.0F;
    lid.second_radius = top_radius;
    add(lid);
  }
}

void SceneBuilder::sphere(const Eigen::Vector3f& center, float radius, int material) {
  Patch patch;
  patch.shape = Shape::kSphere;
  patch.origin = center;
  patch.edge_u = Eigen::Vector3f::UnitX();
  patch.first_radius = radius;
  patch.material = material;
  add(patch);
}

void SceneBuilder::shell(const Eigen::Vector3f& low, const Eigen::Vector3f& high, int floor,
                         int ceiling, const std::array<int, 4>& walls) {
  place(0.0F, 0.0F, 0.0F, 0.0F);
  const Eigen::Vector3f center = 0.5F * (low + high);
  const Eigen::Vector3f size = high - low;
  uprightPanel({high.x(), center.y(), center.z()}, kPi, size.y(), size.z(), walls[0]);
  uprightPanel({center.x(), high.y(), center.z()}, -kHalfPi, size.x(), size.z(), walls[1]);
  uprightPanel({low.x(), center.y(), center.z()}, 0.0F, size.y(), size.z(), walls[2]);
  uprightPanel({center.x(), low.y(), center.z()}, kHalfPi, size.x(), size.z(), walls[3]);
  levelPanel({center.x(), center.y(), low.z()}, size.x(), size.y(), true, floor);
  levelPanel({center.x(), center.y(), high.z()}, size.x(), size.y(), false, ceiling);
}

void SceneBuilder::lamps(const Eigen::Vector2f& center, float spacing_x, float spacing_y,
                         float ceiling) {
  place(0.0F, 0.0F, 0.0F, 0.0F);
  for (int k = 0; k < kNumLamps; ++k) {
    Lamp& lamp = scene.lamps[static_cast<std::size_t>(k)];
    const bool left = k < 2;
    const bool front = k % 2 == 0;
    lamp.center = {center.x() + (front ? 0.5F : -0.5F) * spacing_x,
                   center.y() + (left ? 0.5F : -0.5F) * spacing_y, ceiling - 0.06F};
    Material luminous;
    luminous.luminous_lamp = k;
    const int panel = material(plainTexture({0.9F, 0.9F, 0.9F}), luminous);
    levelPanel(lamp.center + Eigen::Vector3f(0.0F, 0.0F, 0.02F), 2.0F * lamp.half_x,
               2.0F * lamp.half_y, false, panel);
  }
}

void SceneBuilder::table(float width, float depth, float height, int top, int legs) {
  constexpr float kThickness = 0.04F;
  constexpr float kLeg = 0.05F;
  box({0.0F, 0.0F, height - kThickness}, {depth, width, kThickness}, top);
  for (const float x : {-1.0F, 1.0F}) {
    for (const float y : {-1.0F, 1.0F}) {
      box({x * (0.5F * depth - kLeg), y * (0.5F * width - kLeg), 0.0F},
          {kLeg, kLeg, height - kThickness - kGap}, legs);
    }
  }
}

void SceneBuilder::chair(int seat, int legs) {
  box({0.0F, 0.0F, 0.42F}, {0.44F, 0.44F, 0.06F}, seat);
  box({0.24F, 0.0F, 0.55F}, {0.05F, 0.42F, 0.42F}, seat);
  for (const float y : {-0.17F, 0.17F}) {
    box({0.245F, y, 0.30F}, {0.03F, 0.04F, 0.26F}, legs);
  }
  cylinder({0.0F, 0.0F, 0.06F}, 0.035F, 0.03F, 0.355F, legs);
  cylinder({0.0F, 0.0F, 0.0F}, 0.24F, 0.08F, 0.06F, legs);
}

void SceneBuilder::sofa(float width, int fabric, int cushion) {
  box({0.0F, 0.0F, 0.0F}, {0.85F, width, 0.40F}, fabric);
  box({0.34F, 0.0F, 0.40F}, {0.18F, width, 0.40F}, fabric);
  for (const float y : {-0.5F, 0.5F}) {
    box({-0.05F, y * (width + 0.16F), 0.0F}, {0.9F, 0.16F, 0.58F}, fabric);
  }
  sphere({0.10F, 0.27F * width, 0.52F}, 0.17F, cushion);
  sphere({0.12F, -0.30F * width, 0.50F}, 0.15F, cushion);
}

void SceneBuilder::bookshelf(float width, float height, int boards, const std::vector<int>& books) {
  constexpr float kDepth = 0.28F;
  constexpr float kBoard = 0.03F;
  for (const float y : {-0.5F, 0.5F}) {
    box({0.0F, y * (width - kBoard), 0.0F}, {kDepth, kBoard, height}, boards);
  }
  uprightPanel({0.5F * kDepth - 0.01F, 0.0F, 0.5F * height}, kPi, width, height, boards);
  const int rows = static_cast<int>(height / 0.36F);
  const float pitch = (height - kBoard) / static_cast<float>(rows);
  for (int row = 0; row <= rows; ++row) {
    const float z = static_cast<float>(row) * pitch;
    box({0.0F, 0.0F, z}, {kDepth, width - 2.0F * kBoard - kGap, kBoard}, boards);
    if (row == rows) {
      break;
    }
    // Books fill part of the row, as deep as they happen to stand; the rest is left open.
    const float fill = uniform(0.55F, 0.97F) * (width - 2.0F * kBoard);
    const float side = uniform(0.0F, 1.0F) < 0.5F ? -1.0F : 1.0F;
    const float set_back = uniform(0.0F, 0.06F);
    const int spines = books[static_cast<std::size_t>(row) % books.size()];
    box({set_back, side * 0.5F * (width - 2.0F * kBoard - fill - kGap), z + kBoard},
        {kDepth - 0.10F, fill - kGap, 0.78F * (pitch - kBoard)}, spines);
    if (fill < 0.8F * width) {
      const float radius = uniform(0.04F, 0.07F);
      sphere({-0.04F, -side * (0.5F * width - 0.11F), z + kBoard + radius}, radius, boards);
    }
  }
}

void SceneBuilder::monitor(int screen, int body) {
  box({0.0F, 0.0F, 0.12F}, {0.05F, 0.56F, 0.34F}, body);
  uprightPanel({-0.025F - kGap, 0.0F, 0.29F}, kPi, 0.54F, 0.32F, screen);
  box({0.04F, 0.0F, 0.01F}, {0.04F, 0.10F, 0.2F}, body);
  cylinder({0.02F, 0.0F, 0.0F}, 0.12F, 0.11F, 0.015F, body);
}

}  // namespace mivo
