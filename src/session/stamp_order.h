// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <string>
#include <vector>

namespace mivo {

/// What putInOrder() had to change.
struct StampOrder {
  bool was_sorted = true;
  std::size_t doubled = 0;  ///< items left out, for another has their stamp
};

/// Throws Error, for all stamps (s) of a list are the same.
[[noreturn]] void refuseEqualStamps(std::size_t count, double stamp);

/// Sorts items by their member `stamp` (s); of those with the same stamp the first stays. Throws
/// Error when there are several and all have the same stamp, for then there is no time in them.
template <typename Item>
StampOrder putInOrder(std::vector<Item>& items) {
  const auto is_earlier = [](const Item& a, const Item& b) { return a.stamp < b.stamp; };
  const auto is_doubled = [](const Item& a, const Item& b) { return a.stamp == b.stamp; };
  StampOrder order;
  order.was_sorted = std::is_sorted(items.begin(), items.end(), is_earlier);
  std::stable_sort(items.begin(), items.end(), is_earlier);
  if (items.size() > 1 && items.front().stamp == items.back().stamp) {
    refuseEqualStamps(items.size(), items.front().stamp);
  }
  const auto end = std::unique(items.begin(), items.end(), is_doubled);
  order.doubled = static_cast<std::size_t>(std::distance(end, items.end()));
  items.erase(end, items.end());
  return order;
}

/// What was changed, in words; empty when nothing was.
/// @param items  what the items are, in the plural
std::string describe(const StampOrder& order, const std::string& items);

}  // namespace mivo
