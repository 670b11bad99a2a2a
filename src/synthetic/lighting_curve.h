// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

namespace mivo {

/// How the light on the scene changes over a sequence. The generator dims its lamps by these
/// curves, relighting multiplies recorded images by them.
enum class LightingCurve {
  kConstant,     ///< 61 lux
  kRamp,         ///< 61 lux falling to 9.8 lux between 10 % and 90 % of the time
  kStep,         ///< 61 lux, 9.8 lux from the middle on
  kRampStep,     ///< 61 lux falling to 9.8 lux until 70 % of the time, then 61 lux at once
  kOscillating,  ///< 7.9 to 32.7 lux, a sine of 1 Hz starting in the middle
  kDarkness,     ///< 61 lux, 0.4 lux during the 20 frames in the middle
  kBlack         ///< 61 lux, no light at all during the 20 frames in the middle
};

/// Frames `0 .. frames - 1` at times `k * period` seconds.
struct SequenceTime {
  int frames = 0;
  double period = 1.0 / 30.0;

  double duration() const { return (frames - 1) * period; }
};

constexpr double kBrightLux = 61.0;
constexpr double kDimLux = 9.8;
constexpr double kOscillationLowLux = 7.9;
constexpr double kOscillationHighLux = 32.7;
constexpr double kOscillationHertz = 1.0;
constexpr double kDarknessLux = 0.4;
constexpr int kDarkFrames = 20;

/// The curve of this name (constant, ramp, step, ramp_step, oscillating, darkness, black), or
/// nothing.
std::optional<LightingCurve> lightingCurve(const std::string& name);

/// Lux at the time `t` (s, from the first frame).
double illuminance(LightingCurve curve, double t, const SequenceTime& time);

/// What an undisturbed recording is taken to have been lit by: the level the curve starts from.
double nominalIlluminance(LightingCurve curve);

}  // namespace mivo
