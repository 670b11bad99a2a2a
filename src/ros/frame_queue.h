// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <mutex>
#include <optional>
#include <utility>

namespace mivo {

/// Capacity where no frame may be dropped, in frames and in bytes: the first is enough for a
/// minute's delay at half the rate of an Xtion, the second is what so many of its frames take.
constexpr std::size_t kMaxBacklog = 1000;
constexpr std::size_t kMaxBacklogBytes = 1'600'000'000;

/// Frames between the thread that receives them and the one that tracks them.
template <typename Item>
class FrameQueue {
 public:
  enum class Policy {
    kNewest,  ///< a newer frame replaces a waiting one
    kAll      ///< all frames wait; beyond the capacity the oldest are dropped
  };

  explicit FrameQueue(Policy policy, std::size_t capacity = kMaxBacklog,
                      std::size_t max_bytes = kMaxBacklogBytes)
      : policy_(policy),
        capacity_(policy == Policy::kNewest ? 1 : capacity),
        max_bytes_(max_bytes) {}

  /// Does nothing once the queue is closed.
  /// @param bytes  that the item keeps in memory; the newest one is kept however large
  void push(Item item, std::size_t bytes = 0) {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      if (closed_) return;
      items_.push_back({std::move(item), bytes});
      bytes_ += bytes;
      while (items_.size() > capacity_ || (bytes_ > max_bytes_ && items_.size() > 1)) {
        takeFront();
        ++dropped_;
      }
    }
    changed_.notify_one();
  }

  /// Waits for the oldest frame; empty once the queue is closed and, with kAll, all frames were
  /// taken.
  std::optional<Item> pop() {
    std::unique_lock<std::mutex> lock(mutex_);
    changed_.wait(lock, [this] { return closed_ || !items_.empty(); });
    if (items_.empty()) return std::nullopt;
    return takeFront();
  }

  /// Wakes the consumer. With kAll it still receives waiting frames, with kNewest none.
  void close() {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      closed_ = true;
      if (policy_ == Policy::kNewest) discard();
    }
    changed_.notify_all();
  }

  /// Discards waiting frames and returns their number.
  std::size_t clear() {
    const std::lock_guard<std::mutex> lock(mutex_);
    const std::size_t count = items_.size();
    discard();
    return count;
  }

  std::size_t size() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return items_.size();
  }

  /// Number of frames dropped for newer ones.
  std::uint64_t dropped() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return dropped_;
  }

 private:
  struct Waiting {
    Item item;
    std::size_t bytes;
  };

  Item takeFront() {
    Waiting front = std::move(items_.front());
    items_.pop_front();
    bytes_ -= front.bytes;
    return std::move(front.item);
  }

  void discard() {
    items_.clear();
    bytes_ = 0;
  }

  const Policy policy_;
  const std::size_t capacity_;
  const std::size_t max_bytes_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Waiting> items_;
  std::size_t bytes_ = 0;  // of them
  std::uint64_t dropped_ = 0;
  bool closed_ = false;
};

}  // namespace mivo
