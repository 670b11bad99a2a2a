// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <vector>

namespace mivo {

/// How the 8-bit value depends on the light.
enum class Transfer { kSrgb, kLinear };

/// The chip of a color camera. A pixel's signal s is its light in units of what saturates it; at
/// gain g it holds n = s F / g electrons of a full well F, so that
///   s' = s + sqrt(n + r^2) g / F * normal,   value = round(255 transfer(clip(s', 0, 1))).
struct ImagerOptions {
  bool noise = true;
  double full_well = 6000.0;  ///< F, electrons
  double read_noise = 9.0;    ///< r, electrons
  Transfer transfer = Transfer::kSrgb;
  double vignetting = 0.0;  ///< loss of light in the corners, 0..1, growing with the squared radius
};

class Imager {
 public:
  /// Throws Error for a number out of range.
  explicit Imager(const ImagerOptions& options);

  const ImagerOptions& options() const { return options_; }

  /// Digitizes light: CV_32FC1 or CV_32FC3, times `scale` in units of saturation. The result is
  /// CV_8U with the same channels and depends on the seed, not on the number of threads.
  cv::Mat expose(const cv::Mat& light, double scale, double gain, std::uint64_t seed) const;

  /// 0..1 light of an 8-bit value (0..255, not necessarily whole), and back.
  double linear(double value) const;
  double encode(double linear) const;

 private:
  ImagerOptions options_;
  std::vector<unsigned char> table_;  // 8-bit value of linear light in steps of 1 / 65535
};

/// Mean of all pixels and channels of an 8-bit image, as an exposure meter sees it.
double meanGray(const cv::Mat& image);

}  // namespace mivo
