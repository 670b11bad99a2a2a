// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "core/kernels/kernels.h"
#include "core/terms/bspline.h"

namespace mivo {

/// Range of gray levels of the bins: `low` is the center of the first bin, `high` that of the last.
struct IntensityRange {
  float low = 0.0F;
  float high = 255.0F;
};

/// The range between two quantiles of a CV_32FC1 or CV_8UC1 image of 0..255, at least one gray
/// level wide.
IntensityRange intensityRange(const cv::Mat& image, double quantile);

/// Position of an intensity on the axis of bins: s = bin + fraction, 0 <= s < num_bins - 1.
/// Intensities outside of the range are clamped to its ends.
struct BinPosition {
  int bin;
  float fraction;
  bool is_clamped;
};

/// Maps gray levels to bins.
class Binning {
 public:
  Binning() = default;
  Binning(const IntensityRange& range, int num_bins);

  BinPosition operator()(float intensity) const;
  float binsPerGrayLevel() const { return scale_; }
  float low() const { return low_; }  ///< gray level at the center of the first bin
  float top() const { return top_; }  ///< largest position

 private:
  float low_ = 0.0F;
  float scale_ = 0.0F;
  float top_ = 0.0F;
};

/// Joint histogram of keyframe and live image under cubic B-spline Parzen windows on both axes
/// (Eq. 3), as probabilities. Each axis has two additional bins, so that no window leaves the
/// table: a position in bin k touches rows k .. k + 3.
class JointHistogram {
 public:
  JointHistogram() = default;
  explicit JointHistogram(int num_bins) { resize(num_bins); }

  /// Reuses the memory; the contents are arbitrary until clear().
  void resize(int num_bins);

  int side() const { return side_; }

  /// Sets all to zero.
  void clear();

  /// Adds one pair of positions with weight one.
  void add(const BinPosition& reference, const BinPosition& live);

  /// Adds the sums of another histogram of the same size.
  void add(const JointHistogram& other);

  /// Adds the pairs of n visible points, weight one each. Bins are those of BinPosition.
  void add(const kernels::BinsView& reference, const kernels::BinsView& live, const float* visible,
           std::size_t n);

  /// Divides by the number of added pairs, and computes marginals, log ratios and mutual
  /// information.
  void normalize(std::size_t num_pairs);

  double joint(int reference, int live) const { return joint_[index(reference, live)]; }
  double referenceMarginal(int reference) const {
    return reference_[static_cast<std::size_t>(reference)];
  }
  double liveMarginal(int live) const { return live_[static_cast<std::size_t>(live)]; }

  /// log(p_rl / p_r), 0 where p_rl is 0; side() x side(), row by row.
  const std::vector<float>& logRatios() const { return log_ratio_; }

  /// Mutual information, nats (Eq. 2). At least zero, at most the smaller of the two entropies.
  double mutualInformation() const { return mutual_information_; }

 private:
  void takeLogarithms();
  std::size_t index(int reference, int live) const {
    return static_cast<std::size_t>(reference * side_ + live);
  }

  int side_ = 0;
  std::vector<double> joint_;
  std::vector<double> reference_;
  std::vector<double> live_;
  std::vector<double> logarithm_;
  std::vector<float> log_ratio_;
  std::vector<float> scratch_;
  double mutual_information_ = 0.0;
};

}  // namespace mivo
