// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/statistics.h"

#include <gtest/gtest.h>

#include <cmath>

namespace mivo {
namespace {

TEST(StatisticsTest, FiguresOfAKnownList) {
  const Statistics statistics = statisticsOf({3.0, 1.0, 2.0, 10.0});
  EXPECT_DOUBLE_EQ(statistics.rmse, std::sqrt(114.0 / 4.0));
  EXPECT_DOUBLE_EQ(statistics.mean, 4.0);
  EXPECT_DOUBLE_EQ(statistics.median, 2.5);
  EXPECT_DOUBLE_EQ(statistics.max, 10.0);
}

TEST(StatisticsTest, EmptyListIsZero) {
  EXPECT_EQ(statisticsOf({}).rmse, 0.0);
  EXPECT_EQ(quantile({}, 0.5), 0.0);
}

TEST(StatisticsTest, QuantileInterpolates) {
  EXPECT_DOUBLE_EQ(quantile({4.0, 1.0, 2.0, 3.0, 5.0}, 0.5), 3.0);
  EXPECT_DOUBLE_EQ(quantile({1.0, 2.0, 3.0, 4.0, 5.0}, 0.95), 4.8);
  EXPECT_DOUBLE_EQ(quantile({1.0, 2.0}, 0.0), 1.0);
  EXPECT_DOUBLE_EQ(quantile({1.0, 2.0}, 1.0), 2.0);
  EXPECT_DOUBLE_EQ(quantile({7.0}, 0.3), 7.0);
}

}  // namespace
}  // namespace mivo
