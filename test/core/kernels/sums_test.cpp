// SPDX-License-Identifier: BSD-3-Clause
#include <numeric>

#include "kernel_data.h"

namespace mivo {
namespace {

using kernels::Kernels;
using testing::Array;
using testing::Columns;
using testing::forEachCase;
using testing::kHeight;
using testing::kInfinity;
using testing::kNan;
using testing::kWidth;
using testing::Numbers;

// Tolerance of sums over at most 512 floats, relative to the sum of magnitudes.
constexpr double kSumTolerance = 3e-6;
const RobustWeight kKinds[] = {RobustWeight::kNone, RobustWeight::kHuber, RobustWeight::kTukey,
                               RobustWeight::kStudentT};

/// Residuals of all sizes: zero, tiny, at the thresholds of the losses, huge. Those of invisible
/// points are arbitrary.
Array awkwardResiduals(const Array& visible, std::size_t offset, float scale) {
  Numbers numbers(static_cast<unsigned>(visible.size() + 1));
  Array residual = numbers.array(visible.size(), offset, -4.0F * scale, 4.0F * scale);
  const float awkward[] = {0.0F, -0.0F, 1e-30F, 1.345F * scale, -4.685F * scale, 1e4F * scale};
  for (std::size_t i = 0; i < residual.size(); ++i) {
    if (numbers.chance(0.2F)) residual[i] = awkward[i % 6];
    if (visible[i] == 0.0F) residual[i] = kNan;
  }
  return residual;
}

TEST(VectorSumsTest, ResidualsAgreeWithTheReference) {
  forEachCase([](const Kernels& kernels, std::size_t n, std::size_t offset) {
    Numbers numbers(5);
    const Array live = numbers.array(n, offset, -3.0F, 255.0F);
    const Array contrast = numbers.array(n, offset, 0.2F, 60.0F);
    const Array reference = numbers.array(n, offset, -100.0F, 255.0F);
    const Array visible = numbers.visible(n, offset);
    Array expected(n, offset);
    Array actual(n, offset);
    kernels::scalar().residuals(live.data(), contrast.data(), reference.data(), visible.data(), n,
                                expected.data());
    kernels.residuals(live.data(), contrast.data(), reference.data(), visible.data(), n,
                      actual.data());
    for (std::size_t i = 0; i < n; ++i) {
      EXPECT_NEAR(actual[i], expected[i], 1e-6F * std::abs(contrast[i] * live[i]));
    }
    actual.expectGuarded();
  });
}

TEST(VectorSumsTest, CostsAgreeWithTheReference) {
  for (const RobustWeight kind : kKinds) {
    for (const float scale : {0.5F, 7.0F}) {
      forEachCase([&](const Kernels& kernels, std::size_t n, std::size_t offset) {
        const Array visible = Numbers(6).visible(n, offset);
        const Array residual = awkwardResiduals(visible, offset, scale);
        const double expected =
            kernels::scalar().robustCost(kind, scale, residual.data(), visible.data(), n);
        const double actual = kernels.robustCost(kind, scale, residual.data(), visible.data(), n);
        EXPECT_NEAR(actual, expected, kSumTolerance * expected);
      });
    }
  }
}

TEST(VectorSumsTest, WeightsAgreeWithTheReference) {
  for (const RobustWeight kind : kKinds) {
    forEachCase([&](const Kernels& kernels, std::size_t n, std::size_t offset) {
      const Array visible = Numbers(9).visible(n, offset);
      const Array residual = awkwardResiduals(visible, offset, 2.0F);
      Array expected(n, offset);
      Array actual(n, offset);
      kernels::scalar().robustWeights(kind, 2.0F, residual.data(), visible.data(), n,
                                      expected.data());
      kernels.robustWeights(kind, 2.0F, residual.data(), visible.data(), n, actual.data());
      for (std::size_t i = 0; i < n; ++i) EXPECT_NEAR(actual[i], expected[i], 2e-6F);
      actual.expectGuarded();
    });
  }
}

TEST(VectorSumsTest, NormalEquationsAgreeWithTheReference) {
  for (const RobustWeight kind : kKinds) {
    forEachCase([&](const Kernels& kernels, std::size_t n, std::size_t offset) {
      Numbers numbers(7);
      const Array visible = numbers.visible(n, offset);
      const Array residual = awkwardResiduals(visible, offset, 2.0F);
      const Columns<6> jacobian(numbers, n, offset, -300.0F, 500.0F);
      kernels::LeastSquaresSums expected{};
      kernels::LeastSquaresSums actual{};
      kernels::scalar().accumulateLeastSquares(kind, 2.0F, residual.data(), visible.data(),
                                               jacobian.data(), n, expected);
      kernels.accumulateLeastSquares(kind, 2.0F, residual.data(), visible.data(), jacobian.data(),
                                     n, actual);
      const double points = static_cast<double>(n);
      EXPECT_NEAR(actual.weight, expected.weight, kSumTolerance * points);
      EXPECT_NEAR(actual.curvature, expected.curvature, kSumTolerance * points);
      double squares = 0.0;
      for (std::size_t i = 0; i < n; ++i) {
        if (visible[i] != 0.0F) squares += static_cast<double>(residual[i]) * residual[i];
      }
      const int diagonal[6] = {0, 6, 11, 15, 18, 20};
      for (int k = 0; k < 6; ++k) {
        EXPECT_NEAR(actual.gradient[k], expected.gradient[k],
                    kSumTolerance * std::sqrt(expected.hessian[diagonal[k]] * squares));
      }
      testing::expectNearTriangles(actual.hessian, expected.hessian, kSumTolerance);
    });
  }
}

TEST(VectorSumsTest, ScoresOfBlocksAgreeWithTheReference) {
  const kernels::BlockGrid grid = {4.0F / kWidth, 4};
  const auto rows = static_cast<std::size_t>(kHeight * grid.per_pixel) + 1;
  for (const RobustWeight kind : kKinds) {
    forEachCase([&](const Kernels& kernels, std::size_t n, std::size_t offset) {
      Numbers numbers(10);
      const Array visible = numbers.visible(n, offset);
      const Array residual = awkwardResiduals(visible, offset, 2.0F);
      const Columns<6> jacobian(numbers, n, offset, -300.0F, 500.0F);
      Array u = numbers.array(n, offset, 0.0F, kWidth - 1.0F);
      Array v = numbers.array(n, offset, 0.0F, kHeight - 1.0F);
      for (std::size_t i = 0; i < n; ++i) u[i] *= visible[i], v[i] *= visible[i];
      std::vector<kernels::BlockScore> expected(4 * rows, kernels::BlockScore{{1.0F}});
      std::vector<kernels::BlockScore> actual = expected;  // the kernel adds to the previous values
      kernels::scalar().accumulateScores(kind, 2.0F, residual.data(), visible.data(),
                                         jacobian.data(), u.data(), v.data(), n, grid,
                                         expected.data());
      kernels.accumulateScores(kind, 2.0F, residual.data(), visible.data(), jacobian.data(),
                               u.data(), v.data(), n, grid, actual.data());
      const float bound = 1e-5F * 500.0F * 2e4F * static_cast<float>(n);
      float points = 0.0F;
      for (std::size_t b = 0; b < expected.size(); ++b) {
        for (int k = 0; k < 6; ++k) EXPECT_NEAR(actual[b].score[k], expected[b].score[k], bound);
        EXPECT_EQ(actual[b].score[6], expected[b].score[6]);
        EXPECT_EQ(actual[b].score[7], 0.0F);
        points += actual[b].score[6];
      }
      EXPECT_EQ(points, std::accumulate(visible.data(), visible.data() + n, 0.0F));
    });
  }
}

TEST(VectorSumsTest, PairsAgreeWithTheReference) {
  forEachCase([](const Kernels& kernels, std::size_t n, std::size_t offset) {
    Numbers numbers(8);
    Array a = numbers.array(n, offset, -2.0F, 3.0F);
    const Array b = numbers.array(n, offset, -20.0F, 30.0F);
    const Array divisor = numbers.array(n, offset, 1.0F, 5.0F);
    const Array visible = numbers.visible(n, offset);
    for (std::size_t i = 0; i < n; ++i) {
      if (visible[i] == 0.0F) a[i] = kNan;
    }
    kernels::PairSums expected{};
    kernels::PairSums actual{};
    kernels::scalar().sumPairs(a.data(), b.data(), divisor.data(), visible.data(), n, expected);
    kernels.sumPairs(a.data(), b.data(), divisor.data(), visible.data(), n, actual);
    const double bound = kSumTolerance * static_cast<double>(n);
    EXPECT_NEAR(actual.a, expected.a, 3.0 * bound);
    EXPECT_NEAR(actual.b, expected.b, 30.0 * bound);
    EXPECT_NEAR(actual.aa, expected.aa, 9.0 * bound);
    EXPECT_NEAR(actual.bb, expected.bb, 900.0 * bound);
    EXPECT_NEAR(actual.ab, expected.ab, 90.0 * bound);
  });
}

struct GeometricOutput {
  GeometricOutput(const Array& in_view, std::size_t offset)
      : visible(in_view), residual(in_view.size(), offset, kNan) {
    for (int k = 0; k < 6; ++k) columns.emplace_back(in_view.size(), offset, kNan);
  }
  Array visible;
  Array residual;
  std::vector<Array> columns;
};

TEST(VectorGeometryTest, AgreesWithTheReference) {
  Numbers depths(9);
  std::vector<float> meters;
  std::vector<std::uint16_t> steps;
  const float awkward[] = {0.0F, kNan, -1.0F, kInfinity, 1e9F};
  for (int i = 0; i < kWidth * kHeight; ++i) {
    steps.push_back(depths.chance(0.1F) ? std::uint16_t{0}
                                        : static_cast<std::uint16_t>(depths.between(500, 65535)));
    meters.push_back(depths.chance(0.2F) ? awkward[i % 5] : depths.between(0.5F, 4.0F));
  }
  for (const kernels::Lens lens : testing::kLenses) {
    for (const bool has_row_motion : {false, true}) {
      for (const bool is_metric : {false, true}) {
        const kernels::DepthView depth{is_metric ? meters.data() : nullptr,
                                       is_metric ? nullptr : steps.data(), kWidth, 0.0002F};
        const kernels::WarpParameters live = testing::warpParameters(lens, has_row_motion);
        kernels::Motion back{};
        for (int r = 0; r < 3; ++r) {
          for (int c = 0; c < 3; ++c) back.rotation[3 * r + c] = live.rotation[3 * c + r];
          back.translation[r] = 0.01F * static_cast<float>(r);
        }
        forEachCase([&](const Kernels& kernels, std::size_t n, std::size_t offset) {
          Numbers numbers(10);
          const Array x = numbers.array(n, offset, -1.0F, 1.0F);
          const Array y = numbers.array(n, offset, -0.7F, 0.7F);
          const Array z = numbers.array(n, offset, 0.8F, 3.0F);
          const Array nx = numbers.array(n, offset, -0.6F, 0.6F);
          const Array ny = numbers.array(n, offset, -0.6F, 0.6F);
          const Array nz = numbers.array(n, offset, -0.9F, -0.5F);
          const Array weight = numbers.array(n, offset, 20.0F, 400.0F);
          Array u(n, offset);
          Array v(n, offset);
          Array in_view(n, offset);
          kernels::scalar().warpPoints(live, {x.data(), y.data(), z.data()}, n, u.data(), v.data(),
                                       in_view.data());
          const kernels::PlanesView planes{
              {x.data(), y.data(), z.data()}, {nx.data(), ny.data(), nz.data()}, weight.data()};
          GeometricOutput expected(in_view, offset);
          GeometricOutput actual(in_view, offset);
          const auto run = [&](const Kernels& k, GeometricOutput& out) {
            float* columns[6];
            for (std::size_t c = 0; c < 6; ++c) columns[c] = out.columns[c].data();
            return k.geometricResiduals(live, back, planes, depth, u.data(), v.data(), n,
                                        out.visible.data(), out.residual.data(), columns);
          };
          EXPECT_EQ(run(kernels, actual), run(kernels::scalar(), expected));
          for (std::size_t i = 0; i < n; ++i) {
            EXPECT_EQ(actual.visible[i], expected.visible[i]);
            // Depths of up to 13 m, weights of up to 400: differences of large numbers.
            EXPECT_NEAR(actual.residual[i], expected.residual[i], 0.02F);
            for (std::size_t c = 0; c < 6; ++c) {
              EXPECT_NEAR(actual.columns[c][i], expected.columns[c][i], 0.02F);
            }
          }
          actual.visible.expectGuarded();
          actual.residual.expectGuarded();
          for (const Array& column : actual.columns) column.expectGuarded();
        });
      }
    }
  }
}

}  // namespace
}  // namespace mivo
