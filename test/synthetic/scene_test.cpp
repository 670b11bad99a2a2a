// SPDX-License-Identifier: BSD-3-Clause
#include "synthetic/scene.h"

#include <gtest/gtest.h>

#include "mivo/core/error.h"
#include "synthetic/shared_scene.h"

namespace mivo {
namespace {

std::vector<Patch> shapes() {
  Patch flat;
  flat.origin = {0.3F, -0.2F, 1.0F};
  flat.edge_u = {0.0F, -1.2F, 0.0F};
  flat.edge_v = {0.1F, 0.0F, -0.7F};
  Patch cone;
  cone.shape = Shape::kFrustum;
  cone.origin = {1.0F, 2.0F, 0.9F};
  cone.edge_u = Eigen::Vector3f::UnitX();
  cone.edge_v = {0.0F, 0.0F, -0.5F};
  cone.first_radius = 0.1F;
  cone.second_radius = 0.3F;
  Patch ball;
  ball.shape = Shape::kSphere;
  ball.origin = {-1.0F, 0.5F, 0.4F};
  ball.edge_u = Eigen::Vector3f::UnitX();
  ball.first_radius = 0.25F;
  return {flat, cone, ball};
}

// Upright pictures, seen from outside: u to the right, v down, hence dv x du points at the viewer.
TEST(Patch, NormalIsThatOfTheParametrization) {
  constexpr float kStep = 1e-2F;
  for (const Patch& patch : shapes()) {
    for (const float u : {0.1F, 0.37F, 0.8F}) {
      for (const float v : {0.2F, 0.5F, 0.9F}) {
        const Eigen::Vector3f du = patch.position(u + kStep, v) - patch.position(u - kStep, v);
        const Eigen::Vector3f dv = patch.position(u, v + kStep) - patch.position(u, v - kStep);
        EXPECT_LT((dv.cross(du).normalized() - patch.normal(u, v)).norm(), 1e-3F)
            << static_cast<int>(patch.shape) << " " << u << " " << v;
      }
    }
  }
}

TEST(Patch, RoundShapesHaveTheirRadii) {
  const Patch cone = shapes()[1];
  const Eigen::Vector3f axis_point = cone.origin + 0.25F * cone.edge_v;
  EXPECT_NEAR((cone.position(0.6F, 0.25F) - axis_point).norm(), 0.15F, 1e-6F);
  const Patch ball = shapes()[2];
  EXPECT_NEAR((ball.position(0.3F, 0.7F) - ball.origin).norm(), 0.25F, 1e-6F);
  EXPECT_NEAR(ball.position(0.3F, 0.0F).z(), ball.origin.z() + 0.25F, 1e-6F);
}

TEST(Scene, AllScenesAreComplete) {
  for (const std::string& name : sceneNames()) {
    const Scene& scene = sharedScene(name);
    EXPECT_EQ(scene.name, name);
    const bool one_surface = scene.materials.front().evenly_lit;
    EXPECT_GE(scene.patches.size(), one_surface ? 1U : 15U) << name;
    for (const Patch& patch : scene.patches) {
      ASSERT_LT(static_cast<std::size_t>(patch.material), scene.materials.size());
      EXPECT_GT(patch.size().minCoeff(), 0.0F);
    }
    for (const Material& material : scene.materials) {
      ASSERT_LT(static_cast<std::size_t>(material.texture), scene.textures.size());
    }
  }
}

TEST(Scene, UnknownNameIsRefused) {
  EXPECT_THROW(makeScene("beach", 1), Error);
}

}  // namespace
}  // namespace mivo
