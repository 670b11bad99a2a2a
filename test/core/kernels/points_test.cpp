// SPDX-License-Identifier: BSD-3-Clause
#include "kernel_data.h"

namespace mivo {
namespace {

using kernels::Kernels;
using kernels::WarpParameters;
using testing::Array;
using testing::forEachCase;
using testing::kHeight;
using testing::kInfinity;
using testing::kNan;
using testing::kWidth;
using testing::Numbers;
using testing::warpParameters;

struct Points {
  Array x, y, z;
  kernels::PointsView view() const { return {x.data(), y.data(), z.data()}; }
};

/// Points inside and outside the view, some behind the camera, at its center, huge or not finite.
Points awkwardPoints(std::size_t n, std::size_t offset) {
  Numbers numbers(static_cast<unsigned>(n));
  Points points{numbers.array(n, offset, -1.5F, 1.5F), numbers.array(n, offset, -1.0F, 1.0F),
                numbers.array(n, offset, 0.5F, 3.0F)};
  const float awkward[] = {kNan, kInfinity, -kInfinity, 0.0F, -0.0F, -1.0F, 1e30F, 3e38F, 1e-40F};
  for (std::size_t i = 0; i < n; ++i) {
    if (!numbers.chance(0.2F)) continue;
    Array* arrays[] = {&points.x, &points.y, &points.z};
    (*arrays[i % 3])[i] = awkward[i % 9];
  }
  return points;
}

struct Pixels {
  Pixels(std::size_t n, std::size_t offset)
      : u(n, offset, kNan), v(n, offset, kNan), visible(n, offset, kNan) {}
  Array u, v, visible;
};

bool isNear(float value, float border) {
  return std::abs(value - border) < 1e-3F;
}

TEST(VectorWarpTest, AgreesWithTheReference) {
  for (const kernels::Lens lens : testing::kLenses) {
    for (const bool has_row_motion : {false, true}) {
      const WarpParameters p = warpParameters(lens, has_row_motion);
      forEachCase([&](const Kernels& kernels, std::size_t n, std::size_t offset) {
        const Points points = awkwardPoints(n, offset);
        Pixels expected(n, offset);
        Pixels actual(n, offset);
        kernels::scalar().warpPoints(p, points.view(), n, expected.u.data(), expected.v.data(),
                                     expected.visible.data());
        const std::size_t count = kernels.warpPoints(p, points.view(), n, actual.u.data(),
                                                     actual.v.data(), actual.visible.data());
        std::size_t visible = 0;
        for (std::size_t i = 0; i < n; ++i) {
          if (actual.visible[i] == 1.0F) ++visible;
          if (actual.visible[i] != expected.visible[i]) {
            // Visibility may differ by rounding, but only at the border.
            const Array& u = actual.visible[i] == 1.0F ? actual.u : expected.u;
            const Array& v = actual.visible[i] == 1.0F ? actual.v : expected.v;
            EXPECT_TRUE(isNear(u[i], 0.0F) || isNear(u[i], p.right) || isNear(v[i], 0.0F) ||
                        isNear(v[i], p.bottom));
            continue;
          }
          EXPECT_NEAR(actual.u[i], expected.u[i], 2e-4F);
          EXPECT_NEAR(actual.v[i], expected.v[i], 2e-4F);
        }
        EXPECT_EQ(count, visible);
        actual.u.expectGuarded();
        actual.v.expectGuarded();
        actual.visible.expectGuarded();
      });
    }
  }
}

TEST(VectorWarpTest, ExactBordersAreInsideOnTheLeftAndOutsideOnTheRight) {
  WarpParameters p = warpParameters(kernels::Lens::kNone, false);
  const float identity[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  std::copy(identity, identity + 9, p.rotation);
  std::fill(p.translation, p.translation + 3, 0.0F);
  p.fx = p.fy = 1.0F;
  p.cx = p.cy = 0.0F;
  for (const kernels::Backend& backend : kernels::backends()) {
    SCOPED_TRACE(backend.name);
    const std::size_t n = 64;
    Points points{Array(n, 1), Array(n, 1, 1.0F), Array(n, 1, 1.0F)};
    for (std::size_t i = 0; i < n; ++i) {
      const float cases[] = {0.0F, std::nextafter(0.0F, -1.0F), p.right,
                             std::nextafter(p.right, 0.0F)};
      points.x[i] = cases[i % 4];
    }
    Pixels pixels(n, 1);
    backend.kernels->warpPoints(p, points.view(), n, pixels.u.data(), pixels.v.data(),
                                pixels.visible.data());
    for (std::size_t i = 0; i < n; ++i) {
      EXPECT_EQ(pixels.visible[i], i % 4 == 0 || i % 4 == 3 ? 1.0F : 0.0F);
    }
  }
}

/// An image as floats and as bytes, its contrast map, and pixels in it.
struct Pictures {
  explicit Pictures(unsigned seed) {
    Numbers numbers(seed);
    for (int i = 0; i < kWidth * kHeight; ++i) {
      bytes.push_back(static_cast<unsigned char>(numbers.between(0.0F, 255.99F)));
      floats.push_back(static_cast<float>(bytes.back()));
    }
    for (int i = 0; i < kMapWidth * kMapHeight; ++i) {
      pairs.push_back(numbers.between(0.0F, 255.0F));
      pairs.push_back(numbers.chance(0.2F) ? 0.0F : numbers.between(0.0F, 60.0F));
    }
  }
  kernels::ImageView image(bool as_bytes) const {
    if (as_bytes) return {nullptr, bytes.data(), kWidth, kWidth, kHeight};
    return {floats.data(), nullptr, kWidth, kWidth, kHeight};
  }
  kernels::ContrastView contrast() const { return {pairs.data(), 2 * kMapWidth, 3.0F}; }

  static constexpr int kMapWidth = (kWidth + 3) / 4 + 1;
  static constexpr int kMapHeight = (kHeight + 3) / 4 + 1;
  std::vector<float> floats;
  std::vector<unsigned char> bytes;
  std::vector<float> pairs;
};

/// Pixels as warpPoints returns them, many at integer positions and at the image border.
Pixels awkwardPixels(std::size_t n, std::size_t offset) {
  Numbers numbers(static_cast<unsigned>(n + 7));
  Pixels pixels(n, offset);
  for (std::size_t i = 0; i < n; ++i) {
    const bool is_visible = numbers.chance(0.8F);
    float u = numbers.between(0.0F, kWidth - 1.001F);
    float v = numbers.between(0.0F, kHeight - 1.001F);
    if (numbers.chance(0.2F)) u = std::floor(u);
    if (numbers.chance(0.2F)) v = std::floor(v);
    if (numbers.chance(0.1F)) u = 0.0F;
    if (numbers.chance(0.1F)) u = std::nextafter(float{kWidth - 1}, 0.0F);
    if (numbers.chance(0.1F)) v = std::nextafter(float{kHeight - 1}, 0.0F);
    pixels.u[i] = is_visible ? u : 0.0F;
    pixels.v[i] = is_visible ? v : 0.0F;
    pixels.visible[i] = is_visible ? 1.0F : 0.0F;
  }
  return pixels;
}

TEST(VectorSampleTest, IntensitiesAgreeWithTheReference) {
  const Pictures pictures(3);
  for (const bool as_bytes : {false, true}) {
    forEachCase([&](const Kernels& kernels, std::size_t n, std::size_t offset) {
      const Pixels pixels = awkwardPixels(n, offset);
      Array expected(n, offset, kNan);
      Array actual(n, offset, kNan);
      const auto sample = [&](const Kernels& k, Array& out) {
        k.sampleIntensity(pictures.image(as_bytes), pixels.u.data(), pixels.v.data(),
                          pixels.visible.data(), n, out.data());
      };
      sample(kernels::scalar(), expected);
      sample(kernels, actual);
      for (std::size_t i = 0; i < n; ++i) EXPECT_NEAR(actual[i], expected[i], 1e-4F);
      actual.expectGuarded();
    });
  }
}

TEST(VectorSampleTest, NormalizedIntensitiesAgreeWithTheReference) {
  const Pictures pictures(4);
  for (const bool as_bytes : {false, true}) {
    forEachCase([&](const Kernels& kernels, std::size_t n, std::size_t offset) {
      const Pixels pixels = awkwardPixels(n, offset);
      Array expected(n, offset, kNan);
      Array actual(n, offset, kNan);
      // The brighter half becomes invisible.
      const auto sample = [&](const Kernels& k, Array& visible, Array& out) {
        return k.sampleNormalized(pictures.image(as_bytes), pictures.contrast(), 128.0F,
                                  pixels.u.data(), pixels.v.data(), visible.data(), n, out.data());
      };
      Array expected_visible = pixels.visible;
      Array actual_visible = pixels.visible;
      EXPECT_EQ(sample(kernels, actual_visible, actual),
                sample(kernels::scalar(), expected_visible, expected));
      for (std::size_t i = 0; i < n; ++i) {
        EXPECT_NEAR(actual[i], expected[i], 2e-5F * (1.0F + std::abs(expected[i])) + 1e-4F);
        if (pixels.visible[i] == 0.0F) {
          EXPECT_EQ(actual[i], 0.0F);
        }
      }
      actual.expectGuarded();
    });
  }
}

}  // namespace
}  // namespace mivo
