// SPDX-License-Identifier: BSD-3-Clause
#include "session/stamp_order.h"

#include <cmath>

#include "mivo/core/error.h"

namespace mivo {
namespace {

// stamp > this many units: no time in seconds (the year 5138), but one in the smaller unit, of
// today. Today is 1.7e9 s.
constexpr double kMilliseconds = 1e11;
constexpr double kMicroseconds = 1e14;
constexpr double kNanoseconds = 1e17;
// gap >= this: whole stamps of a clock that began with the recording. As seconds the images would
// be days, or hours, apart; a camera of 1 to 200 Hz has these gaps in nano- and microseconds.
constexpr double kNanosecondGap = 1e6;
constexpr double kMicrosecondGap = 4e3;
// s; stamps beyond are times of day: a clock that began with the recording ran for 11 days.
constexpr double kTimeOfDay = 1e6;

/// Of values that are not empty.
double medianOf(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

void refuseEqualStamps(std::size_t count, double stamp) {
  throw Error("all " + std::to_string(count) + " stamps are " + std::to_string(stamp) +
              ": without times nothing can be tracked");
}

double stampUnit(std::vector<double> stamps) {
  stamps.erase(std::remove(stamps.begin(), stamps.end(), 0.0), stamps.end());
  if (stamps.empty()) return 1.0;
  std::sort(stamps.begin(), stamps.end());
  const double middle = stamps[stamps.size() / 2];
  if (middle > kNanoseconds) return 1e-9;
  if (middle > kMicroseconds) return 1e-6;
  if (middle > kMilliseconds) return 1e-3;
  const bool are_whole = std::all_of(stamps.begin(), stamps.end(),
                                     [](double stamp) { return stamp == std::floor(stamp); });
  if (!are_whole) return 1.0;
  std::vector<double> gaps;
  for (std::size_t i = 1; i < stamps.size(); ++i) {
    if (stamps[i] > stamps[i - 1]) gaps.push_back(stamps[i] - stamps[i - 1]);
  }
  if (gaps.empty()) return 1.0;
  const double gap = medianOf(gaps);
  return gap >= kNanosecondGap ? 1e-9 : gap >= kMicrosecondGap ? 1e-6 : 1.0;
}

bool isZeroUnset(const std::vector<double>& stamps) {
  std::vector<double> others;
  for (const double stamp : stamps) {
    if (stamp != 0.0) others.push_back(stamp);
  }
  return others.size() < stamps.size() && !others.empty() && medianOf(others) > kTimeOfDay;
}

std::string describe(const StampOrder& order, const std::string& items) {
  std::string text;
  const auto tell = [&](const std::string& more) { text += (text.empty() ? "" : "; ") + more; };
  if (order.unit != 1.0) {
    const char* const unit = order.unit == 1e-9   ? "nanoseconds"
                             : order.unit == 1e-6 ? "microseconds"
                                                  : "milliseconds";
    tell("the stamps of the " + items + " are " + unit);
  }
  if (order.unset > 0) {
    tell(std::to_string(order.unset) + " of the " + items + " left out: their stamp is zero");
  }
  if (!order.was_sorted) {
    tell("the " + items + " were not in the order of their stamps and are sorted");
  }
  if (order.doubled > 0) {
    const std::string doubled = std::to_string(order.doubled);
    tell(doubled + (order.was_sorted ? " of the " + items : " of them") +
         " left out: others have the same stamps");
  }
  return text;
}

}  // namespace mivo
