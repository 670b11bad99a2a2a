// SPDX-License-Identifier: BSD-3-Clause
#include "synthetic/lighting_curve.h"

#include <gtest/gtest.h>

namespace mivo {
namespace {

const SequenceTime kTime{301, 1.0 / 30.0};  // 10 s

double lux(LightingCurve curve, double t) {
  return illuminance(curve, t, kTime);
}

TEST(LightingCurve, RampGoesFrom61To9Point8Lux) {
  EXPECT_DOUBLE_EQ(lux(LightingCurve::kRamp, 0.0), 61.0);
  EXPECT_DOUBLE_EQ(lux(LightingCurve::kRamp, 1.0), 61.0);
  EXPECT_NEAR(lux(LightingCurve::kRamp, 5.0), 0.5 * (61.0 + 9.8), 1e-9);
  EXPECT_NEAR(lux(LightingCurve::kRamp, 9.0), 9.8, 1e-9);
  EXPECT_DOUBLE_EQ(lux(LightingCurve::kRamp, 10.0), 9.8);
}

TEST(LightingCurve, StepFallsInTheMiddle) {
  EXPECT_DOUBLE_EQ(lux(LightingCurve::kStep, 4.99), 61.0);
  EXPECT_DOUBLE_EQ(lux(LightingCurve::kStep, 5.0), 9.8);
  EXPECT_DOUBLE_EQ(lux(LightingCurve::kStep, 10.0), 9.8);
}

TEST(LightingCurve, RampStepRampsDownAndJumpsBack) {
  EXPECT_DOUBLE_EQ(lux(LightingCurve::kRampStep, 0.0), 61.0);
  EXPECT_NEAR(lux(LightingCurve::kRampStep, 3.5), 0.5 * (61.0 + 9.8), 1e-9);
  EXPECT_NEAR(lux(LightingCurve::kRampStep, 6.999), 9.8, 0.01);
  EXPECT_DOUBLE_EQ(lux(LightingCurve::kRampStep, 7.001), 61.0);
}

TEST(LightingCurve, OscillatesBetween7Point9And32Point7LuxOnceASecond) {
  EXPECT_NEAR(lux(LightingCurve::kOscillating, 0.25), 32.7, 1e-9);
  EXPECT_NEAR(lux(LightingCurve::kOscillating, 0.75), 7.9, 1e-9);
  EXPECT_NEAR(lux(LightingCurve::kOscillating, 0.0),
              nominalIlluminance(LightingCurve::kOscillating), 1e-9);
  for (const double t : {0.1, 0.37, 0.8}) {
    EXPECT_NEAR(lux(LightingCurve::kOscillating, t), lux(LightingCurve::kOscillating, t + 3.0),
                1e-9);
  }
}

TEST(LightingCurve, ExactlyTwentyFramesAreDark) {
  for (const int frames : {40, 41, 150, 301}) {
    const SequenceTime time{frames, 1.0 / 30.0};
    int dark = 0;
    int black = 0;
    for (int k = 0; k < frames; ++k) {
      dark += illuminance(LightingCurve::kDarkness, k * time.period, time) == kDarknessLux ? 1 : 0;
      black += illuminance(LightingCurve::kBlack, k * time.period, time) == 0.0 ? 1 : 0;
    }
    EXPECT_EQ(dark, 20) << frames;
    EXPECT_EQ(black, 20) << frames;
    EXPECT_EQ(illuminance(LightingCurve::kDarkness, 0.0, time), 61.0);
    EXPECT_EQ(illuminance(LightingCurve::kDarkness, time.duration(), time), 61.0);
  }
}

TEST(LightingCurve, StartsAtItsNominalLight) {
  for (const char* name :
       {"constant", "ramp", "step", "ramp_step", "oscillating", "darkness", "black"}) {
    const auto curve = lightingCurve(name);
    ASSERT_TRUE(curve) << name;
    EXPECT_NEAR(lux(*curve, 0.0), nominalIlluminance(*curve), 1e-9) << name;
  }
  EXPECT_FALSE(lightingCurve("sunset"));
}

}  // namespace
}  // namespace mivo
