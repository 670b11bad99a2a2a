// SPDX-License-Identifier: BSD-3-Clause
#include "openni2/clock_filter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <random>
#include <vector>

namespace mivo {
namespace {

constexpr std::int64_t kSecond = 1000000000;
constexpr std::int64_t kMillisecond = 1000000;
constexpr std::int64_t kEpoch = 1700000000 * kSecond;
constexpr std::uint64_t kDeviceEpoch = 5000000;
constexpr int kWarmUp = 10;  // images of each stream that a session holds back

struct Simulation {
  double ppm = 0.0;
  double jitter = 0.003;     // s, mean of an exponential delay
  double start_delay = 0.2;  // s, of the first image: the stream was being set up
  int seconds = 60;
  unsigned seed = 7;
  double busy = 0.0;  // s, largest additional delay while the machine is busy
};

struct Image {
  StreamKind kind;
  std::uint64_t stamp;
  std::int64_t taken;
  std::int64_t arrival;
};

// Color and depth, 30 Hz each, in order of arrival.
std::vector<Image> simulate(const Simulation& simulation) {
  std::mt19937 random(simulation.seed);
  std::exponential_distribution<double> delay(1.0);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  std::vector<Image> images;
  bool is_busy = true;  // at the start, then alternating
  for (int i = 0; i < simulation.seconds * 30; ++i) {
    const std::int64_t taken = kEpoch + i * kSecond / 30;
    const double device = static_cast<double>(taken - kEpoch) * (1.0 + simulation.ppm * 1e-6);
    const auto stamp = kDeviceEpoch + static_cast<std::uint64_t>(std::llround(device / 1000.0));
    is_busy = uniform(random) < 0.1 ? !is_busy : is_busy;
    const double held_up = is_busy ? simulation.busy * uniform(random) : 0.0;
    for (StreamKind kind : {StreamKind::kColor, StreamKind::kDepth}) {
      double late = held_up + simulation.jitter * delay(random);
      late += uniform(random) < 0.02 ? 0.04 : 0.0;  // occasionally the machine is busy
      late += i == 0 ? simulation.start_delay : 0.0;
      images.push_back({kind, stamp, taken,
                        taken + static_cast<std::int64_t>(late * static_cast<double>(kSecond))});
    }
  }
  std::stable_sort(images.begin(), images.end(),
                   [](const Image& a, const Image& b) { return a.arrival < b.arrival; });
  return images;
}

struct Outcome {
  double worst = 0.0;  // ms
  int stamped = 0;
  bool grows = true;
  double skew = 0.0;  // ppm
};

// As in a session: images are held back at first, and until the clocks have been compared.
Outcome stampAll(const Simulation& simulation) {
  Outcome outcome;
  ClockFilter filter;
  int seen[kStreamKinds] = {0, 0};
  std::uint64_t newest[kStreamKinds] = {0, 0};
  std::int64_t previous[kStreamKinds] = {0, 0};
  for (const Image& image : simulate(simulation)) {
    const auto k = static_cast<std::size_t>(image.kind);
    if (image.stamp <= newest[k]) {
      continue;  // a driver delivers the images of a stream in order
    }
    newest[k] = image.stamp;
    filter.observe(image.stamp, image.arrival);
    if (++seen[k] <= kWarmUp || (outcome.stamped == 0 && !filter.isSettled())) {
      continue;
    }
    const std::int64_t host = filter.hostTime(image.kind, image.stamp);
    outcome.grows = outcome.grows && host > previous[k];
    previous[k] = host;
    outcome.worst =
        std::max(outcome.worst, std::abs(static_cast<double>(host - image.taken)) / kMillisecond);
    ++outcome.stamped;
  }
  outcome.skew = filter.skew() * 1e6;
  return outcome;
}

class ClockFilterDriftTest : public ::testing::TestWithParam<double> {};

TEST_P(ClockFilterDriftTest, MinuteOfJitterStaysWithinTwoMillisecondsAndGrows) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    Simulation simulation;
    simulation.ppm = GetParam();
    simulation.seed = seed;
    const Outcome outcome = stampAll(simulation);
    EXPECT_TRUE(outcome.grows);
    EXPECT_LT(outcome.worst, 2.0) << "seed " << seed;
    EXPECT_GT(outcome.stamped, 2 * 28 * 60);
    EXPECT_NEAR(outcome.skew, GetParam(), 20.0);
  }
}

TEST_P(ClockFilterDriftTest, BusyMachineDelaysImagesButNotStamps) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    Simulation simulation;
    simulation.ppm = GetParam();
    simulation.seed = seed;
    simulation.jitter = 0.001;
    simulation.busy = 0.03;
    const Outcome outcome = stampAll(simulation);
    EXPECT_TRUE(outcome.grows);
    EXPECT_LT(outcome.worst, 2.0) << "seed " << seed;
    EXPECT_GT(outcome.stamped, 2 * 26 * 60);
    EXPECT_NEAR(outcome.skew, GetParam(), 20.0);
  }
}

INSTANTIATE_TEST_SUITE_P(Skews, ClockFilterDriftTest, ::testing::Values(-200.0, 0.0, 200.0, 500.0));

TEST(ClockFilterTest, PerfectArrivalIsReproducedToTheMicrosecond) {
  ClockFilter filter;
  for (int i = 0; i < 600; ++i) {
    const std::int64_t taken = kEpoch + i * kSecond / 30;
    const auto stamp = kDeviceEpoch + static_cast<std::uint64_t>(i) * 1000000 / 30;
    filter.observe(stamp, taken);
    EXPECT_NEAR(filter.hostTime(StreamKind::kColor, stamp) - taken, 0, 2000);
  }
}

TEST(ClockFilterTest, SingleVeryLateImageMovesNothing) {
  ClockFilter filter;
  for (int i = 0; i < 300; ++i) {
    const std::int64_t taken = kEpoch + i * kSecond / 30;
    const auto stamp = kDeviceEpoch + static_cast<std::uint64_t>(i) * 1000000 / 30;
    const std::int64_t late = i == 150 ? 5 * kSecond : 0;
    filter.observe(stamp, taken + late);
    EXPECT_NEAR(filter.hostTime(StreamKind::kColor, stamp) - taken, 0, 2000) << i;
  }
}

TEST(ClockFilterTest, DeviceClockThatStartsAnewIsFollowedAndStampsStillGrow) {
  ClockFilter filter;
  std::int64_t previous = 0;
  for (int i = 0; i < 300; ++i) {
    const std::int64_t taken = kEpoch + i * kSecond / 30;
    const auto stamp = kDeviceEpoch + static_cast<std::uint64_t>(i % 150) * 1000000 / 30;
    filter.observe(stamp, taken);
    const std::int64_t host = filter.hostTime(StreamKind::kDepth, stamp);
    EXPECT_GT(host, previous);
    previous = host;
    if (i % 150 > 10) {
      EXPECT_NEAR(host - taken, 0, 2000);
    }
  }
}

TEST(ClockFilterTest, HostClockThatWasSetBackIsFollowed) {
  ClockFilter filter;
  for (int i = 0; i < 300; ++i) {
    const std::int64_t back = i < 150 ? 0 : 3600 * kSecond;
    const std::int64_t taken = kEpoch + i * kSecond / 30 - back;
    const auto stamp = kDeviceEpoch + static_cast<std::uint64_t>(i) * 1000000 / 30;
    filter.observe(stamp, taken);
    const std::int64_t host = filter.hostTime(StreamKind::kColor, stamp);
    if (i % 150 > 10) {
      EXPECT_NEAR(host - taken, 0, 2000) << i;
    }
  }
}

TEST(ClockFilterTest, SettlesOnlyOnceDelaysStopFalling) {
  ClockFilter filter;
  EXPECT_FALSE(filter.isSettled());
  for (int i = 0; i < 60; ++i) {
    const std::int64_t taken = kEpoch + i * kSecond / 30;
    const auto stamp = kDeviceEpoch + static_cast<std::uint64_t>(i) * 1000000 / 30;
    const std::int64_t late = std::max(0, 30 - i) * kMillisecond;  // a busy start
    filter.observe(stamp, taken + late);
    EXPECT_EQ(filter.isSettled(), i >= 50) << i;
  }
}

TEST(ClockFilterTest, AnotherDeviceStartsAnew) {
  ClockFilter filter;
  filter.observe(1000, kEpoch);
  filter.reset();
  filter.observe(99000000, kEpoch + 10 * kSecond);
  EXPECT_EQ(filter.hostTime(StreamKind::kColor, 99000000), kEpoch + 10 * kSecond);
}

}  // namespace
}  // namespace mivo
