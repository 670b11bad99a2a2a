// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <deque>
#include <optional>

#include "session/stamp_pairer.h"

namespace mivo {

/// How far the clocks that stamp color and depth are apart, measured by when the images came:
/// images of one camera come together, whatever their stamps say. Only where they come as fast as
/// their stamps say: a bag that was written anew, or is played slowly, tells nothing.
class ClockOffset {
 public:
  /// @param stamp, arrival  s, of one image
  void add(ImageStream stream, double stamp, double arrival);

  /// s, stamps of depth minus those of color for images that came together: the median of the
  /// last ones. Nothing while it cannot be told.
  std::optional<double> seconds() const;

  /// Whether images of equal stamps belong together. An offset below half a second may be the way
  /// of the messages; above, color and depth of a pair would be of different times.
  static bool isBelievable(double offset) { return offset > -kLargest && offset < kLargest; }

 private:
  static constexpr double kLargest = 0.5;  // s
  struct Sample {
    double stamp;
    double arrival;
  };

  std::array<std::deque<Sample>, 2> samples_;
};

}  // namespace mivo
