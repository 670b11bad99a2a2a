// SPDX-License-Identifier: BSD-3-Clause
#include "session/stamp_pairer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <random>
#include <string>

namespace mivo {
namespace {

constexpr ImageStream kC = ImageStream::kColour;
constexpr ImageStream kD = ImageStream::kDepth;

using Pairs = std::vector<std::pair<std::size_t, std::size_t>>;

/// Stamps in whole milliseconds. Writes "(c,d)" for pairs and "c" or "d" for images without
/// partner, in the order in which they go out.
class StampPairerTest : public ::testing::Test {
 protected:
  void setUp(const PairingOptions& options) {
    pairer_ = std::make_unique<StampPairer<std::unique_ptr<int>>>(
        options,
        [this](std::unique_ptr<int>& c, std::unique_ptr<int>& d) {
          log_ += '(' + std::to_string(*c) + ',' + std::to_string(*d) + ')';
        },
        [this](ImageStream stream, std::unique_ptr<int>& item) {
          log_ += (stream == kC ? 'c' : 'd') + std::to_string(*item);
        });
  }

  void push(ImageStream stream, int milliseconds) {
    pairer_->push(stream, 0.001 * milliseconds, std::make_unique<int>(milliseconds));
  }

  std::string log_;
  std::unique_ptr<StampPairer<std::unique_ptr<int>>> pairer_;  // move only: nothing may copy them
};

TEST_F(StampPairerTest, EqualStampsArePairedAtOnce) {
  setUp({});
  push(kC, 0);
  push(kD, 0);
  EXPECT_EQ(log_, "(0,0)");
  push(kD, 33);
  push(kC, 33);
  EXPECT_EQ(log_, "(0,0)(33,33)");
}

TEST_F(StampPairerTest, APairWaitsUntilNoImageToComeCanFitBetter) {
  setUp({});
  push(kC, 0);
  push(kD, 10);
  EXPECT_EQ(log_, "");  // the next colour image could have the stamp 10
  push(kC, 19);
  EXPECT_EQ(log_, "");  // it is nearer, and the next depth could be nearer still
  push(kD, 27);
  EXPECT_EQ(log_, "");  // nearer to 19: 10 would be left to 0; but the next colour may be at 20
  push(kC, 40);
  EXPECT_EQ(log_, "(0,10)(19,27)");
}

TEST_F(StampPairerTest, AKnownPeriodMakesWaitingNeedless) {
  PairingOptions options;
  options.min_gap = 0.030;
  setUp(options);
  push(kC, 0);
  push(kD, 10);
  EXPECT_EQ(log_, "(0,10)");
  push(kD, 43);
  push(kC, 50);
  EXPECT_EQ(log_, "(0,10)(50,43)");
}

TEST_F(StampPairerTest, ThePeriodIsLearned) {
  PairingOptions options;
  options.learns_gap = true;
  setUp(options);
  for (int i = 0; i < 11; ++i) {
    push(kC, 33 * i);
    push(kD, 33 * i + 12);
  }
  log_.clear();
  push(kC, 363);
  push(kD, 375);
  EXPECT_EQ(log_, "(363,375)");
}

TEST_F(StampPairerTest, WithoutPartnerOnceNoneCanCome) {
  setUp({});
  push(kC, 0);
  push(kC, 33);
  push(kD, 20);
  EXPECT_EQ(log_, "");  // 0 and 20 are 20 ms apart, the limit, and 33 is nearer
  push(kD, 40);
  EXPECT_EQ(log_, "");
  push(kC, 66);  // 33 and 40 are a pair: 20 is left to 0
  EXPECT_EQ(log_, "(0,20)(33,40)");
  push(kD, 87);
  EXPECT_EQ(log_, "(0,20)(33,40)c66");
}

TEST_F(StampPairerTest, TheLimitIsInclusive) {
  PairingOptions options;
  options.max_difference = 0.25;
  options.min_gap = 1.0;
  setUp(options);
  push(kC, 0);
  push(kD, 250);
  EXPECT_EQ(log_, "(0,250)");
  push(kC, 2000);
  push(kD, 2251);
  EXPECT_EQ(log_, "(0,250)c2000d2251");
}

TEST_F(StampPairerTest, ASilentPartnerHoldsBackNoMoreThanTheCapacity) {
  PairingOptions options;
  options.capacity = 3;
  setUp(options);
  for (int i = 0; i < 5; ++i) push(kC, 33 * i);
  EXPECT_EQ(log_, "c0c33");
  EXPECT_EQ(pairer_->numWaiting(kC), 3U);
  push(kD, 100);  // late, but what is nearest still waits
  pairer_->flush();
  EXPECT_EQ(log_, "c0c33c66(99,100)c132");
  EXPECT_EQ(pairer_->numWaiting(kC), 0U);
}

TEST_F(StampPairerTest, ImagesFromBeforeAJumpOfTimeGoOut) {
  setUp({});
  push(kC, 9000);
  push(kD, 9005);
  push(kC, 0);
  EXPECT_EQ(log_, "(9000,9005)");
  push(kD, 0);
  EXPECT_EQ(log_, "(9000,9005)(0,0)");
}

TEST_F(StampPairerTest, ADeviceClockMayNotGoBackAtAll) {
  PairingOptions options;
  options.time_jump = 0.0;
  setUp(options);
  push(kC, 90);
  push(kC, 57);
  EXPECT_EQ(log_, "c90");
  push(kD, 57);
  EXPECT_EQ(log_, "c90(57,57)");
}

TEST_F(StampPairerTest, ALateImageIsTakenWhereItBelongs) {
  setUp({});
  push(kC, 0);
  push(kC, 66);
  push(kC, 33);
  push(kD, 0);
  push(kD, 33);
  push(kD, 66);
  EXPECT_EQ(log_, "(0,0)(33,33)(66,66)");
}

TEST_F(StampPairerTest, ARecordingPlayedBackwardsIsPaired) {
  for (const bool learns_gap : {false, true}) {
    PairingOptions options;
    options.learns_gap = learns_gap;
    setUp(options);
    for (int i = 0; i < 12; ++i) {
      push(kC, 33 * i);
      push(kD, 33 * i);
    }
    log_.clear();
    for (int i = 3; i > 0; --i) {
      push(kC, 33 * i);
      push(kD, 33 * i);
    }
    EXPECT_EQ(log_, "(99,99)(66,66)(33,33)");
  }
}

TEST_F(StampPairerTest, PairsDoNotCross) {
  setUp({});
  for (const int stamp : {0, 10}) push(kC, stamp);
  for (const int stamp : {12, 14}) push(kD, stamp);
  pairer_->flush();
  EXPECT_EQ(log_, "c0(10,12)d14");
}

/// Takes the closest of all pairs that are left and cross none, again and again.
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
    const std::vector<double> colour = randomStamps(20, engine);
    const std::vector<double> depth = randomStamps(25, engine);
    EXPECT_EQ(pairByStamp(colour, depth, 0.03), bruteForce(colour, depth, 0.03));
  }
}

TEST(StampPairerOracleTest, PairsAreTheSameHoweverTheStreamsArrive) {
  std::mt19937 engine(11);
  for (int round = 0; round < 200; ++round) {
    const std::vector<double> colour = randomStamps(30, engine);
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
    for (std::size_t i = 0, j = 0; i < colour.size() || j < depth.size();) {
      if (j == depth.size() || (i < colour.size() && engine() % 2 == 0)) {
        pairer.push(kC, colour[i], i);
        ++i;
      } else {
        pairer.push(kD, depth[j], j);
        ++j;
      }
    }
    pairer.flush();
    EXPECT_EQ(pairs, pairByStamp(colour, depth));
    EXPECT_EQ(2 * pairs.size() + singles, colour.size() + depth.size());
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
    // Each stream in its order, depth up to 40 ms late.
    for (std::size_t i = 0, j = 0; i < stamps[0].size() || j < stamps[1].size();) {
      const bool is_colour =
          j == stamps[1].size() ||
          (i < stamps[0].size() && stamps[0][i] < stamps[1][j] + 1e-6 * (engine() % 40000));
      pairer.push(is_colour ? kC : kD, stamps[is_colour ? 0 : 1][is_colour ? i : j],
                  is_colour ? i : j);
      ++(is_colour ? i : j);
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
