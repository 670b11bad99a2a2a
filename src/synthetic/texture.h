// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>
#include <vector>

namespace mivo {

/// Reflectance of a surface as an image with its reduced versions, so that a far or slanted surface
/// does not alias. Texels hold (blue, green, red) diffuse reflectance, linear, 0..1, and the
/// strength of the highlight, 0..1.
class Texture {
 public:
  /// @param texels          CV_32FC4, both sizes powers of two
  /// @param meters_per_texel  of a texture that is repeated; a picture that is stretched over its
  ///                        surface ignores it
  Texture(const cv::Mat& texels, double meters_per_texel);

  float metersPerTexel() const { return meters_per_texel_; }
  int width() const { return levels_.front().width; }
  int height() const { return levels_.front().height; }

  /// Value at a texel position (centers at integers, repeated in both directions), averaged over
  /// about `footprint` texels, by trilinear interpolation.
  Eigen::Array4f sample(float x, float y, float footprint) const;

 private:
  struct Level {
    int width;
    int height;
    float scale;  // texels of this level per texel of level 0
    std::vector<Eigen::Array4f, Eigen::aligned_allocator<Eigen::Array4f>> texels;
  };
  static Eigen::Array4f bilinear(const Level& level, float x, float y);

  std::vector<Level> levels_;
  float meters_per_texel_;
};

}  // namespace mivo
