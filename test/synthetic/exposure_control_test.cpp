// SPDX-License-Identifier: BSD-3-Clause
#include "synthetic/exposure_control.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "mivo/core/error.h"

namespace mivo {
namespace {

// A gray wall: its value follows from light and exposure alone.
double grayOf(double light, const ExposureSetting& setting, const Imager& imager) {
  return imager.encode(light * setting.product());
}

std::vector<double> products(ExposureControlOptions options, const std::vector<double>& lights) {
  const Imager imager{ImagerOptions{}};
  const double target = imager.linear(options.target_gray);
  ExposureControl control(options, {target / lights.front(), 1.0});
  std::vector<double> result;
  for (const double light : lights) {
    result.push_back(control.current().product());
    control.advance(grayOf(light, control.current(), imager), imager);
  }
  return result;
}

TEST(ExposureControl, ReactsAfterItsDelayAndNotBefore) {
  for (const int delay : {1, 3, 10}) {
    ExposureControlOptions options;
    options.automatic = true;
    options.delay = delay;
    constexpr int kStep = 20;  // the light halves with this frame
    std::vector<double> lights(60, 20.0);
    std::fill(lights.begin() + kStep, lights.end(), 10.0);
    const std::vector<double> p = products(options, lights);
    for (int k = 0; k < kStep + delay; ++k) {
      EXPECT_NEAR(p[static_cast<std::size_t>(k)], p[0], 1e-9 * p[0]) << delay << " " << k;
    }
    // The first correction: half of the logarithmic distance to twice the exposure.
    EXPECT_NEAR(p[static_cast<std::size_t>(kStep + delay)] / p[0], std::sqrt(2.0), 0.01) << delay;
    EXPECT_NEAR(p.back() / p[0], 2.0, 0.01) << delay;
  }
}

TEST(ExposureControl, StaysFixedUnlessAutomatic) {
  std::vector<double> lights(30, 20.0);
  lights[10] = 1.0;
  for (const double product : products(ExposureControlOptions{}, lights)) {
    EXPECT_EQ(product, products(ExposureControlOptions{}, lights)[0]);
  }
}

TEST(ExposureControl, UsesGainOnlyWhenTimeIsUsedUp) {
  const ExposureControl control(ExposureControlOptions{}, {});
  EXPECT_DOUBLE_EQ(control.split(0.02).time, 0.02);
  EXPECT_DOUBLE_EQ(control.split(0.02).gain, 1.0);
  EXPECT_DOUBLE_EQ(control.split(0.12).time, 0.03);
  EXPECT_DOUBLE_EQ(control.split(0.12).gain, 4.0);
  EXPECT_DOUBLE_EQ(control.split(100.0).gain, 16.0);
  EXPECT_DOUBLE_EQ(control.split(1e-9).time, 0.0005);
}

TEST(ExposureControl, BlackImageAsksForTheMostTheCameraCanDo) {
  const Imager imager{ImagerOptions{}};
  ExposureControlOptions options;
  const ExposureControl control(options, {});
  EXPECT_DOUBLE_EQ(control.wantedProduct(0.02, 0.0, imager), options.max_time * options.max_gain);
}

TEST(ExposureControl, RefusesWhatCannotWork) {
  ExposureControlOptions options;
  options.delay = 0;
  EXPECT_THROW(ExposureControl(options, {}), Error);
  options = {};
  options.target_gray = 255.0;
  EXPECT_THROW(ExposureControl(options, {}), Error);
  options = {};
  options.max_time = 0.0001;
  EXPECT_THROW(ExposureControl(options, {}), Error);
}

}  // namespace
}  // namespace mivo
