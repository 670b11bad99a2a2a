// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>

#include "synthetic/imager.h"

namespace mivo {

struct ExposureSetting {
  double time = 0.01;  ///< s
  double gain = 1.0;

  double product() const { return time * gain; }
};

struct ExposureControlOptions {
  bool automatic = false;    ///< otherwise the first setting stays
  int delay = 10;            ///< frames from a measurement to its effect, at least 1
  double target_gray = 110;  ///< mean 8-bit value aimed at
  double damping = 0.5;      ///< part of the (logarithmic) way gone per frame, 0..1
  double min_time = 0.0005;  ///< s
  double max_time = 0.030;   ///< s; longer exposures are tried before gain
  double max_gain = 16.0;
};

/// The automatic exposure of a cheap camera: it measures the mean of each image and acts some
/// frames later.
class ExposureControl {
 public:
  /// Throws Error for an option out of range.
  ExposureControl(const ExposureControlOptions& options, const ExposureSetting& first);

  /// Setting of the frame that is about to be taken.
  const ExposureSetting& current() const { return current_; }

  /// Reports the mean value of that frame and proceeds to the next one.
  void advance(double mean_gray, const Imager& imager);

  /// time * gain that would bring the measured mean to the target.
  double wantedProduct(double product, double mean_gray, const Imager& imager) const;

  /// Divides a product into time (as long as allowed) and gain.
  ExposureSetting split(double product) const;

 private:
  ExposureControlOptions options_;
  ExposureSetting current_;
  std::deque<double> wanted_;  // products asked for by the last frames, oldest first
};

}  // namespace mivo
