// SPDX-License-Identifier: BSD-3-Clause
#include "synthetic/lighting_curve.h"

#include <algorithm>
#include <cmath>

namespace mivo {
namespace {

double mix(double from, double to, double weight) {
  return from + (to - from) * std::clamp(weight, 0.0, 1.0);
}

// Half a period of margin: a frame's rows and exposure reach over the frame's own time.
bool inDarkFrames(double t, const SequenceTime& time) {
  const int first = (time.frames - kDarkFrames) / 2;
  const double frame = t / time.period;
  return frame >= first - 0.5 && frame < first + kDarkFrames - 0.5;
}

}  // namespace

std::optional<LightingCurve> lightingCurve(const std::string& name) {
  if (name == "constant") return LightingCurve::kConstant;
  if (name == "ramp") return LightingCurve::kRamp;
  if (name == "step") return LightingCurve::kStep;
  if (name == "ramp_step") return LightingCurve::kRampStep;
  if (name == "oscillating") return LightingCurve::kOscillating;
  if (name == "darkness") return LightingCurve::kDarkness;
  if (name == "black") return LightingCurve::kBlack;
  return std::nullopt;
}

double illuminance(LightingCurve curve, double t, const SequenceTime& time) {
  const double progress = time.frames > 1 ? t / time.duration() : 0.0;
  switch (curve) {
    case LightingCurve::kConstant:
      return kBrightLux;
    case LightingCurve::kRamp:
      return mix(kBrightLux, kDimLux, (progress - 0.1) / 0.8);
    case LightingCurve::kStep:
      return progress < 0.5 ? kBrightLux : kDimLux;
    case LightingCurve::kRampStep:
      return progress < 0.7 ? mix(kBrightLux, kDimLux, progress / 0.7) : kBrightLux;
    case LightingCurve::kOscillating: {
      const double middle = 0.5 * (kOscillationLowLux + kOscillationHighLux);
      const double amplitude = 0.5 * (kOscillationHighLux - kOscillationLowLux);
      return middle + amplitude * std::sin(2.0 * std::acos(-1.0) * kOscillationHertz * t);
    }
    case LightingCurve::kDarkness:
      return inDarkFrames(t, time) ? kDarknessLux : kBrightLux;
    case LightingCurve::kBlack:
      return inDarkFrames(t, time) ? 0.0 : kBrightLux;
  }
  return kBrightLux;
}

double nominalIlluminance(LightingCurve curve) {
  return curve == LightingCurve::kOscillating ? 0.5 * (kOscillationLowLux + kOscillationHighLux)
                                              : kBrightLux;
}

}  // namespace mivo
