// SPDX-License-Identifier: BSD-3-Clause
#include "synthetic/scene_lighting.h"

#include <gtest/gtest.h>

#include "mivo/core/error.h"
#include "synthetic/renderer.h"
#include "synthetic/sequence_generator.h"
#include "synthetic/shared_scene.h"

namespace mivo {
namespace {

const SequenceTime kTime{301, 1.0 / 30.0};

// The stated illuminance follows from the geometry of the lamps: inverse squares, cosines and
// reflected light.
TEST(SceneLighting, IlluminanceAtTheRoomsCenterIsAsStated) {
  for (const std::string& name : sceneNames()) {
    const Renderer renderer(sharedScene(name), xtionCamera(32, 24), 1);
    const auto measured = [&](const char* lighting, double t) {
      const LightState light = SceneLighting(lighting, kTime, renderer.scene()).at(t);
      return renderer.illuminanceAt(renderer.scene().reference_point, Eigen::Vector3f::UnitZ(),
                                    light);
    };
    EXPECT_NEAR(measured("constant", 3.0), 61.0F, 0.01F) << name;
    EXPECT_NEAR(measured("ramp", 10.0), 9.8F, 0.01F) << name;
    EXPECT_NEAR(measured("oscillating", 0.25), 32.7F, 0.01F) << name;
    EXPECT_NEAR(measured("oscillating", 0.75), 7.9F, 0.01F) << name;
    EXPECT_NEAR(measured("darkness", 5.0), 0.4F, 0.001F) << name;
    EXPECT_EQ(measured("black", 5.0), 0.0F) << name;
    EXPECT_NEAR(measured("left_right", 0.5), 40.0F, 0.01F) << name;
  }
}

TEST(SceneLighting, AmbientLightDoesNotFollowTheLamps) {
  const Scene scene;
  const SceneLighting oscillating("oscillating", kTime, scene);
  EXPECT_EQ(oscillating.at(0.25).ambient_lux, oscillating.at(0.6).ambient_lux);
  EXPECT_GT(oscillating.at(0.25).lamp_lux[0], oscillating.at(0.75).lamp_lux[0]);
}

TEST(SceneLighting, LeftAndRightTakeTurns) {
  const SceneLighting lighting("left_right", kTime, Scene{});
  const LightState left = lighting.at(1.0);
  const LightState right = lighting.at(3.0);
  EXPECT_GT(left.lamp_lux[0], 10.0F * left.lamp_lux[2]);
  EXPECT_GT(right.lamp_lux[3], 10.0F * right.lamp_lux[1]);
  EXPECT_EQ(lighting.at(5.0).lamp_lux, left.lamp_lux);
}

TEST(SceneLighting, OnlyTheMovingLampMoves) {
  for (const std::string& name : SceneLighting::names()) {
    EXPECT_EQ(SceneLighting(name, kTime, Scene{}).at(1.0).moving_lux > 0.0F, name == "moving_lamp")
        << name;
  }
}

TEST(SceneLighting, MovingLampTouchesNothing) {
  for (const std::string& name : sceneNames()) {
    const Scene& scene = sharedScene(name);
    const RayCaster caster(scene);
    const SceneLighting lighting("moving_lamp", kTime, scene);
    constexpr float kClearance = 0.1F;  // m
    for (double t = 0.0; t < 60.0; t += 0.1) {
      RayPacket packet;
      for (int i = 0; i < kPacketSize; ++i) {
        packet.setOrigin(i, lighting.at(t).moving_position);
        packet.setDirection(
            i, kClearance *
                   Eigen::Vector3f(i & 1 ? 1.0F : -1.0F, i & 2 ? 1.0F : -1.0F, i & 4 ? 1.0F : -1.0F)
                       .normalized());
      }
      for (const bool blocked : caster.isBlocked(packet))
        ASSERT_FALSE(blocked) << name << " at " << t << " s";
    }
  }
}

TEST(SceneLighting, UnknownNameIsRefused) {
  EXPECT_THROW(SceneLighting("sunset", kTime, Scene{}), Error);
}

}  // namespace
}  // namespace mivo
