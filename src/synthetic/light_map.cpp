// SPDX-License-Identifier: BSD-3-Clause
#include "synthetic/light_map.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

#include "synthetic/pixel_noise.h"
#include "synthetic/spectral_noise.h"

namespace mivo {
namespace {

constexpr float kNodeSpacing = 0.03F;  // m
constexpr float kLiftOff = 0.002F;     // m, so that a surface does not shade itself
constexpr float kOpenDistance = 0.9F;  // m, what is farther away does not close a place in
constexpr float kStainContrast = 0.11F;
constexpr int kStainSize = 256;

int nodesAlong(float length) {
  return std::clamp(static_cast<int>(std::ceil(length / kNodeSpacing)) + 1, 2, 400);
}

// Stratified directions of a cosine hemisphere around the normal.
Eigen::Vector3f hemisphere(const Eigen::Vector3f& normal, int index, int count, float shift_a,
                           float shift_b) {
  const float r2 = (static_cast<float>(index) + shift_a) / static_cast<float>(count);
  const float turns = static_cast<float>(index) * 0.618034F + shift_b;
  const float angle = 6.2831853F * turns;
  const Eigen::Vector3f helper =
      std::abs(normal.z()) < 0.9F ? Eigen::Vector3f::UnitZ() : Eigen::Vector3f::UnitX();
  const Eigen::Vector3f a = normal.cross(helper).normalized();
  const Eigen::Vector3f b = normal.cross(a);
  const float r = std::sqrt(r2);
  return r * std::cos(angle) * a + r * std::sin(angle) * b + std::sqrt(1.0F - r2) * normal;
}

}  // namespace

LightMap::LightMap(const Scene& scene, const RayCaster& caster, std::uint64_t seed) {
  struct Row {
    int patch;
    int row;
  };
  std::vector<Row> rows;
  std::size_t total = 0;
  for (std::size_t k = 0; k < scene.patches.size(); ++k) {
    const Material& material = scene.materials[static_cast<std::size_t>(scene.patches[k].material)];
    // Of what is lit evenly nobody asks.
    const Eigen::Vector2f size =
        material.evenly_lit ? Eigen::Vector2f(0.0F, 0.0F) : scene.patches[k].size();
    layers_.push_back({nodesAlong(size.x()), nodesAlong(size.y()), total});
    total += static_cast<std::size_t>(layers_[k].columns * layers_[k].rows);
    for (int row = 0; row < layers_[k].rows; ++row) {
      rows.push_back({static_cast<int>(k), row});
    }
  }
  nodes_.resize(total);
  const cv::Mat stains = spectralNoise(kStainSize, {1.1, 1.0, 1.0}, seed);
  cv::parallel_for_(cv::Range(0, static_cast<int>(rows.size())), [&](const cv::Range& range) {
    for (int r = range.start; r < range.end; ++r) {
      const auto [k, row] = rows[static_cast<std::size_t>(r)];
      const Layer& layer = layers_[static_cast<std::size_t>(k)];
      const Patch& patch = scene.patches[static_cast<std::size_t>(k)];
      const Material& material = scene.materials[static_cast<std::size_t>(patch.material)];
      const bool stained = !material.stretched && !material.clean;
      const auto offset = static_cast<int>(hashOf(seed, 0x57a1, k) % kStainSize);
      for (int column = 0; column < layer.columns; ++column) {
        const float u = static_cast<float>(column) / static_cast<float>(layer.columns - 1);
        const float v = static_cast<float>(row) / static_cast<float>(layer.rows - 1);
        Node node = compute(scene, caster, patch, u, v, hashOf(seed, k, row * 1000 + column));
        node.openness[1] = 1.0F;
        if (stained) {
          node.openness[1] += kStainContrast * stains.at<float>((row + offset) % kStainSize,
                                                                (column + 7 * offset) % kStainSize);
        }
        nodes_[layer.first + static_cast<std::size_t>(row * layer.columns + column)] = node;
      }
    }
  });
  smooth();
}

LightMap::Node LightMap::compute(const Scene& scene, const RayCaster& caster, const Patch& patch,
                                 float u, float v, std::uint64_t seed) const {
  // The outermost nodes move inwards a little: on the very edge they would lie in the neighbor.
  const float inner_u = std::clamp(u, 0.002F, 0.998F);
  const float inner_v = std::clamp(v, 0.002F, 0.998F);
  const Eigen::Vector3f normal = patch.normal(inner_u, inner_v);
  const Eigen::Vector3f start = patch.position(inner_u, inner_v) + kLiftOff * normal;
  const float shift_a = uniformFrom(seed);
  const float shift_b = uniformFrom(mixBits(seed));
  Node node{Eigen::Array4f::Zero(), Eigen::Array4f::Zero()};
  RayPacket packet;
  for (int i = 0; i < kPacketSize; ++i) {
    packet.setOrigin(i, start);
  }
  for (int lamp = 0; lamp < kNumLamps; ++lamp) {
    const Lamp& l = scene.lamps[static_cast<std::size_t>(lamp)];
    if ((l.center - start).dot(normal) + l.half_x + l.half_y <= 0.0F || start.z() >= l.center.z()) {
      continue;
    }
    for (int i = 0; i < kPacketSize; ++i) {  // 4 x 2 strata over the lamp's rectangle
      const float a = (static_cast<float>(i % 4) + shift_a) / 2.0F - 1.0F;
      const float b = (static_cast<float>(i / 4) + shift_b) - 1.0F;
      packet.setDirection(i, l.center + Eigen::Vector3f(a * l.half_x, b * l.half_y, 0.0F) - start);
    }
    const auto blocked = caster.isBlocked(packet);
    node.visibility[lamp] =
        static_cast<float>(std::count(blocked.begin(), blocked.end(), false)) / kPacketSize;
  }
  constexpr int kDirections = 2 * kPacketSize;
  int open = 0;
  for (int half = 0; half < 2; ++half) {
    for (int i = 0; i < kPacketSize; ++i) {
      packet.setDirection(
          i, kOpenDistance * hemisphere(normal, 2 * i + half, kDirections, shift_a, shift_b));
    }
    const auto blocked = caster.isBlocked(packet);
    open += static_cast<int>(std::count(blocked.begin(), blocked.end(), false));
  }
  // A closed place still gets light that was reflected by its neighbors.
  node.openness[0] = 0.35F + 0.65F * static_cast<float>(open) / kDirections;
  return node;
}

// Eight shadow rays tell eighths; the mean over 3 x 3 nodes makes the penumbra smooth.
void LightMap::smooth() {
  const std::vector<Node> sharp = nodes_;
  for (const Layer& layer : layers_) {
    for (int row = 0; row < layer.rows; ++row) {
      for (int column = 0; column < layer.columns; ++column) {
        Eigen::Array4f visibility = Eigen::Array4f::Zero();
        float open = 0.0F;
        float count = 0.0F;
        for (int y = std::max(row - 1, 0); y <= std::min(row + 1, layer.rows - 1); ++y) {
          for (int x = std::max(column - 1, 0); x <= std::min(column + 1, layer.columns - 1); ++x) {
            const Node& node = sharp[layer.first + static_cast<std::size_t>(y * layer.columns + x)];
            visibility += node.visibility;
            open += node.openness[0];
            count += 1.0F;
          }
        }
        Node& node = nodes_[layer.first + static_cast<std::size_t>(row * layer.columns + column)];
        node.visibility = visibility / count;
        node.openness[0] = open / count;
      }
    }
  }
}

LightMap::Node LightMap::at(int patch, float u, float v) const {
  const Layer& layer = layers_[static_cast<std::size_t>(patch)];
  const float x = std::clamp(u, 0.0F, 1.0F) * static_cast<float>(layer.columns - 1);
  const float y = std::clamp(v, 0.0F, 1.0F) * static_cast<float>(layer.rows - 1);
  const int x0 = std::min(static_cast<int>(x), layer.columns - 2);
  const int y0 = std::min(static_cast<int>(y), layer.rows - 2);
  const float ax = x - static_cast<float>(x0);
  const float ay = y - static_cast<float>(y0);
  const Node* upper = &nodes_[layer.first + static_cast<std::size_t>(y0 * layer.columns + x0)];
  const Node* lower = upper + layer.columns;
  const float w00 = (1.0F - ax) * (1.0F - ay);
  const float w10 = ax * (1.0F - ay);
  const float w01 = (1.0F - ax) * ay;
  const float w11 = ax * ay;
  return {w00 * upper[0].visibility + w10 * upper[1].visibility + w01 * lower[0].visibility +
              w11 * lower[1].visibility,
          w00 * upper[0].openness + w10 * upper[1].openness + w01 * lower[0].openness +
              w11 * lower[1].openness};
}

}  // namespace mivo
