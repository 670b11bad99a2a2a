// SPDX-License-Identifier: BSD-3-Clause
#include "openni2/frame_pairer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <random>
#include <string>
#include <vector>

namespace mivo {
namespace {

constexpr StreamKind kC = StreamKind::kColor;
constexpr StreamKind kD = StreamKind::kDepth;

// Writes "(c,d)" for pairs and "c" or "d" for singles, in order.
class FramePairerTest : public ::testing::Test {
 protected:
  using Pairer = FramePairer<std::unique_ptr<int>>;  // move only: nothing may copy an image

  void add(StreamKind kind, std::uint64_t stamp) {
    pairer_.add(kind, stamp, std::make_unique<int>(static_cast<int>(stamp)));
  }

  std::string log_;
  Pairer pairer_{16000, 4,
                 [this](Pairer::Entry& c, Pairer::Entry& d) {
                   EXPECT_EQ(*c.image, static_cast<int>(c.stamp));
                   EXPECT_EQ(*d.image, static_cast<int>(d.stamp));
                   log_ += "(" + std::to_string(c.stamp) + "," + std::to_string(d.stamp) + ")";
                 },
                 [this](StreamKind kind, Pairer::Entry& entry) {
                   log_ += (kind == kC ? "c" : "d") + std::to_string(entry.stamp);
                 }};
};

TEST_F(FramePairerTest, PairsWhateverCameFirst) {
  add(kC, 0);
  add(kD, 100);
  add(kD, 33000);
  add(kC, 33300);
  EXPECT_EQ(log_, "(0,100)(33300,33000)");
}

TEST_F(FramePairerTest, ImageWithoutPartnerGoesOutAloneOnceTheOtherStreamIsPast) {
  add(kC, 0);
  add(kC, 33000);
  EXPECT_EQ(log_, "");
  add(kD, 33100);  // depth 0 was lost
  EXPECT_EQ(log_, "c0(33000,33100)");
}

TEST_F(FramePairerTest, StreamDelayedByTwoFramesIsStillPairedByItsStamp) {
  for (std::uint64_t i = 0; i < 5; ++i) {
    add(kC, i * 33000);
    if (i >= 2) {
      add(kD, (i - 2) * 33000 + 50);
    }
  }
  EXPECT_EQ(log_, "(0,50)(33000,33050)(66000,66050)");
}

TEST_F(FramePairerTest, ToleranceIsInclusive) {
  add(kC, 0);
  add(kD, 16000);
  add(kC, 33000);
  add(kD, 49001);
  EXPECT_EQ(log_, "(0,16000)c33000");
}

TEST_F(FramePairerTest, SilentPartnerHoldsBackNoMoreThanTheCapacity) {
  for (std::uint64_t i = 0; i < 6; ++i) {
    add(kC, i * 33000);
  }
  EXPECT_EQ(log_, "c0c33000");
  pairer_.flush();
  EXPECT_EQ(log_, "c0c33000c66000c99000c132000c165000");
}

TEST_F(FramePairerTest, ClockThatGoesBackReleasesWhatWaits) {
  add(kC, 90000);
  add(kC, 0);
  EXPECT_EQ(log_, "c90000");
  add(kD, 0);
  EXPECT_EQ(log_, "c90000(0,0)");
}

TEST(FramePairerOracleTest, RandomLossesGiveThePairsThatBruteForceFinds) {
  std::mt19937 random(3);
  for (int trial = 0; trial < 50; ++trial) {
    std::vector<std::uint64_t> color;
    std::vector<std::uint64_t> depth;
    for (std::uint64_t i = 1; i <= 100; ++i) {
      if (random() % 4 != 0) {
        color.push_back(i * 33000 + random() % 5000);
      }
      if (random() % 4 != 0) {
        depth.push_back(i * 33000 + random() % 5000);
      }
    }
    std::vector<std::pair<std::uint64_t, std::uint64_t>> expected;
    for (std::uint64_t c : color) {
      for (std::uint64_t d : depth) {
        if (std::max(c, d) - std::min(c, d) <= 16000) {
          expected.emplace_back(c, d);
        }
      }
    }
    std::vector<std::pair<std::uint64_t, std::uint64_t>> found;
    std::size_t singles = 0;
    using Pairer = FramePairer<int>;
    Pairer pairer(
        16000, 4, [&](Pairer::Entry& c, Pairer::Entry& d) { found.emplace_back(c.stamp, d.stamp); },
        [&](StreamKind, Pairer::Entry&) { ++singles; });
    // Arrival: each stream in order, interleaved by stamp with depth up to 40 ms late.
    std::size_t ci = 0;
    std::size_t di = 0;
    while (ci < color.size() || di < depth.size()) {
      const bool color_next =
          di == depth.size() || (ci < color.size() && color[ci] < depth[di] + random() % 40000);
      if (color_next) {
        pairer.add(kC, color[ci], 0);
        ++ci;
      } else {
        pairer.add(kD, depth[di], 0);
        ++di;
      }
    }
    pairer.flush();
    EXPECT_EQ(found, expected);
    EXPECT_EQ(singles + 2 * found.size(), color.size() + depth.size());
  }
}

}  // namespace
}  // namespace mivo
