// SPDX-License-Identifier: BSD-3-Clause
#include "ros/stamp.h"

#include <cmath>
#include <cstdint>
#include <iomanip>
#include <limits>
#include <locale>
#include <sstream>
#include <string>

#include "mivo/core/error.h"

namespace mivo {

double toSeconds(const ros::Time& time) {
  // sec + 1e-9 * nsec would round twice, and 1e-9 is not exact.
  std::stringstream text;
  text.imbue(std::locale::classic());
  text << time.sec << '.' << std::setw(9) << std::setfill('0') << time.nsec;
  double seconds = 0.0;
  text >> seconds;
  return seconds;
}

ros::Time toTime(double seconds) {
  constexpr double kNanosecondsPerSecond = 1e9;
  if (!(seconds >= 0.0 && seconds < std::numeric_limits<std::uint32_t>::max())) {
    throw Error("a stamp of " + std::to_string(seconds) +
                " s cannot be expressed in ROS: it must lie between 0 and 4294967295 s");
  }
  const double whole = std::floor(seconds);
  ros::Time time;
  time.fromNSec(
      static_cast<std::uint64_t>(whole) * 1000000000U +
      static_cast<std::uint64_t>(std::llround((seconds - whole) * kNanosecondsPerSecond)));
  return time;
}

}  // namespace mivo
