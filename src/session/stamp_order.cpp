// SPDX-License-Identifier: BSD-3-Clause
#include "session/stamp_order.h"

#include <cmath>

#include "mivo/core/error.h"
#include "session/median.h"

namespace mivo {
namespace {

// s; stamps of today, whatever their unit is: 1980 to 2128.
constexpr double kEarliest = 3e8;
constexpr double kLatest = 5e9;
// s; images of today that are further apart are none: the unit is another.
constexpr double kLongestGap = 10.0;
// gap >= this: whole stamps of a clock that began with the recording. As seconds the images would
// be days, or hours, apart; a camera of 1 to 200 Hz has these gaps in nano- and microseconds.
constexpr double kNanosecondGap = 1e6;
constexpr double kMicrosecondGap = 4e3;

/// Between stamps that follow each other and differ; 0 when none do.
double medianGap(std::vector<double> stamps) {
  std::sort(stamps.begin(), stamps.end());
  std::vector<double> gaps;
  for (std::size_t i = 1; i < stamps.size(); ++i) {
    if (stamps[i] > stamps[i - 1]) gaps.push_back(stamps[i] - stamps[i - 1]);
  }
  return gaps.empty() ? 0.0 : medianOf(gaps);
}

}  // namespace

void refuseEqualStamps(std::size_t count, double stamp) {
  throw Error("all " + std::to_string(count) + " stamps are " + std::to_string(stamp) +
              ": without times nothing can be tracked");
}

double stampUnit(std::vector<double> stamps) {
  stamps.erase(std::remove(stamps.begin(), stamps.end(), 0.0), stamps.end());
  const bool are_whole = std::all_of(stamps.begin(), stamps.end(),
                                     [](double stamp) { return stamp == std::floor(stamp); });
  if (stamps.empty() || !are_whole) return 1.0;
  const double gap = medianGap(stamps);
  const double middle = medianOf(stamps);
  for (const double unit : {1.0, 1e-3, 1e-6, 1e-9}) {
    const double seconds = unit * middle;
    if (seconds > kEarliest && seconds < kLatest && unit * gap < kLongestGap) return unit;
  }
  return gap >= kNanosecondGap ? 1e-9 : gap >= kMicrosecondGap ? 1e-6 : 1.0;
}

std::string nameOfUnit(double unit) {
  return unit == 1e-9   ? "nanoseconds"
         : unit == 1e-6 ? "microseconds"
         : unit == 1e-3 ? "milliseconds"
                        : "seconds";
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
    tell("the stamps of the " + items + " are " + nameOfUnit(order.unit));
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
