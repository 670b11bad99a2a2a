// SPDX-License-Identifier: BSD-3-Clause
#include "synthetic/texture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <opencv2/core.hpp>

#include "mivo/core/error.h"
#include "synthetic/pixel_noise.h"
#include "synthetic/texture_patterns.h"

namespace mivo {
namespace {

cv::Mat randomTexels(int width, int height) {
  cv::Mat texels(height, width, CV_32FC4);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const std::uint64_t bits =
          hashOf(5, static_cast<std::uint64_t>(y), static_cast<std::uint64_t>(x));
      texels.at<cv::Vec4f>(y, x) = {uniformFrom(bits), uniformFrom(mixBits(bits)),
                                    uniformFrom(mixBits(bits + 1)), uniformFrom(mixBits(bits + 2))};
    }
  }
  return texels;
}

Eigen::Array4f texelAt(const cv::Mat& texels, int x, int y) {
  const cv::Vec4f& value =
      texels.at<cv::Vec4f>((y + texels.rows) % texels.rows, (x + texels.cols) % texels.cols);
  return {value[0], value[1], value[2], value[3]};
}

TEST(Texture, IsExactAtTexelsAndRepeats) {
  const cv::Mat texels = randomTexels(16, 8);
  const Texture texture(texels, 0.01);
  for (int y = -9; y < 18; ++y) {
    for (int x = -20; x < 40; x += 3) {
      const Eigen::Array4f expected = texelAt(texels, x + 32, y + 16);
      const Eigen::Array4f value =
          texture.sample(static_cast<float>(x), static_cast<float>(y), 1.0F);
      EXPECT_LT((value - expected).abs().maxCoeff(), 1e-6F) << x << " " << y;
    }
  }
}

TEST(Texture, InterpolatesBilinearly) {
  const cv::Mat texels = randomTexels(16, 16);
  const Texture texture(texels, 0.01);
  const Eigen::Array4f expected =
      0.75F * (0.6F * texelAt(texels, 3, 5) + 0.4F * texelAt(texels, 4, 5)) +
      0.25F * (0.6F * texelAt(texels, 3, 6) + 0.4F * texelAt(texels, 4, 6));
  EXPECT_LT((texture.sample(3.4F, 5.25F, 1.0F) - expected).abs().maxCoeff(), 1e-5F);
}

TEST(Texture, LargeFootprintAverages) {
  const cv::Mat texels = randomTexels(16, 16);
  const Texture texture(texels, 0.01);
  // In the middle of a 2 x 2 block the next level's texel is that block's mean.
  Eigen::Array4f mean = Eigen::Array4f::Zero();
  for (const int y : {4, 5}) {
    for (const int x : {6, 7}) mean += 0.25F * texelAt(texels, x, y);
  }
  EXPECT_LT((texture.sample(6.5F, 4.5F, 2.0F) - mean).abs().maxCoeff(), 1e-5F);
  const cv::Scalar all = cv::mean(texels);
  const Eigen::Array4f coarsest = texture.sample(3.0F, 9.0F, 1e6F);
  for (int c = 0; c < 4; ++c) EXPECT_NEAR(coarsest[c], all[c], 1e-5);
}

TEST(Texture, RefusesSizesThatCannotBeHalved) {
  EXPECT_THROW(Texture(cv::Mat(12, 16, CV_32FC4), 0.01), Error);
  EXPECT_THROW(Texture(cv::Mat(16, 16, CV_32FC3), 0.01), Error);
}

TEST(TexturePatterns, StayReflectancesAndHaveStructure) {
  const Texture textures[] = {plasterTexture({0.4F, 0.4F, 0.4F}, 0.1, 1),
                              brickTexture(1),
                              plankTexture(1),
                              paintingTexture(1),
                              printedPageTexture(1),
                              bookRowTexture(1)};
  for (const Texture& texture : textures) {
    float low = 1.0F;
    float high = 0.0F;
    for (int y = 0; y < texture.height(); y += 5) {
      for (int x = 0; x < texture.width(); x += 5) {
        const Eigen::Array3f color =
            texture.sample(static_cast<float>(x), static_cast<float>(y), 1.0F).head<3>();
        low = std::min(low, color.minCoeff());
        high = std::max(high, color.maxCoeff());
      }
    }
    EXPECT_GT(low, 0.0F);
    EXPECT_LT(high, 1.0F);
    EXPECT_GT(high - low, 0.1F);
  }
}

}  // namespace
}  // namespace mivo
