// SPDX-License-Identifier: BSD-3-Clause
#include "synthetic/scene_lighting.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "mivo/core/error.h"

namespace mivo {
namespace {

constexpr double kTwoPi = 6.283185307179586;
constexpr float kAmbientLux = 2.0F;    // does not follow the lamps ...
constexpr float kMostAmbient = 0.25F;  // ... unless it would be more than this part of the light
constexpr float kLeftRightLux = 40.0F;
constexpr float kFarSide = 0.06F;  // what the lamps that are off still give
constexpr double kSideSeconds = 2.0;
constexpr double kFadeSeconds = 0.1;
constexpr float kDimRoomLux = 12.0F;
constexpr float kMovingLux = 22.0F;
constexpr double kSwingSeconds = 5.0;

// All lamps alike.
LightState evenLight(float lux) {
  LightState light;
  light.ambient_lux = std::min(kAmbientLux, kMostAmbient * lux);
  light.lamp_lux.fill((lux - light.ambient_lux) / kNumLamps);
  return light;
}

}  // namespace

float LightState::total() const {
  return std::accumulate(lamp_lux.begin(), lamp_lux.end(), ambient_lux);
}

const std::vector<std::string>& SceneLighting::names() {
  static const std::vector<std::string> names{"constant",  "ramp",        "step",
                                              "ramp_step", "oscillating", "darkness",
                                              "black",     "left_right",  "moving_lamp"};
  return names;
}

SceneLighting::SceneLighting(const std::string& name, const SequenceTime& time, const Scene& scene)
    : name_(name),
      time_(time),
      moving_center_(scene.moving_lamp_center),
      moving_reach_(scene.moving_lamp_reach) {
  if (std::find(names().begin(), names().end(), name) == names().end()) {
    std::string known;
    for (const std::string& other : names()) {
      known += (known.empty() ? "" : ", ") + other;
    }
    throw Error("unknown lighting '" + name + "': expected one of " + known);
  }
}

LightState SceneLighting::at(double t) const {
  if (name_ == "left_right") {
    return leftRight(t);
  }
  if (name_ == "moving_lamp") {
    return movingLamp(t);
  }
  return evenLight(static_cast<float>(illuminance(*lightingCurve(name_), t, time_)));
}

LightState SceneLighting::leftRight(double t) const {
  // 1: left, 0: right; each half of the period ends with a short fade.
  const double period = 2.0 * kSideSeconds;
  const double phase = t - period * std::floor(t / period);
  const double into_half = phase < kSideSeconds ? phase : phase - kSideSeconds;
  const double fade =
      std::clamp((into_half - (kSideSeconds - kFadeSeconds)) / kFadeSeconds, 0.0, 1.0);
  const auto left = static_cast<float>(phase < kSideSeconds ? 1.0 - fade : fade);
  const float left_share = kFarSide + (1.0F - 2.0F * kFarSide) * left;
  LightState light = evenLight(kLeftRightLux);
  const float lamps = kLeftRightLux - light.ambient_lux;
  light.lamp_lux[0] = light.lamp_lux[1] = 0.5F * left_share * lamps;
  light.lamp_lux[2] = light.lamp_lux[3] = 0.5F * (1.0F - left_share) * lamps;
  return light;
}

LightState SceneLighting::movingLamp(double t) const {
  LightState light = evenLight(kDimRoomLux);
  light.moving_lux = kMovingLux;
  // It starts out of view at one side, and never repeats its way exactly.
  const double angle = kTwoPi * t / kSwingSeconds;
  const Eigen::Vector3f swing(static_cast<float>(std::sin(0.7 * angle)),
                              static_cast<float>(std::cos(angle)),
                              static_cast<float>(std::sin(1.9 * angle + 0.4)));
  light.moving_position = moving_center_ + moving_reach_.cwiseProduct(swing);
  return light;
}

}  // namespace mivo
