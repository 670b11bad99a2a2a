// SPDX-License-Identifier: BSD-3-Clause
#include "synthetic/exposure_control.h"

#include <algorithm>
#include <cmath>

#include "mivo/core/error.h"

namespace mivo {

ExposureControl::ExposureControl(const ExposureControlOptions& options,
                                 const ExposureSetting& first)
    : options_(options), current_(first) {
  if (options.delay < 1 || !(options.target_gray > 0.0 && options.target_gray < 255.0) ||
      !(options.damping > 0.0 && options.damping <= 1.0) ||
      !(options.max_time >= options.min_time) || !(options.min_time > 0.0) ||
      !(options.max_gain >= 1.0)) {
    throw Error(
        "exposure control: delay must be at least 1, target within 0..255, damping within 0..1, "
        "the times "
        "positive and in order, the greatest gain at least 1");
  }
}

double ExposureControl::wantedProduct(double product, double mean_gray,
                                      const Imager& imager) const {
  // A black image does not tell how dark it is: half a gray level is the least that is assumed.
  const double measured = imager.linear(std::max(mean_gray, 0.5));
  const double wanted = product * imager.linear(options_.target_gray) / measured;
  return std::clamp(wanted, options_.min_time, options_.max_time * options_.max_gain);
}

ExposureSetting ExposureControl::split(double product) const {
  const double time = std::clamp(product, options_.min_time, options_.max_time);
  return {time, std::clamp(product / time, 1.0, options_.max_gain)};
}

void ExposureControl::advance(double mean_gray, const Imager& imager) {
  if (!options_.automatic) {
    return;
  }
  wanted_.push_back(wantedProduct(current_.product(), mean_gray, imager));
  if (wanted_.size() < static_cast<std::size_t>(options_.delay)) {
    return;
  }
  const double wanted = wanted_.front();
  wanted_.pop_front();
  current_ = split(current_.product() * std::pow(wanted / current_.product(), options_.damping));
}

}  // namespace mivo
