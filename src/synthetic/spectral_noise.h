// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>

namespace mivo {

/// Shape of a random texture's amplitude spectrum.
struct Spectrum {
  double exponent = 1.0;        ///< amplitude ~ 1 / frequency^exponent; natural images: about 1
  double stretch = 1.0;         ///< structures are this much longer along x than along y
  double lowest_frequency = 1;  ///< cycles per image below which the spectrum is flat
};

/// Random image with the given spectrum: CV_32FC1, size x size, mean 0, standard deviation 1,
/// nearly Gaussian, periodic in both directions. `size` must be even.
cv::Mat spectralNoise(int size, const Spectrum& spectrum, std::uint64_t seed);

}  // namespace mivo
