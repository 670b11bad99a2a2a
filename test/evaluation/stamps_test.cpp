// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/stamps.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace mivo {
namespace {

StampedPose poseAt(double stamp, double x) {
  StampedPose pose;
  pose.stamp = stamp;
  pose.pose.translation().x() = x;
  return pose;
}

TEST(StampsTest, SortingKeepsTheLastOfEqualStamps) {
  const Trajectory sorted =
      sortedByStamp({poseAt(2.0, 1.0), poseAt(1.0, 2.0), poseAt(2.0, 3.0), poseAt(1.5, 4.0)});
  ASSERT_EQ(sorted.size(), 3U);
  EXPECT_EQ(stampsOf(sorted), (std::vector<double>{1.0, 1.5, 2.0}));
  EXPECT_EQ(sorted[2].pose.translation().x(), 3.0);
}

TEST(StampsTest, NearestIsNearest) {
  std::mt19937 engine(11);
  for (int size = 1; size < 40; ++size) {
    std::vector<double> stamps;
    for (int i = 0; i < size; ++i) stamps.push_back(static_cast<double>(engine() % 1000));
    std::sort(stamps.begin(), stamps.end());
    for (double stamp = -10.0; stamp < 1010.0; stamp += 3.7) {
      double best = std::abs(stamps[0] - stamp);
      for (const double other : stamps) best = std::min(best, std::abs(other - stamp));
      EXPECT_EQ(std::abs(stamps[nearestIndex(stamps, stamp)] - stamp), best);
    }
  }
}

TEST(StampsTest, TieGoesToWhatTheBinarySearchMeetsFirst) {
  // Of 4 stamps the search looks at number 2 first, then at number 1.
  EXPECT_EQ(nearestIndex({0.0, 1.0, 2.0, 3.0}, 1.5), 2U);
  // Of 5 it looks at number 2, then 1, then 0.
  EXPECT_EQ(nearestIndex({0.0, 1.0, 2.0, 3.0, 4.0}, 1.5), 2U);
  EXPECT_EQ(nearestIndex({0.0, 1.0, 2.0, 3.0, 4.0}, 2.5), 2U);
  // Number 0 is the first guess, before the search begins.
  EXPECT_EQ(nearestIndex({0.0, 1.0, 2.0, 3.0, 4.0}, 0.5), 0U);
}

}  // namespace
}  // namespace mivo
