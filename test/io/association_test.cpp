// SPDX-License-Identifier: BSD-3-Clause
#include "trajectory/association.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace mivo {
namespace {

using Pairs = std::vector<std::pair<std::size_t, std::size_t>>;

TEST(AssociationTest, PairsNearestStampsWithinLimit) {
  EXPECT_EQ(associate({0.0, 1.0, 2.0}, {0.01, 1.5, 1.99}, 0.1), (Pairs{{0, 0}, {2, 2}}));
}

TEST(AssociationTest, StampIsUsedOnceByTheNearer) {
  // Both are within the limit of 1.0; the second is nearer, the first gets the remaining one.
  EXPECT_EQ(associate({0.97, 0.99}, {1.0}, 0.1), (Pairs{{1, 0}}));
  EXPECT_EQ(associate({0.97, 0.99}, {0.9, 1.0}, 0.1), (Pairs{{0, 0}, {1, 1}}));
}

TEST(AssociationTest, LimitItselfIsTooFar) {
  EXPECT_TRUE(associate({0.0}, {0.5}, 0.5).empty());
  EXPECT_EQ(associate({0.0}, {0.5}, 0.5000001).size(), 1U);
}

TEST(AssociationTest, EmptyListsHaveNoPairs) {
  EXPECT_TRUE(associate({}, {1.0}, 1.0).empty());
  EXPECT_TRUE(associate({1.0}, {}, 1.0).empty());
}

/// Repeatedly takes the closest of the remaining pairs.
Pairs bruteForce(const std::vector<double>& first, const std::vector<double>& second,
                 double limit) {
  std::vector<bool> used_first(first.size());
  std::vector<bool> used_second(second.size());
  Pairs pairs;
  for (;;) {
    double best = limit;
    std::pair<std::size_t, std::size_t> pair;
    for (std::size_t i = 0; i < first.size(); ++i) {
      for (std::size_t j = 0; j < second.size(); ++j) {
        const double difference = std::abs(first[i] - second[j]);
        if (used_first[i] || used_second[j] || difference >= best) continue;
        best = difference;
        pair = {i, j};
      }
    }
    if (best >= limit) break;
    used_first[pair.first] = true;
    used_second[pair.second] = true;
    pairs.push_back(pair);
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

TEST(AssociationTest, AgreesWithBruteForce) {
  std::mt19937 engine(7);
  for (int round = 0; round < 50; ++round) {
    std::vector<double> first(20);
    std::vector<double> second(25);
    for (double& stamp : first) stamp = 1e-6 * static_cast<double>(engine() % 1000000);
    for (double& stamp : second) stamp = 1e-6 * static_cast<double>(engine() % 1000000);
    std::sort(first.begin(), first.end());
    std::sort(second.begin(), second.end());
    EXPECT_EQ(associate(first, second, 0.03), bruteForce(first, second, 0.03));
  }
}

}  // namespace
}  // namespace mivo
