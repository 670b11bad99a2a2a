// SPDX-License-Identifier: BSD-3-Clause
#include "ros/frame_queue.h"

#include <gtest/gtest.h>

#include <future>

namespace mivo {
namespace {

using Queue = FrameQueue<int>;

TEST(FrameQueueTest, AllFramesWaitInTheirOrder) {
  Queue queue(Queue::Policy::kAll);
  for (int i = 0; i < 100; ++i) queue.push(i);
  queue.close();
  queue.push(100);  // too late
  for (int i = 0; i < 100; ++i) EXPECT_EQ(i, *queue.pop());
  EXPECT_FALSE(queue.pop());
  EXPECT_EQ(0U, queue.dropped());
}

TEST(FrameQueueTest, NoMoreThanTheCapacityWait) {
  Queue queue(Queue::Policy::kAll, 3);
  for (int i = 0; i < 5; ++i) queue.push(i);
  EXPECT_EQ(3U, queue.size());
  EXPECT_EQ(2U, queue.dropped());
  queue.close();
  for (int i = 2; i < 5; ++i) EXPECT_EQ(i, *queue.pop());
  EXPECT_FALSE(queue.pop());
}

TEST(FrameQueueTest, NoMoreThanTheBytesWait) {
  Queue queue(Queue::Policy::kAll, 10, 100);
  for (int i = 0; i < 4; ++i) queue.push(i, 40);  // two of them fit
  EXPECT_EQ(2U, queue.size());
  EXPECT_EQ(2U, queue.dropped());
  EXPECT_EQ(2, *queue.pop());
  queue.push(4, 60);  // beside the one of 40
  EXPECT_EQ(2U, queue.size());
  queue.push(5, 1000);  // alone too large, but the newest
  EXPECT_EQ(1U, queue.size());
  EXPECT_EQ(4U, queue.dropped());
  EXPECT_EQ(5, *queue.pop());
  queue.push(6, 100);
  EXPECT_EQ(1U, queue.clear());
  queue.push(7, 100);
  EXPECT_EQ(7, *queue.pop());
  EXPECT_EQ(4U, queue.dropped());
}

TEST(FrameQueueTest, TheNewestFrameWins) {
  Queue queue(Queue::Policy::kNewest);
  for (int i = 0; i < 5; ++i) queue.push(i);
  EXPECT_EQ(4, *queue.pop());
  EXPECT_EQ(4U, queue.dropped());
  queue.push(5);
  queue.close();
  EXPECT_FALSE(queue.pop());
}

TEST(FrameQueueTest, ClosingWakesTheConsumer) {
  Queue queue(Queue::Policy::kAll);
  std::future<bool> got = std::async(std::launch::async, [&] { return queue.pop().has_value(); });
  queue.close();
  EXPECT_FALSE(got.get());
}

TEST(FrameQueueTest, PushingWakesTheConsumer) {
  Queue queue(Queue::Policy::kNewest);
  std::future<int> got = std::async(std::launch::async, [&] { return *queue.pop(); });
  queue.push(7);
  EXPECT_EQ(7, got.get());
}

TEST(FrameQueueTest, ClearSaysHowManyWaited) {
  Queue queue(Queue::Policy::kAll);
  queue.push(1);
  queue.push(2);
  EXPECT_EQ(2U, queue.clear());
  EXPECT_EQ(0U, queue.size());
}

}  // namespace
}  // namespace mivo
