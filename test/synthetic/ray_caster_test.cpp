// SPDX-License-Identifier: BSD-3-Clause
#include "synthetic/ray_caster.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

#include "synthetic/pixel_noise.h"

namespace mivo {
namespace {

Eigen::Vector3f randomVector(std::uint64_t k) {
  return {2.0F * uniformFrom(hashOf(1, k)) - 1.0F, 2.0F * uniformFrom(hashOf(2, k)) - 1.0F,
          2.0F * uniformFrom(hashOf(3, k)) - 1.0F};
}

Scene randomParallelograms(int count) {
  Scene scene;
  for (int k = 0; k < count; ++k) {
    Patch patch;
    const auto seed = static_cast<std::uint64_t>(10 * k);
    patch.origin = 2.0F * randomVector(seed);
    patch.edge_u = randomVector(seed + 1);
    patch.edge_v = randomVector(seed + 2);
    scene.patches.push_back(patch);
  }
  return scene;
}

struct Nearest {
  int patch = -1;
  float distance = std::numeric_limits<float>::infinity();
  float u = 0.0F;
  float v = 0.0F;
  float margin =
      1.0F;  // from the edge of any patch on the ray: below 1e-4 the hit depends on rounding
};

// origin + t direction = patch origin + u edge_u + v edge_v, for each patch, in doubles.
Nearest bruteForce(const Scene& scene, const Eigen::Vector3f& origin,
                   const Eigen::Vector3f& direction) {
  Nearest nearest;
  for (std::size_t k = 0; k < scene.patches.size(); ++k) {
    const Patch& patch = scene.patches[k];
    Eigen::Matrix3d A;
    A << direction.cast<double>(), -patch.edge_u.cast<double>(), -patch.edge_v.cast<double>();
    const Eigen::Vector3d x = A.fullPivLu().solve((patch.origin - origin).cast<double>());
    const double inside = std::min({x[1], 1.0 - x[1], x[2], 1.0 - x[2]});
    if (x[0] > 0.0) nearest.margin = std::min(nearest.margin, static_cast<float>(std::abs(inside)));
    if (x[0] > 0.0 && inside >= 0.0 && x[0] < nearest.distance) {
      nearest.patch = static_cast<int>(k);
      nearest.distance = static_cast<float>(x[0]);
      nearest.u = static_cast<float>(x[1]);
      nearest.v = static_cast<float>(x[2]);
    }
  }
  return nearest;
}

TEST(RayCaster, AgreesWithBruteForce) {
  const Scene scene = randomParallelograms(40);
  const RayCaster caster(scene);
  int hits = 0;
  for (std::uint64_t block = 0; block < 400; ++block) {
    RayPacket packet;
    packet.count = block % 5 == 0 ? 3 : kPacketSize;
    for (int i = 0; i < packet.count; ++i) {
      const std::uint64_t k = 100000 + 16 * block + 2 * static_cast<std::uint64_t>(i);
      packet.setOrigin(i, 3.0F * randomVector(k));
      packet.setDirection(i, randomVector(k + 1));
    }
    caster.trace(packet);
    const auto blocked = caster.isBlocked(packet);
    for (int i = 0; i < packet.count; ++i) {
      const auto k = static_cast<std::size_t>(i);
      const Nearest expected =
          bruteForce(scene, {packet.origin_x[k], packet.origin_y[k], packet.origin_z[k]},
                     {packet.direction_x[k], packet.direction_y[k], packet.direction_z[k]});
      if (expected.margin < 1e-3F) continue;
      ASSERT_EQ(packet.patch[k], expected.patch);
      if (expected.patch >= 0) {
        ++hits;
        EXPECT_NEAR(packet.distance[k], expected.distance, 1e-4F * (1.0F + expected.distance));
        EXPECT_NEAR(packet.u[k], expected.u, 2e-3F);
        EXPECT_NEAR(packet.v[k], expected.v, 2e-3F);
      }
      if (std::abs(expected.distance - 0.999F) > 1e-3F) {
        EXPECT_EQ(blocked[k], expected.distance < 0.999F);
      }
    }
  }
  EXPECT_GT(hits, 300);
}

TEST(RayCaster, RoundShapesLieWithinTheirTessellation) {
  Scene scene;
  Patch ball;
  ball.shape = Shape::kSphere;
  ball.first_radius = 0.5F;
  scene.patches.push_back(ball);
  const RayCaster caster(scene);
  RayPacket packet;
  for (int i = 0; i < kPacketSize; ++i) {
    const Eigen::Vector3f from =
        3.0F * randomVector(50 + static_cast<std::uint64_t>(i)).normalized();
    packet.setOrigin(i, from);
    packet.setDirection(i, -from / 3.0F);
  }
  caster.trace(packet);
  for (std::size_t k = 0; k < kPacketSize; ++k) {
    ASSERT_EQ(packet.patch[k], 0);
    // The chord of 1/48 of a circle dips by 1 - cos(pi/48) = 0.2 % of the radius, in two
    // directions.
    EXPECT_GE(packet.distance[k], 2.5F - 1e-4F);
    EXPECT_LE(packet.distance[k], 2.5F + 0.5F * 0.0045F);
    // The parameters are those of the point that was hit.
    const Eigen::Vector3f there = ball.position(packet.u[k], packet.v[k]);
    const Eigen::Vector3f hit =
        Eigen::Vector3f(packet.origin_x[k], packet.origin_y[k], packet.origin_z[k]) +
        packet.distance[k] *
            Eigen::Vector3f(packet.direction_x[k], packet.direction_y[k], packet.direction_z[k]);
    EXPECT_LT((there - hit).norm(), 0.02F);
  }
}

}  // namespace
}  // namespace mivo
