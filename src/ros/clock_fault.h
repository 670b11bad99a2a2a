// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <string>

#include "session/clock_offset.h"

namespace mivo {

/// Why no pair of equal stamps can be believed, for a measured offset of the clocks (s); empty when
/// they can. The same text for offsets that are nearly the same.
inline std::string describeClockFault(double offset) {
  if (ClockOffset::isBelievable(offset)) return {};
  return fmt::format(
      "color and depth that come together are stamped {:.1f} s apart (depth {}): two clocks; "
      "pairs of equal stamps would be of different times",
      std::abs(offset), offset > 0.0 ? "later" : "earlier");
}

/// A line for pairs whose depth is stamped so much later than color (s) that the image before or
/// after is nearly as close; empty for less.
inline std::string describePairOffset(double offset) {
  constexpr double kNoted = 0.012;  // s
  if (std::abs(offset) < kNoted) return {};
  return fmt::format("depth is stamped {:.1f} ms {} than the color images that it is paired with",
                     1000.0 * std::abs(offset), offset > 0.0 ? "later" : "earlier");
}

}  // namespace mivo
