// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "mivo/core/bspline.h"

namespace mivo {

/// Grey levels that fill the bins: `low` falls on the centre of the first, `high` on that of the
/// last.
struct IntensityRange {
  float low = 0.0F;
  float high = 255.0F;
};

/// The range between two quantiles of a CV_32FC1 image of 0..255, at least one grey level wide.
IntensityRange intensityRange(const cv::Mat& image, double quantile);

/// Place of an intensity on the axis of bins: s = bin + fraction, 0 <= s < num_bins - 1.
/// Intensities outside of the range are clamped to its ends.
struct BinPosition {
  int bin;
  float fraction;
  bool is_clamped;
};

/// Maps grey levels to bins.
class Binning {
 public:
  Binning() = default;
  Binning(const IntensityRange& range, int num_bins);

  BinPosition operator()(float intensity) const;
  float binsPerGreyLevel() const { return scale_; }

 private:
  float low_ = 0.0F;
  float scale_ = 0.0F;
  float top_ = 0.0F;
};

/// Joint histogram of keyframe and live image under cubic B-spline Parzen windows on both axes
/// (Eq. 3), as probabilities. Each axis has two bins more than `num_bins`, so that no window leaves
/// the table: a position in bin k touches rows k .. k + 3.
class JointHistogram {
 public:
  explicit JointHistogram(int num_bins);

  int side() const { return side_; }

  /// Sets all to zero.
  void clear();

  /// Adds one pair of positions with weight one.
  void add(const BinPosition& reference, const BinPosition& live);

  /// Adds the sums of another histogram of the same size.
  void add(const JointHistogram& other);

  /// Divides by the number of pairs added and forms the marginals.
  void normalise(std::size_t num_pairs);

  double joint(int reference, int live) const { return joint_[index(reference, live)]; }
  double referenceMarginal(int reference) const {
    return reference_[static_cast<std::size_t>(reference)];
  }
  double liveMarginal(int live) const { return live_[static_cast<std::size_t>(live)]; }

  /// Mutual information, nats (Eq. 2). At least zero, at most the smaller of the two entropies.
  double mutualInformation() const;

 private:
  std::size_t index(int reference, int live) const {
    return static_cast<std::size_t>(reference * side_ + live);
  }

  int side_;
  std::vector<double> joint_;
  std::vector<double> reference_;
  std::vector<double> live_;
};

}  // namespace mivo
