// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/stamps.h"

#include <algorithm>
#include <cmath>

namespace mivo {

Trajectory sortedByStamp(Trajectory trajectory) {
  std::stable_sort(trajectory.begin(), trajectory.end(),
                   [](const StampedPose& a, const StampedPose& b) { return a.stamp < b.stamp; });
  // std::unique keeps the first of equals: seen from the end that is the last.
  const auto same = [](const StampedPose& a, const StampedPose& b) { return a.stamp == b.stamp; };
  const auto kept = std::unique(trajectory.rbegin(), trajectory.rend(), same);
  trajectory.erase(trajectory.begin(), kept.base());
  return trajectory;
}

std::vector<double> stampsOf(const Trajectory& trajectory) {
  std::vector<double> stamps;
  stamps.reserve(trajectory.size());
  for (const StampedPose& pose : trajectory) stamps.push_back(pose.stamp);
  return stamps;
}

std::size_t nearestIndex(const std::vector<double>& stamps, double stamp) {
  std::size_t nearest = 0;
  std::size_t low = 0;
  std::size_t high = stamps.size();
  while (low < high) {
    const std::size_t middle = low + (high - low) / 2;
    if (std::abs(stamps[middle] - stamp) < std::abs(stamps[nearest] - stamp)) nearest = middle;
    if (stamps[middle] > stamp) {
      high = middle;
    } else {
      low = middle + 1;
    }
  }
  return nearest;
}

}  // namespace mivo
