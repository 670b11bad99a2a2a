// SPDX-License-Identifier: BSD-3-Clause
#include "core/keyframe/point_selection.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <opencv2/core.hpp>
#include <set>
#include <utility>

#include "support/analytic_image.h"
#include "support/random_pose.h"

namespace mivo {
namespace {

constexpr int kWidth = 96;
constexpr int kHeight = 64;

cv::Mat flatDepth() {
  return {kHeight, kWidth, CV_32FC1, cv::Scalar(2.0F)};
}

SelectionLimits limits(int num_points) {
  return {num_points, num_points, 1.0F, 16, 0.06F};
}

std::vector<Pixel> salientPixels(const cv::Mat& image, const cv::Mat& depth,
                                 const SelectionLimits& limits) {
  std::vector<Pixel> pixels = {{1, 1}};  // the previous content is discarded
  const std::size_t num_leading = selectSalient(image, depth, limits, pixels);
  EXPECT_EQ(num_leading, pixels.size());
  return pixels;
}

std::vector<Pixel> allPixels(const cv::Mat& depth) {
  std::vector<Pixel> pixels = {{1, 1}};
  selectAll(depth, pixels);
  return pixels;
}

TEST(SelectEvenlyTest, AboutSoManyPixelsWithDepthFromEverywhere) {
  cv::Mat depth(60, 80, CV_32FC1, cv::Scalar(1.5));
  depth(cv::Rect(0, 0, 40, 60)).setTo(0.0F);
  std::vector<Pixel> pixels;
  selectEvenly(depth, 200, pixels);
  EXPECT_GE(pixels.size(), 200U);
  EXPECT_LT(pixels.size(), 220U);
  std::array<int, 4> quarters{};  // quarters of the half that has depth
  for (const Pixel& pixel : pixels) {
    EXPECT_GE(pixel.x, 40);
    ++quarters[static_cast<std::size_t>(2 * (pixel.y >= 30) + (pixel.x >= 60))];
  }
  for (const int count : quarters) EXPECT_GT(count, 40);
  selectEvenly(depth, 100000, pixels);
  EXPECT_EQ(pixels.size(), allPixels(depth).size());
  selectEvenly(cv::Mat::zeros(60, 80, CV_32FC1), 200, pixels);
  EXPECT_TRUE(pixels.empty());
}

cv::Mat noiseImage(std::uint64_t seed) {
  testing::Random random(seed);
  cv::Mat image(kHeight, kWidth, CV_32FC1);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      image.at<float>(y, x) = static_cast<float>(random.uniform(0.0, 255.0));
    }
  }
  return image;
}

float squaredGradient(const cv::Mat& image, int x, int y) {
  const float gx = 0.5F * (image.at<float>(y, x + 1) - image.at<float>(y, x - 1));
  const float gy = 0.5F * (image.at<float>(y + 1, x) - image.at<float>(y - 1, x));
  return gx * gx + gy * gy;
}

std::map<std::pair<int, int>, int> countsPerCell(const std::vector<Pixel>& pixels, int size) {
  std::map<std::pair<int, int>, int> counts;
  for (const Pixel& pixel : pixels) ++counts[{pixel.x / size, pixel.y / size}];
  return counts;
}

bool isSame(const std::vector<Pixel>& a, const std::vector<Pixel>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const Pixel& p, const Pixel& q) { return p.x == q.x && p.y == q.y; });
}

// A blurred edge in any direction: of the pixels across it only the one with the largest gradient
// is kept.
TEST(SelectSalientTest, AnEdgeBecomesAThinLine) {
  for (double angle = 0.05; angle < 3.1; angle += 0.4) {
    const Eigen::Vector2d normal(std::cos(angle), std::sin(angle));
    const double place = normal.dot(Eigen::Vector2d(47.7, 31.6));
    const auto step = [&](const Eigen::Vector2d& p) {
      return testing::ImageJet{
          128.0 + 100.0 * std::tanh(0.4 * (normal.dot(p) - place)), {0, 0}, {}};
    };
    const cv::Mat image = testing::rasterized(step, kWidth, kHeight);
    const std::vector<Pixel> pixels = salientPixels(image, flatDepth(), limits(100000));
    ASSERT_GT(pixels.size(), 30U) << angle;
    for (const Pixel& pixel : pixels) {
      const double distance = std::abs(normal.dot(Eigen::Vector2d(pixel.x, pixel.y)) - place);
      EXPECT_LT(distance, 1.2) << "angle " << angle << " at " << pixel.x << ' ' << pixel.y;
    }
  }
}

TEST(SelectSalientTest, OfTwoEquallySteepPixelsExactlyOneIsTaken) {
  cv::Mat image(kHeight, kWidth, CV_32FC1, cv::Scalar(20.0F));
  image.colRange(40, kWidth) = 220.0F;  // gradient 100 in the columns 39 and 40
  const std::vector<Pixel> pixels = salientPixels(image, flatDepth(), limits(100000));
  EXPECT_EQ(pixels.size(), static_cast<std::size_t>(kHeight - 4));
  std::set<int> columns;
  for (const Pixel& pixel : pixels) columns.insert(pixel.x);
  EXPECT_EQ(columns.size(), 1U);
}

TEST(SelectSalientTest, NoMoreThanAskedForAndTheSameFromEveryFullCell) {
  for (const int wanted : {24, 100, 250}) {
    const std::vector<Pixel> pixels = salientPixels(noiseImage(1), flatDepth(), limits(wanted));
    const auto counts = countsPerCell(pixels, 16);
    EXPECT_EQ(counts.size(), 24U);
    EXPECT_LE(pixels.size(), static_cast<std::size_t>(wanted));
    for (const auto& [cell, count] : counts) EXPECT_EQ(count, wanted / 24) << cell.first;
  }
}

TEST(SelectSalientTest, WhatEmptyCellsDoNotUseGoesToTheOthers) {
  cv::Mat image = noiseImage(2);
  image.colRange(0, 48) = 100.0F;  // no candidates in the left half
  const std::vector<Pixel> pixels = salientPixels(image, flatDepth(), limits(240));
  EXPECT_LE(pixels.size(), 240U);
  // The 12 cells on the right get the points of all 24, up to one per cell.
  EXPECT_GT(pixels.size(), 240U - 15U);
}

TEST(SelectSalientTest, ThoseThatASmallerNumberChoosesComeFirst) {
  const cv::Mat image = noiseImage(4);
  for (const int wanted : {120, 400, 100000}) {
    for (const int leading : {24, 119, 120}) {
      SelectionLimits both = limits(wanted);
      both.num_leading = leading;
      std::vector<Pixel> pixels;
      const std::size_t num_leading = selectSalient(image, flatDepth(), both, pixels);
      const std::vector<Pixel> first = {pixels.begin(),
                                        pixels.begin() + static_cast<std::ptrdiff_t>(num_leading)};
      EXPECT_TRUE(isSame(first, salientPixels(image, flatDepth(), limits(leading))));
      std::sort(pixels.begin(), pixels.end(), [](const Pixel& a, const Pixel& b) {
        return std::pair(a.y, a.x) < std::pair(b.y, b.x);
      });
      EXPECT_TRUE(isSame(pixels, salientPixels(image, flatDepth(), limits(wanted))));
    }
  }
}

TEST(SelectSalientTest, EachCellGivesItsSteepestPoints) {
  const cv::Mat image = noiseImage(3);
  const std::vector<Pixel> all = salientPixels(image, flatDepth(), limits(100000));
  const std::vector<Pixel> some = salientPixels(image, flatDepth(), limits(120));
  std::map<std::pair<int, int>, std::vector<float>> strengths;
  for (const Pixel& p : all) {
    strengths[{p.x / 16, p.y / 16}].push_back(squaredGradient(image, p.x, p.y));
  }
  for (auto& entry : strengths) {
    std::sort(entry.second.begin(), entry.second.end(), std::greater<float>());
  }
  for (const Pixel& p : some) {
    const std::vector<float>& cell = strengths[{p.x / 16, p.y / 16}];
    EXPECT_GE(squaredGradient(image, p.x, p.y), cell[4]);
  }
}

// Compared with sorting all candidates of each cell. Few gray levels give many equal gradients.
TEST(SelectSalientTest, OfEquallySteepPixelsTheEarlierOnesAreTaken) {
  cv::Mat image;
  noiseImage(8).convertTo(image, CV_8UC1, 4.0 / 255.0);
  const std::vector<Pixel> all = salientPixels(image, flatDepth(), limits(100000));
  cv::Mat gray;
  image.convertTo(gray, CV_32FC1);
  std::map<std::pair<int, int>, std::vector<Pixel>> cells;
  for (const Pixel& p : all) cells[{p.x / 16, p.y / 16}].push_back(p);
  std::set<std::pair<int, int>> expected;
  for (auto& entry : cells) {
    std::stable_sort(entry.second.begin(), entry.second.end(), [&](const Pixel& a, const Pixel& b) {
      return squaredGradient(gray, a.x, a.y) > squaredGradient(gray, b.x, b.y);
    });
    ASSERT_GT(entry.second.size(), 5U);
    for (std::size_t i = 0; i < 5; ++i) expected.insert({entry.second[i].x, entry.second[i].y});
  }
  std::set<std::pair<int, int>> actual;
  for (const Pixel& p : salientPixels(image, flatDepth(), limits(5 * 24))) {
    actual.insert({p.x, p.y});
  }
  EXPECT_EQ(actual, expected);
}

TEST(SelectSalientTest, WeakGradientsAreNoPoints) {
  const cv::Mat image =
      testing::rasterized(testing::waveImage(128.0, {{3.0, {0.25, 0.0}, 0.0}}), kWidth, kHeight);
  // The gradient's amplitude is 3 * sin(0.25) = 0.742.
  SelectionLimits low = limits(100000);
  low.min_gradient = 0.70F;
  EXPECT_FALSE(salientPixels(image, flatDepth(), low).empty());
  low.min_gradient = 0.76F;
  EXPECT_TRUE(salientPixels(image, flatDepth(), low).empty());
}

TEST(SelectSalientTest, AConstantImageHasNoPoints) {
  SelectionLimits none = limits(100);
  none.min_gradient = 0.0F;
  const cv::Mat image(kHeight, kWidth, CV_32FC1, cv::Scalar(77.0F));
  EXPECT_TRUE(salientPixels(image, flatDepth(), none).empty());
}

TEST(SelectSalientTest, NoPointIsOnADepthEdgeOrAHole) {
  cv::Mat depth = flatDepth();
  depth.colRange(50, kWidth) = 1.0F;
  depth(cv::Rect(10, 10, 9, 7)) = 0.0F;
  const std::vector<Pixel> pixels = salientPixels(noiseImage(4), depth, limits(100000));
  ASSERT_GT(pixels.size(), 200U);
  for (const Pixel& pixel : pixels) {
    double lowest = 0.0;
    double highest = 0.0;
    cv::minMaxLoc(depth(cv::Rect(pixel.x - 1, pixel.y - 1, 3, 3)), &lowest, &highest);
    EXPECT_TRUE(lowest > 0.0 && highest - lowest <= 0.06 * depth.at<float>(pixel.y, pixel.x));
    EXPECT_TRUE(pixel.x < 49 || pixel.x > 50);
  }
}

TEST(SelectSalientTest, PointsKeepTwoPixelsFromTheBorderAndComeInReadingOrder) {
  const std::vector<Pixel> pixels = salientPixels(noiseImage(5), flatDepth(), limits(300));
  int before = -1;
  for (const Pixel& pixel : pixels) {
    EXPECT_GE(pixel.x, 2);
    EXPECT_GE(pixel.y, 2);
    EXPECT_LT(pixel.x, kWidth - 2);
    EXPECT_LT(pixel.y, kHeight - 2);
    EXPECT_GT(pixel.y * kWidth + pixel.x, before);
    before = pixel.y * kWidth + pixel.x;
  }
}

TEST(SelectSalientTest, TheSameImageGivesTheSamePoints) {
  const std::vector<Pixel> first = salientPixels(noiseImage(6), flatDepth(), limits(300));
  EXPECT_TRUE(isSame(first, salientPixels(noiseImage(6), flatDepth(), limits(300))));
  EXPECT_FALSE(isSame(first, salientPixels(noiseImage(7), flatDepth(), limits(300))));
}

TEST(SelectAllTest, EveryPixelWithDepthButTheBorder) {
  EXPECT_EQ(allPixels(flatDepth()).size(), static_cast<std::size_t>((kWidth - 2) * (kHeight - 2)));
  cv::Mat depth = flatDepth();
  depth.at<float>(20, 30) = 0.0F;
  EXPECT_EQ(allPixels(depth).size(), static_cast<std::size_t>((kWidth - 2) * (kHeight - 2) - 1));
  for (const Pixel& pixel : allPixels(depth)) EXPECT_FALSE(pixel.x == 30 && pixel.y == 20);
  EXPECT_TRUE(allPixels(cv::Mat(2, 2, CV_32FC1, cv::Scalar(1.0F))).empty());
}

}  // namespace
}  // namespace mivo
