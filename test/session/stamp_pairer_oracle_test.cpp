// SPDX-License-Identifier: BSD-3-Clause
// Random stamps: for any order of arrival the pairs are those of a brute-force search.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "session/stamp_pairer.h"

namespace mivo {
namespace {

constexpr ImageStream kC = ImageStream::kColor;
constexpr ImageStream kD = ImageStream::kDepth;

using Pairs = std::vector<std::pair<std::size_t, std::size_t>>;

/// Repeatedly takes the closest of the remaining pairs that cross no other.
Pairs bruteForce(const std::vector<double>& first, const std::vector<double>& second,
                 double limit) {
  Pairs pairs;
  for (;;) {
    double best = std::nextafter(limit, 1.0);
    std::pair<std::size_t, std::size_t> pair;
    for (std::size_t i = 0; i < first.size(); ++i) {
      for (std::size_t j = 0; j < second.size(); ++j) {
        const double difference = std::abs(first[i] - second[j]);
        bool fits = difference < best;
        for (const auto& [k, l] : pairs) fits = fits && ((k < i && l < j) || (k > i && l > j));
        if (!fits) continue;
        best = difference;
        pair = {i, j};
      }
    }
    if (best > limit) break;
    pairs.push_back(pair);
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

/// `count` stamps at whole microseconds within a second.
std::vector<double> randomStamps(std::size_t count, std::mt19937& engine) {
  std::vector<double> stamps(count);
  for (double& stamp : stamps) stamp = 1e-6 * static_cast<double>(engine() % 1000000);
  std::sort(stamps.begin(), stamps.end());
  return stamps;
}

TEST(StampPairerOracleTest, ListsGiveThePairsOfBruteForce) {
  std::mt19937 engine(7);
  for (int round = 0; round < 50; ++round) {
    const std::vector<double> color = randomStamps(20, engine);
    const std::vector<double> depth = randomStamps(25, engine);
    EXPECT_EQ(pairByStamp(color, depth, 0.03), bruteForce(color, depth, 0.03));
  }
}

TEST(StampPairerOracleTest, PairsAreTheSameHoweverTheStreamsArrive) {
  std::mt19937 engine(11);
  for (int round = 0; round < 200; ++round) {
    const std::vector<double> color = randomStamps(30, engine);
    const std::vector<double> depth = randomStamps(30, engine);
    Pairs pairs;
    std::size_t singles = 0;
    std::size_t last[2] = {0, 0};  // each stream keeps its order
    StampPairer<std::size_t> pairer(
        {},
        [&](std::size_t& i, std::size_t& j) {
          pairs.emplace_back(i, j);
          EXPECT_LE(last[0], i);
          EXPECT_LE(last[1], j);
          last[0] = i + 1;
          last[1] = j + 1;
        },
        [&](ImageStream stream, std::size_t& i) {
          ++singles;
          EXPECT_LE(last[static_cast<std::size_t>(stream)], i);
          last[static_cast<std::size_t>(stream)] = i + 1;
        });
    for (std::size_t i = 0, j = 0; i < color.size() || j < depth.size();) {
      if (j == depth.size() || (i < color.size() && engine() % 2 == 0)) {
        pairer.push(kC, color[i], i);
        ++i;
      } else {
        pairer.push(kD, depth[j], j);
        ++j;
      }
    }
    pairer.flush();
    EXPECT_EQ(pairs, pairByStamp(color, depth));
    EXPECT_EQ(2 * pairs.size() + singles, color.size() + depth.size());
  }
}

TEST(StampPairerOracleTest, ACameraThatLosesImagesGivesAllPairsWithinTheTolerance) {
  constexpr double kTolerance = 0.016;  // s, of a period of 33 ms
  std::mt19937 engine(3);
  for (int round = 0; round < 50; ++round) {
    std::vector<double> stamps[2];
    for (int i = 1; i <= 100; ++i) {
      for (std::vector<double>& stream : stamps) {
        if (engine() % 4 != 0) stream.push_back(0.033 * i + 1e-6 * (engine() % 5000));
      }
    }
    Pairs expected;
    for (std::size_t i = 0; i < stamps[0].size(); ++i) {
      for (std::size_t j = 0; j < stamps[1].size(); ++j) {
        if (std::abs(stamps[0][i] - stamps[1][j]) <= kTolerance) expected.emplace_back(i, j);
      }
    }
    PairingOptions options;
    options.max_difference = kTolerance;
    options.min_gap = 2.0 * kTolerance;
    options.capacity = 4;
    Pairs pairs;
    StampPairer<std::size_t> pairer(
        options, [&](std::size_t& i, std::size_t& j) { pairs.emplace_back(i, j); },
        [](ImageStream, std::size_t&) {});
    // Each stream in order, depth up to 40 ms late.
    for (std::size_t i = 0, j = 0; i < stamps[0].size() || j < stamps[1].size();) {
      const bool is_color =
          j == stamps[1].size() ||
          (i < stamps[0].size() && stamps[0][i] < stamps[1][j] + 1e-6 * (engine() % 40000));
      pairer.push(is_color ? kC : kD, stamps[is_color ? 0 : 1][is_color ? i : j], is_color ? i : j);
      ++(is_color ? i : j);
    }
    pairer.flush();
    EXPECT_EQ(pairs, expected);
  }
}

TEST(StampPairerOracleTest, ALongRecordingKeepsNothingBack) {
  std::mt19937 engine(3);
  std::size_t most = 0;
  std::size_t pairs = 0;
  StampPairer<int> pairer(
      {}, [&](int&, int&) { ++pairs; }, [](ImageStream, int&) {});
  for (int i = 0; i < 3000; ++i) {
    const double jitter = 1e-6 * static_cast<double>(engine() % 4000);
    pairer.push(kC, i / 30.0, i);
    pairer.push(kD, i / 30.0 + 0.008 + jitter, i);
    most = std::max({most, pairer.numWaiting(kC), pairer.numWaiting(kD)});
  }
  EXPECT_EQ(pairs, 2999U);  // the last may still find a better partner
  EXPECT_LE(most, 2U);
}

}  // namespace
}  // namespace mivo
