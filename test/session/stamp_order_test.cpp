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

}  // namespace
}  // namespace mivo
