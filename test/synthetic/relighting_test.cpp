// SPDX-License-Identifier: BSD-3-Clause
#include "synthetic/relighting.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

#include "mivo/core/error.h"

namespace mivo {
namespace {

constexpr int kFrames = 100;
const SequenceTime kTime{kFrames, 1.0 / 30.0};

cv::Mat grayWall(int value = 100) {
  return cv::Mat(120, 160, CV_8UC1, cv::Scalar(value));
}

std::vector<cv::Mat> relit(const std::string& lighting, const cv::Mat& image) {
  Relighting relighting(lighting, kTime, 3);
  std::vector<cv::Mat> images;
  for (int k = 0; k < kFrames; ++k) {
    images.push_back(relighting.relight(image));
  }
  return images;
}

double meanLight(const cv::Mat& image) {
  const Imager imager{ImagerOptions{}};
  double sum = 0.0;
  for (int y = 0; y < image.rows; ++y) {
    for (int x = 0; x < image.cols; ++x) {
      sum += imager.linear(image.at<uchar>(y, x));
    }
  }
  return sum / static_cast<double>(image.total());
}

TEST(Relighting, GlobalLightsMultiplyLinearLight) {
  const double before = meanLight(grayWall());
  for (const char* name : {"ramp", "step", "ramp_step", "oscillating"}) {
    const std::vector<cv::Mat> images = relit(name, grayWall());
    const LightingCurve curve = *lightingCurve(name);
    for (int k = 0; k < kFrames; k += 9) {
      const double factor = illuminance(curve, k * kTime.period, kTime) / nominalIlluminance(curve);
      EXPECT_NEAR(meanLight(images[static_cast<std::size_t>(k)]) / before, factor, 0.01)
          << name << " " << k;
    }
  }
}

TEST(Relighting, OscillationSpansAFactorOfFour) {
  const std::vector<cv::Mat> images = relit("oscillating", grayWall());
  double low = 1e9;
  double high = 0.0;
  for (const cv::Mat& image : images) {
    low = std::min(low, meanLight(image));
    high = std::max(high, meanLight(image));
  }
  EXPECT_NEAR(high / low, 32.7 / 7.9, 0.1);
}

TEST(Relighting, BlackFramesShowReadNoiseOnly) {
  const std::vector<cv::Mat> white = relit("black", grayWall(230));
  const std::vector<cv::Mat> dark = relit("black", grayWall(30));
  int black = 0;
  for (std::size_t k = 0; k < kFrames; ++k) {
    if (cv::mean(white[k])[0] < 20.0) {
      ++black;
      // No texture is left: the two recordings are equal.
      EXPECT_EQ(cv::norm(white[k], dark[k], cv::NORM_INF), 0.0) << k;
      EXPECT_GT(cv::mean(white[k])[0], 0.5) << k;
    }
  }
  EXPECT_EQ(black, 20);
}

TEST(Relighting, DarkFramesStillShowTheScene) {
  const std::size_t middle = kFrames / 2;
  const double bright = cv::mean(relit("darkness", grayWall(230))[middle])[0];
  const double dark = cv::mean(relit("darkness", grayWall(30))[middle])[0];
  EXPECT_LT(bright, 60.0);
  EXPECT_GT(bright, dark + 5.0);
}

TEST(Relighting, SpotSaturatesItsMiddleAndMoves) {
  const std::vector<cv::Mat> images = relit("spot", grayWall(140));
  cv::Point first;
  cv::Point later;
  double high = 0.0;
  EXPECT_GT(cv::countNonZero(images[0] == 255), 500);
  EXPECT_LT(cv::mean(images[0].row(0).colRange(0, 20))[0],
            140.0);  // away from it the light is halved
  cv::minMaxLoc(images[0], nullptr, &high, nullptr, &first);
  cv::minMaxLoc(images[40], nullptr, nullptr, nullptr, &later);
  EXPECT_EQ(high, 255.0);
  EXPECT_GT(cv::norm(first - later), 20.0);
}

TEST(Relighting, GradientKeepsTheCenter) {
  const std::vector<cv::Mat> images = relit("gradient", grayWall());
  const cv::Rect center(75, 55, 10, 10);
  double spread = 0.0;
  for (const cv::Mat& image : images) {
    EXPECT_NEAR(cv::mean(image(center))[0], 100.0, 3.0);
    spread = std::max(spread, std::abs(cv::mean(image.colRange(0, 10))[0] -
                                       cv::mean(image.colRange(150, 160))[0]));
  }
  EXPECT_GT(spread, 60.0);
}

TEST(Relighting, InversionFlipsTheSecondHalfExactly) {
  const std::vector<cv::Mat> images = relit("inversion", grayWall());
  EXPECT_EQ(cv::norm(images[49], grayWall(), cv::NORM_INF), 0.0);
  EXPECT_EQ(cv::norm(images[50], grayWall(155), cv::NORM_INF), 0.0);
}

TEST(Relighting, GammaKeepsBlackAndWhite) {
  for (const cv::Mat& image : relit("gamma", grayWall(0)))
    EXPECT_EQ(cv::norm(image, cv::NORM_INF), 0.0);
  for (const cv::Mat& image : relit("gamma", grayWall(255)))
    EXPECT_EQ(cv::countNonZero(image != 255), 0);
  EXPECT_NEAR(cv::mean(relit("gamma", grayWall())[11])[0], 255.0 * std::pow(100.0 / 255.0, 1.8),
              1.5);
}

TEST(Relighting, AutoExposureFollowsTenFramesLate) {
  const std::vector<cv::Mat> automatic = relit("auto_exposure", grayWall());
  const std::vector<cv::Mat> fixed = relit("oscillating", grayWall());
  // Until the first measurement takes effect, both lightings are equal.
  for (std::size_t k = 0; k < 10; ++k) {
    EXPECT_NEAR(cv::mean(automatic[k])[0], cv::mean(fixed[k])[0], 0.5) << k;
  }
  EXPECT_GT(std::abs(cv::mean(automatic[14])[0] - cv::mean(fixed[14])[0]), 3.0);
}

TEST(Relighting, ColorAndAlphaKeepTheirPlaces) {
  const cv::Mat image(60, 80, CV_8UC4, cv::Scalar(40, 90, 160, 77));
  Relighting relighting("step", kTime, 1);
  const cv::Mat changed = relighting.relight(image);
  ASSERT_EQ(changed.type(), CV_8UC4);
  const cv::Scalar mean = cv::mean(changed);
  EXPECT_NEAR(mean[0], 40.0, 1.0);
  EXPECT_NEAR(mean[1], 90.0, 1.0);
  EXPECT_NEAR(mean[2], 160.0, 1.0);
  EXPECT_EQ(mean[3], 77.0);
}

TEST(Relighting, SameSeedSameBytes) {
  EXPECT_EQ(cv::norm(relit("spot", grayWall())[7], relit("spot", grayWall())[7], cv::NORM_INF),
            0.0);
}

TEST(Relighting, RefusesUnknownNamesAndTypes) {
  EXPECT_THROW(Relighting("sunset", kTime, 1), Error);
  Relighting relighting("ramp", kTime, 1);
  EXPECT_THROW(relighting.relight(cv::Mat(4, 4, CV_16UC1)), Error);
}

}  // namespace
}  // namespace mivo
