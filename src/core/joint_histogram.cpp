// SPDX-License-Identifier: BSD-3-Clause
#include "mivo/core/joint_histogram.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace mivo {
namespace {

constexpr int kGreyLevels = 256;
constexpr float kMinRange = 1.0F;
// Keeps the topmost position inside of the last interval between two bins.
constexpr float kBelowTop = 1e-3F;

}  // namespace

IntensityRange intensityRange(const cv::Mat& image, double quantile) {
  std::array<int, kGreyLevels> counts{};
  for (int y = 0; y < image.rows; ++y) {
    const auto* row = image.ptr<float>(y);
    for (int x = 0; x < image.cols; ++x) {
      const int level = static_cast<int>(row[x] + 0.5F);
      ++counts[static_cast<std::size_t>(std::min(std::max(level, 0), kGreyLevels - 1))];
    }
  }
  const double limit = quantile * static_cast<double>(image.total());
  int low = 0;
  for (double sum = counts[0]; sum <= limit && low < kGreyLevels - 1;) {
    sum += counts[static_cast<std::size_t>(++low)];
  }
  int high = kGreyLevels - 1;
  for (double sum = counts[kGreyLevels - 1]; sum <= limit && high > 0;) {
    sum += counts[static_cast<std::size_t>(--high)];
  }
  IntensityRange range{static_cast<float>(low), static_cast<float>(high)};
  range.high = std::max(range.high, range.low + kMinRange);
  return range;
}

Binning::Binning(const IntensityRange& range, int num_bins)
    : low_(range.low),
      scale_(static_cast<float>(num_bins - 1) / (range.high - range.low)),
      top_(static_cast<float>(num_bins - 1) - kBelowTop) {}

BinPosition Binning::operator()(float intensity) const {
  const float wanted = (intensity - low_) * scale_;
  const float position = std::min(std::max(wanted, 0.0F), top_);
  const int bin = static_cast<int>(position);  // not negative: truncation is the floor
  return {bin, position - static_cast<float>(bin), position != wanted};
}

JointHistogram::JointHistogram(int num_bins)
    : side_(num_bins + 2),
      joint_(static_cast<std::size_t>(side_ * side_)),
      reference_(static_cast<std::size_t>(side_)),
      live_(static_cast<std::size_t>(side_)) {}

void JointHistogram::clear() {
  std::fill(joint_.begin(), joint_.end(), 0.0);
}

void JointHistogram::add(const BinPosition& reference, const BinPosition& live) {
  const SplineWeights r = splineWeights(reference.fraction);
  const SplineWeights l = splineWeights(live.fraction);
  double* row = &joint_[index(reference.bin, live.bin)];
  for (std::size_t a = 0; a < kSplineSupport; ++a, row += side_) {
    for (std::size_t b = 0; b < kSplineSupport; ++b) row[b] += static_cast<double>(r[a] * l[b]);
  }
}

void JointHistogram::add(const JointHistogram& other) {
  for (std::size_t i = 0; i < joint_.size(); ++i) joint_[i] += other.joint_[i];
}

void JointHistogram::normalise(std::size_t num_pairs) {
  std::fill(reference_.begin(), reference_.end(), 0.0);
  std::fill(live_.begin(), live_.end(), 0.0);
  if (num_pairs == 0) return;
  const double scale = 1.0 / static_cast<double>(num_pairs);
  for (int r = 0; r < side_; ++r) {
    for (int l = 0; l < side_; ++l) {
      double& p = joint_[index(r, l)];
      p *= scale;
      reference_[static_cast<std::size_t>(r)] += p;
      live_[static_cast<std::size_t>(l)] += p;
    }
  }
}

double JointHistogram::mutualInformation() const {
  double sum = 0.0;
  for (int r = 0; r < side_; ++r) {
    for (int l = 0; l < side_; ++l) {
      const double p = joint(r, l);
      if (p > 0.0) sum += p * std::log(p / (referenceMarginal(r) * liveMarginal(l)));
    }
  }
  return std::max(0.0, sum);
}

}  // namespace mivo
