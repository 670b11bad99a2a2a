// SPDX-License-Identifier: BSD-3-Clause
#include "kernel_data.h"

namespace mivo {
namespace {

using kernels::Kernels;
using testing::Array;
using testing::forEachCase;
using testing::kInfinity;
using testing::kNan;
using testing::Numbers;

/// Depths of a surface with noise, holes and steps.
Array surface(Numbers& numbers, std::size_t n, std::size_t offset) {
  Array depth = numbers.array(n, offset, 1.97F, 2.03F);
  for (std::size_t i = 0; i < n; ++i) {
    if (numbers.chance(0.05F)) depth[i] = 0.0F;
    if (numbers.chance(0.05F)) depth[i] = numbers.between(0.5F, 9.0F);
  }
  return depth;
}

TEST(VectorDepthTest, RowsInMetersEqualTheReference) {
  const float awkward[] = {kNan, kInfinity, -kInfinity, -1.0F, 0.0F, 0.5F, 4.0F, 1e-40F};
  forEachCase([&](const Kernels& kernels, std::size_t n, std::size_t offset) {
    Numbers numbers(21);
    Array meters = numbers.array(n, offset, 0.0F, 6.0F);
    std::vector<std::uint16_t> steps(n + offset);
    for (std::size_t i = 0; i < n; ++i) {
      if (numbers.chance(0.3F)) meters[i] = awkward[i % 8];
      steps[i + offset] = static_cast<std::uint16_t>(numbers.between(0.0F, 65535.9F));
    }
    const auto width = static_cast<int>(n);
    for (const bool is_metric : {false, true}) {
      const kernels::DepthView depth{is_metric ? meters.data() : nullptr,
                                     is_metric ? nullptr : steps.data() + offset, width, 0.0002F};
      for (const int first : {0, 3}) {
        Array expected(n, offset, -5.0F);
        Array actual(n, offset, -5.0F);
        kernels::scalar().depthRow(depth, 0, first, width, 0.5F, 4.0F, expected.data());
        kernels.depthRow(depth, 0, first, width, 0.5F, 4.0F, actual.data());
        for (std::size_t i = 0; i < n; ++i) EXPECT_EQ(actual[i], expected[i]) << i;
        actual.expectGuarded();
      }
    }
  });
}

TEST(VectorDepthTest, ReducedRowsEqualTheReference) {
  forEachCase([](const Kernels& kernels, std::size_t n, std::size_t offset) {
    if (n == 0) return;
    Numbers numbers(static_cast<unsigned>(22 + n));
    const Array above = surface(numbers, n, offset);
    const Array here = surface(numbers, n, offset);
    const Array below = surface(numbers, n, offset);
    const kernels::DepthRows all[] = {{{above.data(), here.data(), below.data()}, 3, 1},
                                      {{here.data(), below.data(), nullptr}, 2, 0},
                                      {{above.data(), here.data(), nullptr}, 2, 1},
                                      {{here.data(), nullptr, nullptr}, 1, 0}};
    for (const kernels::DepthRows& rows : all) {
      Array expected((n + 1) / 2, offset, -5.0F);
      Array actual((n + 1) / 2, offset, -5.0F);
      const auto width = static_cast<int>(n);
      kernels::scalar().reduceDepthRow(rows, width, 0.03F, 0, expected.data());
      kernels.reduceDepthRow(rows, width, 0.03F, 0, actual.data());
      for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_EQ(actual[i], expected[i]) << i;
      actual.expectGuarded();
    }
  });
}

TEST(VectorDepthTest, SmoothSurfacesEqualTheReference) {
  forEachCase([](const Kernels& kernels, std::size_t n, std::size_t offset) {
    Numbers numbers(static_cast<unsigned>(23 + n));
    const Array above = surface(numbers, n, offset);
    const Array here = surface(numbers, n, offset);
    const Array below = surface(numbers, n, offset);
    const float* const rows[3] = {above.data(), here.data(), below.data()};
    std::vector<std::uint8_t> expected(n + 64, 7);  // entries beyond the row must stay unchanged
    for (std::size_t i = 0; i < n; ++i) expected[i] = numbers.chance(0.7F) ? 1 : 0;
    std::vector<std::uint8_t> actual = expected;
    const auto width = static_cast<int>(n);
    kernels::scalar().keepSmooth(rows, width, 0.06F, 2, expected.data());
    kernels.keepSmooth(rows, width, 0.06F, 2, actual.data());
    EXPECT_EQ(actual, expected);
  });
}

}  // namespace
}  // namespace mivo
