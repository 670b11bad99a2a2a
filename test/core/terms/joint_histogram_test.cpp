// SPDX-License-Identifier: BSD-3-Clause
#include "core/terms/joint_histogram.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <opencv2/core.hpp>
#include <utility>

#include "support/analytic_image.h"
#include "support/reference_mutual_information.h"

namespace mivo {
namespace {

constexpr int kWidth = 100;
constexpr int kHeight = 80;

std::vector<double> intensities(const testing::AnalyticImage& image) {
  std::vector<double> values;
  for (int y = 0; y < kHeight; y += 2) {
    for (int x = 0; x < kWidth; x += 2) values.push_back(image({x, y}).value);
  }
  return values;
}

struct Axis {
  std::vector<double> values;
  IntensityRange range;
};

/// Pairs with different statistics on the two axes: skewed and symmetric, one falling where the
/// other rises, different ranges.
std::vector<std::pair<Axis, Axis>> pairs() {
  const Axis a{intensities(testing::waves()), {50.0F, 205.0F}};
  const Axis b{intensities(testing::blobs()), {35.0F, 180.0F}};
  const Axis c{intensities(testing::negativeOfWaves()), {40.0F, 170.0F}};
  return {{a, b}, {b, a}, {a, c}, {c, b}, {a, a}};
}

JointHistogram histogramOf(const Axis& reference, const Axis& live, int num_bins) {
  const Binning reference_binning(reference.range, num_bins);
  const Binning live_binning(live.range, num_bins);
  JointHistogram histogram(num_bins);
  histogram.clear();
  for (std::size_t i = 0; i < reference.values.size(); ++i) {
    histogram.add(reference_binning(static_cast<float>(reference.values[i])),
                  live_binning(static_cast<float>(live.values[i])));
  }
  histogram.normalize(reference.values.size());
  return histogram;
}

Eigen::MatrixXd bruteForce(const Axis& reference, const Axis& live, int num_bins) {
  std::vector<double> r;
  std::vector<double> l;
  for (std::size_t i = 0; i < reference.values.size(); ++i) {
    r.push_back(testing::binPlace(reference.values[i], reference.range, num_bins));
    l.push_back(testing::binPlace(live.values[i], live.range, num_bins));
  }
  return testing::jointProbabilities(r, l, num_bins);
}

TEST(JointHistogramTest, AgreesWithItsDefinitionCellByCell) {
  for (const int num_bins : {4, 8, 16}) {
    for (const auto& [reference, live] : pairs()) {
      const JointHistogram histogram = histogramOf(reference, live, num_bins);
      const Eigen::MatrixXd expected = bruteForce(reference, live, num_bins);
      ASSERT_EQ(histogram.side(), num_bins + 2);
      for (int r = 0; r < histogram.side(); ++r) {
        EXPECT_NEAR(histogram.referenceMarginal(r), expected.row(r).sum(), 2e-4);
        EXPECT_NEAR(histogram.liveMarginal(r), expected.col(r).sum(), 2e-4);
        for (int l = 0; l < histogram.side(); ++l) {
          // Clamped values lie a thousandth of a bin below the top.
          EXPECT_NEAR(histogram.joint(r, l), expected(r, l), 2e-4);
        }
      }
      EXPECT_NEAR(histogram.mutualInformation(), testing::mutualInformation(expected), 1e-3);
    }
  }
}

TEST(JointHistogramTest, MassIsOne) {
  for (const auto& [reference, live] : pairs()) {
    const JointHistogram histogram = histogramOf(reference, live, 8);
    double joint = 0.0;
    double marginal = 0.0;
    for (int r = 0; r < histogram.side(); ++r) {
      marginal += histogram.referenceMarginal(r);
      for (int l = 0; l < histogram.side(); ++l) joint += histogram.joint(r, l);
    }
    EXPECT_NEAR(joint, 1.0, 1e-6);
    EXPECT_NEAR(marginal, 1.0, 1e-6);
  }
}

TEST(JointHistogramTest, InformationIsBetweenZeroAndTheSmallerEntropy) {
  for (const auto& [reference, live] : pairs()) {
    const Eigen::MatrixXd joint = bruteForce(reference, live, 8);
    const double bound =
        std::min(testing::entropy(joint.rowwise().sum()), testing::entropy(joint.colwise().sum()));
    const double information = histogramOf(reference, live, 8).mutualInformation();
    EXPECT_GE(information, 0.0);
    EXPECT_LE(information, bound);
  }
}

TEST(JointHistogramTest, AnImageTellsMostAboutItself) {
  const auto cases = pairs();
  const Axis& waves = cases[0].first;
  const Axis& blobs = cases[0].second;
  const double own = histogramOf(waves, waves, 8).mutualInformation();
  EXPECT_GT(own, 0.5);
  EXPECT_LT(histogramOf(waves, blobs, 8).mutualInformation(), 0.2 * own);
  // The falling, curved response tells nearly as much: that is why the method uses it.
  EXPECT_GT(histogramOf(waves, cases[2].second, 8).mutualInformation(), 0.8 * own);
}

TEST(JointHistogramTest, IndependentAndConstantAxesShareNothing) {
  Axis columns{{}, {0.0F, 100.0F}};
  Axis rows{{}, {0.0F, 100.0F}};
  for (int i = 0; i < 50; ++i) {
    for (int j = 0; j < 50; ++j) {
      columns.values.push_back(2.0 * i);
      rows.values.push_back(1.5 * j);
    }
  }
  EXPECT_NEAR(histogramOf(columns, rows, 8).mutualInformation(), 0.0, 1e-6);
  const Axis constant{std::vector<double>(2500, 30.0), {0.0F, 100.0F}};
  EXPECT_NEAR(histogramOf(columns, constant, 8).mutualInformation(), 0.0, 1e-6);
  EXPECT_NEAR(histogramOf(constant, constant, 8).mutualInformation(), 0.0, 1e-6);
}

TEST(JointHistogramTest, SwappingTheImagesChangesNothing) {
  for (const auto& [reference, live] : pairs()) {
    EXPECT_NEAR(histogramOf(reference, live, 8).mutualInformation(),
                histogramOf(live, reference, 8).mutualInformation(), 1e-9);
  }
}

// The windows are symmetric, so mirroring an axis mirrors the table and no more, apart from the
// thousandth of a bin that clamped values stay below the top.
TEST(JointHistogramTest, InvertingAnImageChangesNothing) {
  for (const auto& [reference, live] : pairs()) {
    Axis inverted{live.values, {255.0F - live.range.high, 255.0F - live.range.low}};
    for (double& value : inverted.values) value = 255.0 - value;
    EXPECT_NEAR(histogramOf(reference, inverted, 8).mutualInformation(),
                histogramOf(reference, live, 8).mutualInformation(), 5e-4);
  }
}

TEST(JointHistogramTest, PartsAddUpAndClearForgets) {
  const auto [reference, live] = pairs()[0];
  const Binning r(reference.range, 8);
  const Binning l(live.range, 8);
  JointHistogram parts[2] = {JointHistogram(8), JointHistogram(8)};
  const std::size_t n = reference.values.size();
  parts[0].add(r(10.0F), l(10.0F));
  for (JointHistogram& part : parts) part.clear();
  for (std::size_t i = 0; i < n; ++i) {
    parts[i % 3 == 0 ? 1 : 0].add(r(static_cast<float>(reference.values[i])),
                                  l(static_cast<float>(live.values[i])));
  }
  parts[0].add(parts[1]);
  parts[0].normalize(n);
  EXPECT_NEAR(parts[0].mutualInformation(), histogramOf(reference, live, 8).mutualInformation(),
              1e-12);
}

TEST(JointHistogramTest, NoPairsAtAllAreNoInformation) {
  JointHistogram histogram(8);
  histogram.clear();
  histogram.normalize(0);
  EXPECT_EQ(histogram.mutualInformation(), 0.0);
  EXPECT_EQ(histogram.referenceMarginal(3), 0.0);
}

TEST(BinningTest, TheRangeFillsTheBinsAndTheRestIsClamped) {
  const Binning binning({50.0F, 120.0F}, 8);
  EXPECT_FLOAT_EQ(binning.binsPerGrayLevel(), 0.1F);
  const BinPosition middle = binning(73.0F);
  EXPECT_EQ(middle.bin, 2);
  EXPECT_NEAR(middle.fraction, 0.3F, 1e-5);
  EXPECT_FALSE(middle.is_clamped);
  const BinPosition low = binning(20.0F);
  EXPECT_EQ(low.bin, 0);
  EXPECT_EQ(low.fraction, 0.0F);
  EXPECT_TRUE(low.is_clamped);
  const BinPosition high = binning(200.0F);
  EXPECT_EQ(high.bin, 6);  // its window ends in the last row of the table
  EXPECT_NEAR(high.fraction, 1.0F, 0.002);
  EXPECT_LT(high.fraction, 1.0F);
  EXPECT_TRUE(high.is_clamped);
  EXPECT_FALSE(binning(50.0F).is_clamped);
}

TEST(IntensityRangeTest, QuantilesAreCutOffBothEnds) {
  cv::Mat image(10, 100, CV_32FC1);
  for (int i = 0; i < 1000; ++i) {
    image.at<float>(i / 100, i % 100) = 50.0F + static_cast<float>(i / 10);
  }
  image.at<float>(0, 0) = 0.0F;  // one of a thousand
  image.at<float>(9, 99) = 255.0F;
  EXPECT_EQ(intensityRange(image, 0.0).low, 0.0F);
  EXPECT_EQ(intensityRange(image, 0.0).high, 255.0F);
  EXPECT_EQ(intensityRange(image, 0.005).low, 50.0F);
  EXPECT_EQ(intensityRange(image, 0.005).high, 149.0F);
  EXPECT_NEAR(intensityRange(image, 0.1).low, 60.0F, 1.0F);
  EXPECT_NEAR(intensityRange(image, 0.1).high, 139.0F, 1.0F);
}

TEST(IntensityRangeTest, AConstantImageHasARangeOfOneLevel) {
  for (const float value : {0.0F, 128.0F, 255.0F}) {
    const IntensityRange range = intensityRange(cv::Mat(5, 5, CV_32FC1, cv::Scalar(value)), 0.005);
    EXPECT_GE(range.high - range.low, 1.0F) << value;
    EXPECT_LE(range.low, value);
    EXPECT_GE(range.high, value);
  }
}

}  // namespace
}  // namespace mivo
