// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "kernel_data.h"

namespace mivo {
namespace {

using kernels::Backend;
using kernels::ImageView;
using testing::Numbers;

struct Size {
  int width;
  int height;
};
// Widths from the smallest to several vectors, with all remainders.
std::vector<Size> awkwardSizes() {
  std::vector<Size> sizes = {{3, 3}, {4, 5}, {5, 4}, {640, 8}, {161, 31}};
  for (int width = 15; width < 150; width += 7) sizes.push_back({width, 9});
  for (int width = 60; width < 70; ++width) sizes.push_back({width, 12});
  return sizes;
}

cv::Mat randomBytes(const Size& size, unsigned seed) {
  cv::Mat image(size.height, size.width, CV_8UC1);
  Numbers numbers(seed);
  for (int y = 0; y < image.rows; ++y) {
    for (int x = 0; x < image.cols; ++x) {
      // Includes the extremes: 16-bit sums must not overflow.
      image.at<unsigned char>(y, x) =
          numbers.chance(0.5F) ? 255 : static_cast<unsigned char>(numbers.between(0.0F, 255.9F));
    }
  }
  return image;
}

cv::Mat asFloats(const cv::Mat& bytes) {
  cv::Mat floats;
  bytes.convertTo(floats, CV_32F);
  return floats;
}

ImageView viewOf(const cv::Mat& image) {
  const auto stride = static_cast<std::ptrdiff_t>(image.step1());
  if (image.type() == CV_8UC1) {
    return {nullptr, image.ptr<unsigned char>(), stride, image.cols, image.rows};
  }
  return {image.ptr<float>(), nullptr, stride, image.cols, image.rows};
}

std::vector<float> scratchFor(const Size& size) {
  return std::vector<float>(kernels::imageScratch(size.width));
}

template <typename Test>
void forEachImage(const Test& test) {
  for (const Backend& backend : kernels::backends()) {
    for (const Size& size : awkwardSizes()) {
      SCOPED_TRACE(backend.name + ", " + std::to_string(size.width) + " x " +
                   std::to_string(size.height));
      test(*backend.kernels, size);
      if (::testing::Test::HasFailure()) return;
    }
  }
}

TEST(ImageKernelTest, SmoothsLikeOpenCv) {
  forEachImage([](const kernels::Kernels& kernels, const Size& size) {
    const cv::Mat bytes = randomBytes(size, 1);
    cv::Mat expected;
    cv::sepFilter2D(bytes, expected, CV_32F, cv::Vec3f(0.25F, 0.5F, 0.25F),
                    cv::Vec3f(0.25F, 0.5F, 0.25F), cv::Point(-1, -1), 0.0, cv::BORDER_REFLECT_101);
    cv::Mat actual(size.height, size.width + 1, CV_8UC1, cv::Scalar(7));
    std::vector<float> scratch = scratchFor(size);
    kernels.smooth(viewOf(bytes), 255, actual.ptr<unsigned char>(),
                   static_cast<std::ptrdiff_t>(actual.step1()), scratch.data());
    EXPECT_LE(cv::norm(asFloats(actual.colRange(0, size.width)), expected, cv::NORM_INF), 0.5);
    EXPECT_EQ(cv::norm(actual.col(size.width), cv::Mat(size.height, 1, CV_8UC1, cv::Scalar(7)),
                       cv::NORM_INF),
              0.0);
  });
}

TEST(ImageKernelTest, WhatIsBesideAClippedPixelStaysAsItIs) {
  forEachImage([](const kernels::Kernels& kernels, const Size& size) {
    cv::Mat bytes(size.height, size.width, CV_8UC1, cv::Scalar(100));
    bytes.at<unsigned char>(1, size.width - 2) = 240;
    std::vector<float> scratch = scratchFor(size);
    for (const int largest : {239, 240}) {
      cv::Mat actual(size.height, size.width, CV_8UC1);
      kernels.smooth(viewOf(bytes), static_cast<std::uint8_t>(largest), actual.ptr<unsigned char>(),
                     static_cast<std::ptrdiff_t>(actual.step1()), scratch.data());
      EXPECT_EQ(actual.at<unsigned char>(1, size.width - 2), largest == 240 ? 135 : 240);
      EXPECT_EQ(cv::countNonZero(actual > 100), largest == 240 ? 9 : 1);
    }
  });
}

TEST(ImageKernelTest, ReducesLikePyrDown) {
  forEachImage([](const kernels::Kernels& kernels, const Size& size) {
    const cv::Mat bytes = randomBytes(size, 1);
    for (const cv::Mat& image : {bytes, asFloats(bytes)}) {
      cv::Mat expected;
      cv::pyrDown(asFloats(bytes), expected);
      cv::Mat actual(expected.rows, expected.cols + 1, CV_32FC1, cv::Scalar(-1.0F));
      std::vector<float> scratch = scratchFor(size);
      kernels.reduce(viewOf(image), actual.ptr<float>(),
                     static_cast<std::ptrdiff_t>(actual.step1()), scratch.data());
      EXPECT_LE(cv::norm(actual.colRange(0, expected.cols), expected, cv::NORM_INF), 1e-4);
      EXPECT_EQ(cv::norm(actual.col(expected.cols) + 1.0F, cv::NORM_INF), 0.0);
    }
  });
}

TEST(ImageKernelTest, MapsContrastLikeBoxFilters) {
  forEachImage([](const kernels::Kernels& kernels, const Size& size) {
    const cv::Mat image = asFloats(randomBytes(size, 2));
    cv::Mat mean;
    cv::Mat square;
    cv::boxFilter(image, mean, CV_64F, {5, 5}, {-1, -1}, true, cv::BORDER_REFLECT_101);
    cv::sqrBoxFilter(image, square, CV_64F, {5, 5}, {-1, -1}, true, cv::BORDER_REFLECT_101);
    cv::Mat pairs(size.height, size.width + 1, CV_32FC2, cv::Scalar::all(-1.0));
    std::vector<float> scratch = scratchFor(size);
    const double variances =
        kernels.contrastMap(viewOf(image), pairs.ptr<float>(),
                            static_cast<std::ptrdiff_t>(pairs.step1()), scratch.data());
    double sum = 0.0;
    for (int y = 0; y < size.height; ++y) {
      for (int x = 0; x < size.width; ++x) {
        const double m = mean.at<double>(y, x);
        const double variance = std::max(0.0, square.at<double>(y, x) - m * m);
        sum += variance;
        const auto& pair = pairs.at<cv::Vec2f>(y, x);
        EXPECT_NEAR(pair[0], m, 1e-3);
        EXPECT_NEAR(pair[1] * pair[1], variance, 0.05);
      }
      EXPECT_EQ(pairs.at<cv::Vec2f>(y, size.width)[0], -1.0F);
    }
    EXPECT_NEAR(variances / sum, 1.0, 1e-4);
  });
}

TEST(ImageKernelTest, NormalizesByTheInterpolatedMap) {
  forEachImage([](const kernels::Kernels& kernels, const Size& size) {
    const cv::Mat bytes = randomBytes(size, 3);
    cv::Mat map((size.height + 3) / 4 + 1, (size.width + 3) / 4 + 1, CV_32FC2);
    cv::theRNG().state = 4;
    cv::randu(map, cv::Scalar(50.0, 0.0), cv::Scalar(200.0, 60.0));
    const kernels::ContrastView contrast{map.ptr<float>(), static_cast<std::ptrdiff_t>(map.step1()),
                                         2.0F};
    for (const cv::Mat& image : {bytes, asFloats(bytes)}) {
      cv::Mat actual(size.height, size.width, CV_32FC1);
      std::vector<float> scratch = scratchFor(size);
      kernels.normalizeImage(viewOf(image), contrast, {2.0F, 128.0F, 55.0F, 255.0F},
                             actual.ptr<float>(), static_cast<std::ptrdiff_t>(actual.step1()),
                             scratch.data());
      for (int y = 0; y < size.height; ++y) {
        for (int x = 0; x < size.width; ++x) {
          const double t = 0.25 * (x % 4);
          const double s = 0.25 * (y % 4);
          cv::Vec2d m(0.0, 0.0);
          for (int j = 0; j < 2; ++j) {
            for (int i = 0; i < 2; ++i) {
              m += (j == 0 ? 1.0 - s : s) * (i == 0 ? 1.0 - t : t) *
                   cv::Vec2d(map.at<cv::Vec2f>(y / 4 + j, x / 4 + i));
            }
          }
          const double gray = 128.0 + 55.0 * (bytes.at<unsigned char>(y, x) - m[0]) / (m[1] + 2.0);
          EXPECT_NEAR(actual.at<float>(y, x), std::min(255.0, std::max(0.0, gray)), 5e-3);
        }
      }
    }
  });
}

TEST(ImageKernelTest, FindsTheSameGradientsAndMaximaAsTheReference) {
  forEachImage([](const kernels::Kernels& kernels, const Size& size) {
    const cv::Mat bytes = randomBytes(size, 5);
    // Blurred, so that neighbors differ little, and quantized, so that many are equal.
    cv::Mat smooth;
    cv::GaussianBlur(bytes, smooth, {3, 3}, 0.0);
    for (const cv::Mat& image : {bytes, smooth, asFloats(smooth)}) {
      const auto width = static_cast<std::size_t>(size.width);
      std::vector<std::vector<float>> expected(3, std::vector<float>(width + 1, -1.0F));
      std::vector<std::vector<float>> actual = expected;
      for (int y = 1; y + 1 < size.height; ++y) {
        const auto row = static_cast<std::size_t>(y % 3);
        kernels::scalar().gradientRow(viewOf(image), y, expected[row].data());
        kernels.gradientRow(viewOf(image), y, actual[row].data());
        EXPECT_EQ(actual[row], expected[row]);  // small integers: exact
        if (y < 3) continue;
        const float* squared[3];
        for (int k = 0; k < 3; ++k) {
          squared[k] = expected[static_cast<std::size_t>((y - 2 + k) % 3)].data();
        }
        std::vector<std::uint8_t> expected_maxima(width + 1, 9);
        std::vector<std::uint8_t> actual_maxima(width + 1, 9);
        kernels::scalar().maximaRow(viewOf(image), y - 1, squared, 4.0F, expected_maxima.data());
        kernels.maximaRow(viewOf(image), y - 1, squared, 4.0F, actual_maxima.data());
        EXPECT_EQ(actual_maxima, expected_maxima);
      }
    }
  });
}

}  // namespace
}  // namespace mivo
