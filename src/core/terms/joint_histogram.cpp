// SPDX-License-Identifier: BSD-3-Clause
#include "core/terms/joint_histogram.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/images/pixel_access.h"

namespace mivo {
namespace {

constexpr int kGrayLevels = 256;
// high >= low + this, gray levels: avoids division by zero for a uniform image.
constexpr float kMinRange = 1.0F;
// Keeps the topmost position inside of the last interval between two bins.
constexpr float kBelowTop = 1e-3F;

}  // namespace

IntensityRange intensityRange(const cv::Mat& image, double quantile) {
  std::array<int, kGrayLevels> counts{};
  for (int y = 0; y < image.rows; ++y) {
    for (int x = 0; x < image.cols; ++x) {
      const int level = static_cast<int>(intensityAt(image, x, y) + 0.5F);
      ++counts[static_cast<std::size_t>(std::min(std::max(level, 0), kGrayLevels - 1))];
    }
  }
  const double limit = quantile * static_cast<double>(image.total());
  int low = 0;
  for (double sum = counts[0]; sum <= limit && low < kGrayLevels - 1;) {
    sum += counts[static_cast<std::size_t>(++low)];
  }
  int high = kGrayLevels - 1;
  for (double sum = counts[kGrayLevels - 1]; sum <= limit && high > 0;) {
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

void JointHistogram::resize(int num_bins) {
  side_ = num_bins + 2;
  const auto side = static_cast<std::size_t>(side_);
  joint_.resize(side * side);
  reference_.resize(side);
  live_.resize(side);
  logarithm_.resize(side * side);
  log_ratio_.resize(side * side);
  scratch_.resize(kernels::histogramScratch(side_));
}

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

void JointHistogram::add(const kernels::BinsView& reference, const kernels::BinsView& live,
                         const float* visible, std::size_t n) {
  kernels::active().jointHistogram(reference, live, visible, n, side_, scratch_.data(),
                                   joint_.data());
}

void JointHistogram::normalize(std::size_t num_pairs) {
  std::fill(reference_.begin(), reference_.end(), 0.0);
  std::fill(live_.begin(), live_.end(), 0.0);
  mutual_information_ = 0.0;
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
  takeLogarithms();
}

/// sum p_rl log(p_rl / (p_r p_l)), and the ratios.
void JointHistogram::takeLogarithms() {
  const auto side = static_cast<std::size_t>(side_);
  const auto take = kernels::active().logarithms;
  take(live_.data(), side, logarithm_.data());
  double sum = 0.0;
  for (std::size_t l = 0; l < side; ++l) sum -= live_[l] * logarithm_[l];
  // The logarithms of p_r are stored in the ratios first, since they are needed row by row.
  take(reference_.data(), side, logarithm_.data());
  for (std::size_t r = 0; r < side; ++r) log_ratio_[r * side] = static_cast<float>(logarithm_[r]);
  for (std::size_t r = 0; r < side; ++r) sum -= reference_[r] * logarithm_[r];
  take(joint_.data(), side * side, logarithm_.data());
  for (std::size_t r = 0; r < side; ++r) {
    const auto of_reference = static_cast<double>(log_ratio_[r * side]);
    for (std::size_t i = r * side; i < (r + 1) * side; ++i) {
      sum += joint_[i] * logarithm_[i];
      log_ratio_[i] = joint_[i] > 0.0 ? static_cast<float>(logarithm_[i] - of_reference) : 0.0F;
    }
  }
  mutual_information_ = std::max(0.0, sum);
}

}  // namespace mivo
