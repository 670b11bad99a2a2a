// SPDX-License-Identifier: BSD-3-Clause
#include "synthetic/imager.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>

#include "mivo/core/error.h"

namespace mivo {
namespace {

ImagerOptions linearOptions() {
  ImagerOptions options;
  options.transfer = Transfer::kLinear;
  return options;
}

TEST(Imager, EncodingIsTheInverseOfLinear) {
  for (const Transfer transfer : {Transfer::kSrgb, Transfer::kLinear}) {
    ImagerOptions options;
    options.transfer = transfer;
    const Imager imager(options);
    for (double value = 0.0; value <= 255.0; value += 2.5) {
      EXPECT_NEAR(imager.encode(imager.linear(value)), value, 1e-2) << value;
    }
  }
  // IEC 61966-2-1: linear 0.2140 is encoded as one half.
  EXPECT_NEAR(Imager(ImagerOptions{}).encode(0.21404), 127.5, 0.01);
}

TEST(Imager, WithoutNoiseRoundsTheEncodedLight) {
  ImagerOptions options;
  options.noise = false;
  const Imager imager(options);
  for (const double light : {0.0, 0.001, 0.05, 0.2, 0.7, 1.0}) {
    const cv::Mat image =
        imager.expose(cv::Mat(4, 4, CV_32FC3, cv::Scalar::all(light)), 1.0, 3.0, 1);
    EXPECT_NEAR(image.at<cv::Vec3b>(2, 2)[1], imager.encode(light), 0.5 + 1e-2) << light;
  }
}

TEST(Imager, ShotAndReadNoiseHaveTheStatedVariance) {
  const Imager imager(linearOptions());
  for (const double gain : {1.0, 4.0}) {
    for (const double light : {0.2, 0.5}) {
      const cv::Mat image =
          imager.expose(cv::Mat(200, 200, CV_32FC1, cv::Scalar(light)), 1.0, gain, 3);
      cv::Scalar mean;
      cv::Scalar deviation;
      cv::meanStdDev(image, mean, deviation);
      const double electrons = light * 6000.0 / gain;
      const double noise = 255.0 * std::sqrt(electrons + 9.0 * 9.0) * gain / 6000.0;
      const double expected = std::sqrt(noise * noise + 1.0 / 12.0);  // rounding
      EXPECT_NEAR(mean[0], 255.0 * light, 5.0 * expected / 200.0) << light << " " << gain;
      EXPECT_NEAR(deviation[0] / expected, 1.0, 0.02) << light << " " << gain;
    }
  }
}

TEST(Imager, BlackImageHasReadNoiseAlone) {
  const Imager imager(linearOptions());
  const cv::Mat image = imager.expose(cv::Mat(200, 200, CV_32FC1, cv::Scalar(0.0)), 1.0, 8.0, 3);
  // Clipped at zero, the mean of a normal of deviation s is s / sqrt(2 pi) (up to rounding).
  const double s = 255.0 * 9.0 * 8.0 / 6000.0;
  EXPECT_NEAR(cv::mean(image)[0], s / std::sqrt(2.0 * CV_PI), 0.05);
}

TEST(Imager, Saturates) {
  const Imager imager(ImagerOptions{});
  const cv::Mat image = imager.expose(cv::Mat(20, 20, CV_32FC3, cv::Scalar::all(1e6)), 1.0, 1.0, 3);
  double low = 0.0;
  cv::minMaxLoc(image.reshape(1), &low);
  EXPECT_EQ(low, 255.0);
}

TEST(Imager, VignettingDarkensTheCornersByItsFraction) {
  ImagerOptions options = linearOptions();
  options.noise = false;
  options.vignetting = 0.4;
  const cv::Mat image =
      Imager(options).expose(cv::Mat(101, 101, CV_32FC1, cv::Scalar(0.8)), 1.0, 1.0, 1);
  EXPECT_EQ(image.at<uchar>(50, 50), 204);
  EXPECT_NEAR(image.at<uchar>(0, 0), 0.6 * 204, 1.0);
  EXPECT_NEAR(image.at<uchar>(50, 0), 0.8 * 204, 1.0);
}

TEST(Imager, ResultDependsOnTheSeedNotOnTheThreads) {
  const Imager imager(ImagerOptions{});
  const cv::Mat light(240, 320, CV_32FC3, cv::Scalar::all(0.1));
  const int threads = cv::getNumThreads();
  cv::setNumThreads(1);
  const cv::Mat one = imager.expose(light, 1.0, 2.0, 5);
  cv::setNumThreads(4);
  const cv::Mat four = imager.expose(light, 1.0, 2.0, 5);
  cv::setNumThreads(threads);
  EXPECT_EQ(cv::norm(one, four, cv::NORM_INF), 0.0);
  EXPECT_GT(cv::norm(one, imager.expose(light, 1.0, 2.0, 6), cv::NORM_INF), 0.0);
}

TEST(Imager, RefusesWhatIsNoSensor) {
  ImagerOptions options;
  options.full_well = 0.0;
  EXPECT_THROW(Imager{options}, Error);
  options = ImagerOptions{};
  options.read_noise = std::nan("");
  EXPECT_THROW(Imager{options}, Error);
  options = ImagerOptions{};
  options.vignetting = 1.0;
  EXPECT_THROW(Imager{options}, Error);
  EXPECT_THROW(Imager(ImagerOptions{}).expose(cv::Mat(4, 4, CV_8UC1), 1.0, 1.0, 1), Error);
}

}  // namespace
}  // namespace mivo
