// SPDX-License-Identifier: BSD-3-Clause
#include "ros/stamp.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstdlib>
#include <limits>
#include <random>
#include <string>

#include "ros/expect_error.h"

namespace mivo {
namespace {

TEST(StampTest, SecondsAreThoseOfTheTextToTheBit) {
  std::mt19937_64 engine(3);
  std::uniform_int_distribution<std::uint32_t> microseconds(0, 999999);
  for (const std::uint32_t second : {0U, 1U, 12345U, 1305031910U, 4294967000U}) {
    for (int i = 0; i < 2000; ++i) {
      const std::uint32_t fraction = microseconds(engine);
      std::string digits = std::to_string(fraction);
      digits.insert(0, 6 - digits.size(), '0');
      const double from_text =
          std::strtod((std::to_string(second) + '.' + digits).c_str(), nullptr);
      ASSERT_EQ(from_text, toSeconds(ros::Time(second, fraction * 1000)));
      ASSERT_EQ(from_text, toSeconds(toTime(from_text)));  // through a bag and back
    }
  }
}

TEST(StampTest, WhatRosCannotHoldIsRefused) {
  EXPECT_ERROR(toTime(-0.1), "between 0 and");
  EXPECT_ERROR(toTime(5e9), "between 0 and");
  EXPECT_ERROR(toTime(std::numeric_limits<double>::quiet_NaN()), "between 0 and");
}

TEST(StampTest, RoundingUpCarriesIntoTheSeconds) {
  EXPECT_EQ(ros::Time(3, 0), toTime(2.9999999999));
}

}  // namespace
}  // namespace mivo
