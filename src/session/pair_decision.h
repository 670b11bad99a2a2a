// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

namespace mivo {

/// Stamps (s) of one stream that wait for their partners.
struct WaitingStamps {
  std::vector<double> stamps;  ///< in order
  double next = 0.0;           ///< no further image is expected to be older than this
};

/// What is certain about a waiting image.
struct PairFate {
  enum class Kind { kOpen, kPaired, kSingle };
  Kind kind = Kind::kOpen;
  std::size_t partner = 0;  ///< its number in the other list, when paired
};

struct PairFates {
  std::vector<PairFate> first;
  std::vector<PairFate> second;
};

/// Pairs stamps nearest to each other: of all pairs `max_difference` apart at most the closest is
/// taken, then the closest among what is left, and so on; each stamp is used once at most, and no
/// two pairs cross. What an image that is still to come could change stays open.
PairFates decidePairs(const WaitingStamps& first, const WaitingStamps& second,
                      double max_difference);

}  // namespace mivo
