// SPDX-License-Identifier: BSD-3-Clause
#include "mivo/core/frame_pyramid.h"

#include <opencv2/core.hpp>

namespace mivo {
namespace {

// The contrast of a level is measured on the image two levels up.
constexpr int kContrastLevels = 2;

}  // namespace

bool usesMutualInformation(const Parameters& parameters, int level) {
  return parameters.method == Method::kMi ||
         (parameters.method == Method::kHybrid && level >= parameters.switch_level);
}

void FramePyramid::build(const Frame& frame, const Parameters& parameters) {
  frame_ = frame;
  num_levels_ = usableLevels(frame.image.cols, frame.image.rows, parameters.levels);
  is_normalised_ = parameters.photometric_model == PhotometricModel::kLcn;
  images_.build(frame.image, num_levels_ + (is_normalised_ ? kContrastLevels : 0));
  if (is_normalised_) contrast_.build(images_, num_levels_);
  normalised_.resize(static_cast<std::size_t>(num_levels_));
  ranges_.resize(static_cast<std::size_t>(num_levels_));
  for (int l = 0; l < num_levels_; ++l) {
    if (!usesMutualInformation(parameters, l)) continue;
    const auto index = static_cast<std::size_t>(l);
    if (is_normalised_) {
      normaliseImage(images_.level(l), contrast_.level(l), normalised_[index]);
      ranges_[index] = IntensityRange{};
    } else {
      ranges_[index] = intensityRange(images_.level(l), parameters.mi_range_quantile);
    }
  }
}

const cv::Mat& FramePyramid::informationImage(int level) const {
  return is_normalised_ ? normalised_[static_cast<std::size_t>(level)] : images_.level(level);
}

double FramePyramid::contrastInView() const {
  cv::Scalar mean;
  cv::Scalar deviation;
  cv::meanStdDev(grey(num_levels_ - 1), mean, deviation);
  return deviation[0];
}

}  // namespace mivo
