// SPDX-License-Identifier: BSD-3-Clause
#include <cstdint>

#include "kernel_data.h"

namespace mivo {
namespace {

using kernels::Kernels;
using testing::Array;
using testing::Columns;
using testing::forEachCase;
using testing::Numbers;

struct Bins {
  std::vector<std::int32_t> bin;
  Array fraction;
  kernels::BinsView view() const { return {bin.data(), fraction.data()}; }
};

Bins randomBins(std::size_t n, std::size_t offset, int num_bins, unsigned seed) {
  Numbers numbers(seed);
  Bins bins{{}, Array(n, offset)};
  for (std::size_t i = 0; i < n; ++i) {
    // Consecutive points in the same bin, and both ends of the axis.
    const float position = numbers.chance(0.3F)
                               ? (i % 2 == 0 ? 0.0F : static_cast<float>(num_bins - 1) - 1e-3F)
                               : numbers.between(0.0F, static_cast<float>(num_bins - 1) - 1e-3F);
    bins.bin.push_back(static_cast<std::int32_t>(position));
    bins.fraction[i] = position - static_cast<float>(bins.bin.back());
  }
  return bins;
}

TEST(VectorInformationTest, BinPositionsAgreeWithTheReference) {
  forEachCase([](const Kernels& kernels, std::size_t n, std::size_t offset) {
    Array values = Numbers(1).array(n, offset, -50.0F, 300.0F);
    const float awkward[] = {0.0F, 255.0F, 1e30F, -1e30F, 30.0F};
    for (std::size_t i = 0; i < n; i += 3) values[i] = awkward[i % 5];
    std::vector<std::int32_t> expected_bin(n + 1, -1);
    std::vector<std::int32_t> actual_bin(n + 1, -1);
    Array expected(n, offset);
    Array actual(n, offset);
    kernels::scalar().binPositions(values.data(), n, 30.0F, 7.0F / 200.0F, 6.999F,
                                   expected_bin.data(), expected.data());
    kernels.binPositions(values.data(), n, 30.0F, 7.0F / 200.0F, 6.999F, actual_bin.data(),
                         actual.data());
    EXPECT_EQ(actual_bin, expected_bin);
    for (std::size_t i = 0; i < n; ++i) EXPECT_EQ(actual[i], expected[i]);
    actual.expectGuarded();
  });
}

TEST(VectorInformationTest, HistogramsAgreeWithTheReference) {
  for (const int num_bins : {4, 8, 17}) {
    const int side = num_bins + 2;
    forEachCase([&](const Kernels& kernels, std::size_t n, std::size_t offset) {
      const Bins reference = randomBins(n, offset, num_bins, 2);
      const Bins live = randomBins(n, offset, num_bins, 3);
      const Array visible = Numbers(4).visible(n, offset);
      std::vector<float> scratch(kernels::histogramScratch(side), testing::kNan);
      const auto cells = static_cast<std::size_t>(side * side);
      std::vector<double> expected(cells, 1.0);  // the kernel adds to the previous values
      std::vector<double> actual(cells, 1.0);
      kernels::scalar().jointHistogram(reference.view(), live.view(), visible.data(), n, side,
                                       scratch.data(), expected.data());
      kernels.jointHistogram(reference.view(), live.view(), visible.data(), n, side, scratch.data(),
                             actual.data());
      for (std::size_t c = 0; c < cells; ++c)
        EXPECT_NEAR(actual[c], expected[c], 1e-5 * expected[c]);
    });
  }
}

TEST(VectorInformationTest, LogarithmsAgreeWithTheReference) {
  const std::vector<kernels::Backend> all = kernels::backends();
  for (const kernels::Backend& backend : all) {
    for (std::size_t n = 0; n < 30; ++n) {
      std::vector<double> values;
      const double awkward[] = {0.0, -1.0, 1.0, 1e-300, 1e300, 0.5, 1e-7};
      for (std::size_t i = 0; i < n; ++i) values.push_back(awkward[i % 7]);
      std::vector<double> actual(n + 1, 77.0);
      backend.kernels->logarithms(values.data(), n, actual.data());
      for (std::size_t i = 0; i < n; ++i) {
        const double expected = values[i] > 0.0 ? std::log(values[i]) : 0.0;
        EXPECT_NEAR(actual[i], expected, 1e-14 * (1.0 + std::abs(expected))) << backend.name;
      }
      EXPECT_EQ(actual[n], 77.0);
    }
  }
}

TEST(VectorInformationTest, DerivativesAgreeWithTheReference) {
  for (const int num_bins : {4, 8, 17}) {
    const int side = num_bins + 2;
    const auto cells = static_cast<std::size_t>(side * side);
    forEachCase([&](const Kernels& kernels, std::size_t n, std::size_t offset) {
      Numbers numbers(5);
      const Bins reference = randomBins(n, offset, num_bins, 6);
      const Bins live = randomBins(n, offset, num_bins, 7);
      const Array active = numbers.visible(n, offset);
      const Columns<6> jacobian(numbers, n, offset, -30.0F, 50.0F);
      const Columns<21> second(numbers, n, offset, -30.0F, 50.0F);
      Array rows_in(n * kernels::kRowFloats, offset);
      for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t k = 0; k < 6; ++k) rows_in[i * kernels::kRowFloats + k] = jacobian[k][i];
      }
      std::vector<float> log_ratio;
      for (std::size_t c = 0; c < cells; ++c) log_ratio.push_back(numbers.between(-7.0F, 0.0F));
      std::vector<float> expected_rows(cells * kernels::kRowFloats, 0.0F);
      std::vector<float> actual_rows(cells * kernels::kRowFloats, 0.0F);
      kernels::MiSums expected{};
      kernels::MiSums actual{};
      const auto run = [&](const Kernels& k, std::vector<float>& rows, kernels::MiSums& sums) {
        k.miDerivatives(reference.view(), live.view(), active.data(), rows_in.data(),
                        jacobian.data(), second.data(), n, side, 0.03F, log_ratio.data(),
                        rows.data(), sums);
      };
      run(kernels::scalar(), expected_rows, expected);
      run(kernels, actual_rows, actual);
      const double points = static_cast<double>(n);
      for (std::size_t i = 0; i < expected_rows.size(); ++i) {
        EXPECT_NEAR(actual_rows[i], expected_rows[i], 1e-5 * 50.0 * points);
      }
      for (int k = 0; k < 6; ++k) {
        EXPECT_NEAR(actual.gradient[k], expected.gradient[k], 1e-5 * 200.0 * points);
      }
      for (int k = 0; k < 21; ++k) {
        EXPECT_NEAR(actual.curvature[k], expected.curvature[k], 1e-5 * 500.0 * points);
      }
    });
  }
}

}  // namespace
}  // namespace mivo
