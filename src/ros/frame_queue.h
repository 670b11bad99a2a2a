// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <mutex>
#include <optional>
#include <utility>

namespace mivo {

/// Capacity where no frame may be dropped: 1.5 GB of 640 x 480 pixels.
constexpr std::size_t kMaxBacklog = 1000;

/// Frames between the thread that receives them and the one that tracks them.
template <typename Item>
class FrameQueue {
 public:
  enum class Policy {
    kNewest,  ///< a newer frame replaces a waiting one
    kAll      ///< all frames wait; beyond the capacity the oldest are dropped
  };

  explicit FrameQueue(Policy policy, std::size_t capacity = kMaxBacklog)
      : policy_(policy), capacity_(policy == Policy::kNewest ? 1 : capacity) {}

  /// Does nothing once the queue is closed.
  void push(Item item) {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      if (closed_) return;
      items_.push_back(std::move(item));
      if (items_.size() > capacity_) {
        items_.pop_front();
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
    Item item = std::move(items_.front());
    items_.pop_front();
    return item;
  }

  /// Wakes the consumer. With kAll it still receives waiting frames, with kNewest none.
  void close() {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      closed_ = true;
      if (policy_ == Policy::kNewest) items_.clear();
    }
    changed_.notify_all();
  }

  /// Discards waiting frames and returns their number.
  std::size_t clear() {
    const std::lock_guard<std::mutex> lock(mutex_);
    const std::size_t count = items_.size();
    items_.clear();
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
  const Policy policy_;
  const std::size_t capacity_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Item> items_;
  std::uint64_t dropped_ = 0;
  bool closed_ = false;
};

}  // namespace mivo
