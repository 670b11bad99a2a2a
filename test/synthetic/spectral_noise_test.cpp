// SPDX-License-Identifier: BSD-3-Clause
#include "synthetic/spectral_noise.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>

namespace mivo {
namespace {

// Mean power of all frequencies in a ring.
double ringPower(const cv::Mat& noise, double low, double high) {
  cv::Mat spectrum;
  cv::dft(noise, spectrum, cv::DFT_COMPLEX_OUTPUT);
  double sum = 0.0;
  int count = 0;
  for (int y = 0; y < noise.rows; ++y) {
    for (int x = 0; x < noise.cols; ++x) {
      const double f = std::hypot(x < noise.cols / 2 ? x : x - noise.cols,
                                  y < noise.rows / 2 ? y : y - noise.rows);
      if (f >= low && f < high) {
        const cv::Vec2f& value = spectrum.at<cv::Vec2f>(y, x);
        sum += value.dot(value);
        ++count;
      }
    }
  }
  return sum / count;
}

TEST(SpectralNoise, HasZeroMeanAndUnitDeviation) {
  cv::Scalar mean;
  cv::Scalar deviation;
  cv::meanStdDev(spectralNoise(128, {1.2, 3.0, 2.0}, 5), mean, deviation);
  EXPECT_NEAR(mean[0], 0.0, 1e-5);
  EXPECT_NEAR(deviation[0], 1.0, 1e-5);
}

TEST(SpectralNoise, AmplitudeFallsWithTheExponent) {
  for (const double exponent : {0.5, 1.0, 1.5}) {
    const cv::Mat noise = spectralNoise(256, {exponent, 1.0, 1.0}, 11);
    // Power ~ f^(-2 exponent): an octave apart the ratio is 4^exponent (of the rings' means, up to
    // the scatter of a few hundred frequencies).
    const double ratio = ringPower(noise, 15.5, 16.5) / ringPower(noise, 31.5, 32.5);
    EXPECT_NEAR(std::log2(ratio) / 2.0, exponent, 0.25) << exponent;
    const double far = ringPower(noise, 10.0, 14.0) / ringPower(noise, 80.0, 112.0);
    EXPECT_NEAR(std::log2(far) / 6.0, exponent, 0.1) << exponent;
  }
}

TEST(SpectralNoise, StretchMakesStructuresLonger) {
  const cv::Mat noise = spectralNoise(256, {1.0, 16.0, 1.0}, 3);
  const cv::Mat along = noise.colRange(1, 256) - noise.colRange(0, 255);
  const cv::Mat across = noise.rowRange(1, 256) - noise.rowRange(0, 255);
  EXPECT_LT(cv::norm(along), 0.6 * cv::norm(across));
}

TEST(SpectralNoise, IsPeriodic) {
  const cv::Mat noise = spectralNoise(128, {1.5, 1.0, 1.0}, 9);
  // The step over the border is like the steps inside.
  const double border = cv::norm(noise.col(0) - noise.col(127));
  const double inside = cv::norm(noise.col(64) - noise.col(63));
  EXPECT_LT(border, 2.0 * inside);
}

TEST(SpectralNoise, DependsOnTheSeedAlone) {
  EXPECT_EQ(cv::norm(spectralNoise(64, {}, 4), spectralNoise(64, {}, 4)), 0.0);
  EXPECT_GT(cv::norm(spectralNoise(64, {}, 4), spectralNoise(64, {}, 5)), 10.0);
}

}  // namespace
}  // namespace mivo
