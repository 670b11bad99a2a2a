// SPDX-License-Identifier: BSD-3-Clause
#include "ros/guarded_call.h"

#include <gtest/gtest.h>

#include <new>
#include <thread>

#include "mivo/core/error.h"

namespace mivo {
namespace {

TEST(GuardedCallTest, NothingThrownEndsTheThread) {
  int calls = 0;
  std::thread([&] {
    guardedCall("the test", [&] {
      ++calls;
      throw Error("bad input");
    });
    guardedCall("the test", [&] {
      ++calls;
      throw std::bad_alloc();
    });
    guardedCall("the test", [&] { ++calls; });
  }).join();
  EXPECT_EQ(3, calls);
}

}  // namespace
}  // namespace mivo
