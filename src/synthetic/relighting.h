// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "synthetic/exposure_control.h"
#include "synthetic/imager.h"
#include "synthetic/lighting_curve.h"

namespace mivo {

/// Changes the light in recorded images. The 8-bit values are turned into linear light, multiplied,
/// and taken again by the sensor model with its noise and saturation.
///
///   ramp, step, ramp_step, oscillating, darkness
///                  the curves of lighting_curve.h, as factors: the recording is taken to have been
///                  lit by nominalIlluminance (61 lux; 20.3 lux for oscillating)
///   black          20 frames in the middle without any light: nothing but read noise
///   spot           a spot light moves over the image and saturates its middle
///   gradient       a slope of brightness over the image, which turns and changes
///   gamma          the transfer curve changes: value^g with g between 1/1.8 and 1.8
///   auto_exposure  the light oscillates as above and an automatic exposure follows ten frames late
///   inversion      values become 255 - value from the middle on: nothing a lamp could do
class Relighting {
 public:
  /// Throws Error for an unknown name, listing the known ones.
  Relighting(const std::string& lighting, const SequenceTime& time, std::uint64_t seed);

  /// The next frame of the sequence: CV_8UC1, CV_8UC3 or CV_8UC4 (the fourth channel is kept); the
  /// result has the same type. Frames must come in order.
  cv::Mat relight(const cv::Mat& image);

  /// Passes over a frame that cannot be read.
  void skip() { ++frame_; }

  static const std::vector<std::string>& names();

 private:
  double globalFactor() const;
  cv::Mat factorImage(const cv::Size& size) const;
  cv::Mat takeAgain(const cv::Mat& image);
  cv::Mat changeCurve(const cv::Mat& image) const;

  std::string name_;
  SequenceTime time_;
  std::uint64_t seed_;
  Imager imager_;
  ExposureControl exposure_control_;
  double reference_gray_ = -1.0;
  int frame_ = 0;
};

}  // namespace mivo
