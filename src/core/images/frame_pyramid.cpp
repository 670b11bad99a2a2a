// SPDX-License-Identifier: BSD-3-Clause
#include "core/images/frame_pyramid.h"

#include <cmath>
#include <opencv2/core.hpp>

#include "core/images/pixel_access.h"
#include "core/kernels/kernels.h"

namespace mivo {
namespace {

// The contrast of a level is measured on the image two levels coarser.
constexpr int kContrastLevels = 2;

}  // namespace

bool usesMutualInformation(const Parameters& parameters, int level) {
  return parameters.alignment.method == Method::kMi ||
         (parameters.alignment.method == Method::kHybrid &&
          level >= parameters.alignment.switch_level);
}

/// Reduces noise and interpolation error at the points. Pixels next to clipped ones are not
/// smoothed, which would spread clipping. Coarser levels are smooth already.
void FramePyramid::smooth(double saturation) {
  const cv::Mat& image = images_.level(0);
  smoothed_.create(image.size(), CV_8UC1);
  scratch_.resize(kernels::imageScratch(image.cols));
  const auto largest = static_cast<std::uint8_t>(std::ceil(saturation) - 1.0);
  kernels::active().smooth(view(image), largest, smoothed_.ptr<std::uint8_t>(),
                           static_cast<std::ptrdiff_t>(smoothed_.step1()), scratch_.data());
}

void FramePyramid::build(const Frame& frame, const Parameters& parameters) {
  frame_ = frame;
  num_levels_ = usableLevels(frame.image.cols, frame.image.rows, parameters.alignment.levels);
  is_normalized_ = parameters.alignment.photometric_model == PhotometricModel::kLcn;
  images_.build(frame.image, num_levels_ + (is_normalized_ ? kContrastLevels : 0));
  if (is_normalized_) {
    contrast_.build(images_, num_levels_);
    smooth(parameters.alignment.saturation);
  }
  normalized_.resize(static_cast<std::size_t>(num_levels_));
  ranges_.resize(static_cast<std::size_t>(num_levels_));
  for (int l = 0; l < num_levels_; ++l) {
    if (!usesMutualInformation(parameters, l)) continue;
    const auto index = static_cast<std::size_t>(l);
    if (is_normalized_) {
      normalizeImage(images_.level(l), contrast_.level(l), normalized_[index]);
      ranges_[index] = IntensityRange{};
    } else {
      ranges_[index] = intensityRange(images_.level(l), parameters.mi.mi_range_quantile);
    }
  }
}

const cv::Mat& FramePyramid::miImage(int level) const {
  return is_normalized_ ? normalized_[static_cast<std::size_t>(level)] : images_.level(level);
}

double FramePyramid::contrastInView() const {
  cv::Scalar mean;
  cv::Scalar deviation;
  cv::meanStdDev(gray(num_levels_ - 1), mean, deviation);
  return deviation[0];
}

}  // namespace mivo
