// SPDX-License-Identifier: BSD-3-Clause
#include "session/stamp_order.h"

#include <gtest/gtest.h>

#include "support/error_text.h"

namespace mivo {
namespace {

struct Item {
  double stamp;
  char name;
};

std::string names(const std::vector<Item>& items) {
  std::string text;
  for (const Item& item : items) text += item.name;
  return text;
}

TEST(StampOrderTest, OrderIsKeptAndNothingSaid) {
  std::vector<Item> items = {{1.0, 'a'}, {2.0, 'b'}, {2.5, 'c'}};
  EXPECT_EQ(describe(putInOrder(items), "lines"), "");
  EXPECT_EQ(names(items), "abc");
}

TEST(StampOrderTest, ReversedIsSorted) {
  std::vector<Item> items = {{2.5, 'c'}, {2.0, 'b'}, {1.0, 'a'}};
  EXPECT_EQ(describe(putInOrder(items), "lines"),
            "the lines were not in the order of their stamps and are sorted");
  EXPECT_EQ(names(items), "abc");
}

TEST(StampOrderTest, OfTheSameStampTheFirstStays) {
  std::vector<Item> items = {{2.0, 'b'}, {1.0, 'a'}, {2.0, 'x'}, {2.0, 'y'}};
  const StampOrder order = putInOrder(items);
  EXPECT_FALSE(order.was_sorted);
  EXPECT_EQ(order.doubled, 2U);
  EXPECT_EQ(names(items), "ab");
  EXPECT_EQ(describe(order, "lines"),
            "the lines were not in the order of their stamps and are sorted; 2 of them left out: "
            "others have the same stamps");
}

TEST(StampOrderTest, EqualStampsAreNoTimes) {
  std::vector<Item> items = {{0.0, 'a'}, {0.0, 'b'}};
  EXPECT_EQ(errorText([&] { putInOrder(items); }),
            "all 2 stamps are 0.000000: without times nothing can be tracked");
  items.resize(1);
  EXPECT_EQ(putInOrder(items).doubled, 0U);  // a single image may have any
}

TEST(StampOrderTest, UnitsAreRecognized) {
  const struct {
    std::vector<double> stamps;
    double unit;
  } cases[] = {
      {{}, 1.0},
      {{0.0}, 1.0},
      {{1.0, 2.0, 3.0}, 1.0},  // frame numbers
      {{1305031102.1, 1305031102.2}, 1.0},
      {{0.0, 1305031102.2}, 1.0},
      {{1305031102175.0, 1305031102208.0}, 1e-3},
      {{1305031102175304.0, 1305031102208637.0}, 1e-6},
      {{0.0, 0.0, 1305031102175304064.0, 1305031102208637440.0}, 1e-9},
      {{1600000000.0, 1600000001.0}, 1.0},
      {{1305031102175304064.0}, 1e-9},
      {{0.0, 33333333.0, 66666667.0}, 1e-9},
      {{100000000000.0, 100033333333.0}, 1e-9},    // 100 s after the start
      {{1000000000000.0, 1000033333333.0}, 1e-9},  // 1000 s: in milliseconds a time of today
      {{86400000000.0, 86400033333.0}, 1e-6},      // a day
      {{0.0, 33333.0, 66667.0}, 1e-6},
      {{0.0, 33333.5, 66667.0}, 1.0},  // no whole numbers: seconds, however far apart
  };
  for (const auto& test : cases) {
    EXPECT_EQ(stampUnit(test.stamps), test.unit)
        << (test.stamps.empty() ? 0.0 : test.stamps.back());
  }
}

TEST(StampOrderTest, StampsBecomeSeconds) {
  std::vector<Item> items = {{2e9, 'b'}, {1e9, 'a'}};
  const StampOrder order = putInOrder(items);
  EXPECT_EQ(items[0].stamp, 1.0);
  EXPECT_EQ(items[1].stamp, 2.0);
  EXPECT_EQ(describe(order, "lines"),
            "the stamps of the lines are nanoseconds; the lines were not in the order of their "
            "stamps and are sorted");
}

TEST(StampOrderTest, ZeroAmongTimesOfDayIsLeftOut) {
  std::vector<Item> items = {{0.0, 'x'}, {1.6e9, 'a'}, {0.0, 'y'}, {1.6e9 + 1, 'b'}};
  const StampOrder order = putInOrder(items);
  EXPECT_EQ(order.unset, 2U);
  EXPECT_EQ(names(items), "ab");
  EXPECT_EQ(describe(order, "lines"), "2 of the lines left out: their stamp is zero");
  items = {{0.0, 'a'}, {0.033, 'b'}};  // a clock that began with the recording
  EXPECT_EQ(putInOrder(items).unset, 0U);
}

}  // namespace
}  // namespace mivo
