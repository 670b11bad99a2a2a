// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <deque>
#include <functional>
#include <utility>

#include "openni2/camera_device.h"

namespace mivo {

/// Pairs colour and depth by their device stamps, whatever the order of arrival. An image goes out
/// as soon as its partner is there, and alone once none can come any more (the other stream is past
/// it, or too many wait). Each stream keeps its order. `Image` is cheap to move, e.g. a pointer.
template <typename Image>
class FramePairer {
 public:
  struct Entry {
    Image image;
    std::uint64_t stamp = 0;  ///< device time, microseconds
  };
  using OnPair = std::function<void(Entry& color, Entry& depth)>;
  using OnSingle = std::function<void(StreamKind kind, Entry& entry)>;

  /// Stamps up to `tolerance` microseconds apart are a pair: less than half a frame period, or
  /// neighbours are taken for partners.
  FramePairer(std::uint64_t tolerance, std::size_t capacity, OnPair on_pair, OnSingle on_single)
      : tolerance_(tolerance),
        capacity_(capacity),
        on_pair_(std::move(on_pair)),
        on_single_(std::move(on_single)) {}

  void add(StreamKind kind, std::uint64_t stamp, Image image) {
    auto& own = waiting_[static_cast<std::size_t>(kind)];
    if (!own.empty() && stamp < own.back().stamp) {
      flush();  // the device's clock went back: what waits belongs to the time before
    }
    own.push_back({std::move(image), stamp});
    match();
    while (own.size() > capacity_) {
      releaseFront(kind);
    }
  }

  /// Gives out alone what waits, colour first.
  void flush() {
    for (StreamKind kind : {StreamKind::kColor, StreamKind::kDepth}) {
      while (!waiting_[static_cast<std::size_t>(kind)].empty()) {
        releaseFront(kind);
      }
    }
  }

 private:
  void match() {
    auto& color = waiting_[static_cast<std::size_t>(StreamKind::kColor)];
    auto& depth = waiting_[static_cast<std::size_t>(StreamKind::kDepth)];
    while (!color.empty() && !depth.empty()) {
      const auto difference = static_cast<std::int64_t>(color.front().stamp) -
                              static_cast<std::int64_t>(depth.front().stamp);
      if (static_cast<std::uint64_t>(std::abs(difference)) <= tolerance_) {
        Entry first = std::move(color.front());
        Entry second = std::move(depth.front());
        color.pop_front();
        depth.pop_front();
        on_pair_(first, second);
      } else {
        releaseFront(difference < 0 ? StreamKind::kColor : StreamKind::kDepth);
      }
    }
  }

  void releaseFront(StreamKind kind) {
    auto& queue = waiting_[static_cast<std::size_t>(kind)];
    Entry entry = std::move(queue.front());
    queue.pop_front();
    on_single_(kind, entry);
  }

  std::uint64_t tolerance_;
  std::size_t capacity_;
  OnPair on_pair_;
  OnSingle on_single_;
  std::array<std::deque<Entry>, kStreamKinds> waiting_;
};

}  // namespace mivo
