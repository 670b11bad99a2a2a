// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <string>
#include <vector>

namespace mivo {

/// s; stamps beyond are times of day: a clock that began with the recording ran for 11 days.
constexpr double kTimeOfDay = 1e6;

/// What putInOrder() had to change.
struct StampOrder {
  double unit = 1.0;  ///< s, of the stamps as they were
  bool was_sorted = true;
  std::size_t unset = 0;    ///< items left out, for their stamp is zero among times of day
  std::size_t doubled = 0;  ///< items left out, for another has their stamp
};

/// Throws Error, for all stamps (s) of a list are the same.
[[noreturn]] void refuseEqualStamps(std::size_t count, double stamp);

/// Seconds in a unit of the stamps of a list: 1, or that of milli-, micro- or nanoseconds, when
/// they are whole numbers that are a time of today so, or hours apart otherwise.
double stampUnit(std::vector<double> stamps);

/// "nanoseconds" and so on.
std::string nameOfUnit(double unit);

/// Whether a stamp of zero among these (s) means that nobody has set it: the others are times of
/// day, not of a clock that began with the recording.
bool isZeroUnset(const std::vector<double>& stamps);

/// Sorts items by their member `stamp`, which becomes seconds; of those with the same stamp the
/// first stays. Throws Error when there are several and all have the same stamp, for then there is
/// no time in them.
template <typename Item>
StampOrder putInOrder(std::vector<Item>& items) {
  const auto is_earlier = [](const Item& a, const Item& b) { return a.stamp < b.stamp; };
  const auto is_doubled = [](const Item& a, const Item& b) { return a.stamp == b.stamp; };
  const auto stamps_of = [&] {
    std::vector<double> stamps;
    for (const Item& item : items) stamps.push_back(item.stamp);
    return stamps;
  };
  StampOrder order;
  order.unit = stampUnit(stamps_of());
  for (Item& item : items) item.stamp *= order.unit;
  if (isZeroUnset(stamps_of())) {
    const auto unset = std::remove_if(items.begin(), items.end(),
                                      [](const Item& item) { return item.stamp == 0.0; });
    order.unset = static_cast<std::size_t>(std::distance(unset, items.end()));
    items.erase(unset, items.end());
  }
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
