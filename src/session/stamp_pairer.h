// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <deque>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

#include "session/pair_decision.h"
#include "session/stamp_gap.h"

namespace mivo {

/// Largest difference (s) of the stamps of a color image and its depth, where no parameter says
/// otherwise.
constexpr double kMaxPairDifference = 0.02;

/// The two streams of an RGB-D camera.
enum class ImageStream { kColor, kDepth };

/// How images are paired.
struct PairingOptions {
  double max_difference = kMaxPairDifference;  ///< s, of the stamps of a pair, at most
  std::size_t capacity =
      100;                 ///< images of a stream that wait; the oldest goes when there are more
  double time_jump = 1.0;  ///< s; a stamp older than the last by more: time was set back
  /// s; no image of a stream is expected sooner than this after the last one.
  double min_gap = 0.0;
  /// The same from what has been seen: nine tenths of the smallest gap. Then a pair need not wait a
  /// whole period for the image after it; an image that comes sooner all the same may find the one
  /// that it would have fitted better taken.
  bool learns_gap = false;
};

/// Pairs color and depth by their stamps, image by image: the rule of every input of mivo. Pairs
/// are those of decidePairs(); one goes out as soon as no image to come can fit better, in the
/// order of the stamps, and an image without partner as soon as none can come. Images may come in
/// any order; within a stream late ones are taken where they belong, as long as that is open.
template <typename Item>
class StampPairer {
 public:
  using OnPair = std::function<void(Item& color, Item& depth)>;
  using OnSingle = std::function<void(ImageStream stream, Item& item)>;

  StampPairer(const PairingOptions& options, OnPair on_pair, OnSingle on_single)
      : options_(options), on_pair_(std::move(on_pair)), on_single_(std::move(on_single)) {}

  /// @param stamp  s
  void push(ImageStream stream, double stamp, Item item) {
    Queue& queue = queueOf(stream);
    if (stamp < queue.last) goBack(stamp, queue.last - stamp > options_.time_jump);
    queue.last = stamp;
    queue.gap.add(stamp);
    queue.next = stamp + leastGap(queue);
    const auto later = std::upper_bound(
        queue.waiting.begin(), queue.waiting.end(), stamp,
        [](double value, const Waiting& waiting) { return value < waiting.stamp; });
    queue.waiting.insert(later, {stamp, std::move(item)});
    deliver(fates(false), [] { return true; });
    if (queue.waiting.size() > options_.capacity) {
      deliver(fates(true), [&] { return queue.waiting.size() > options_.capacity; });
    }
  }

  /// Nothing older than this is to come in either stream.
  void advance(double stamp) {
    for (Queue& queue : queues_) queue.next = std::max(queue.next, stamp);
  }

  /// Nothing is to come: everything that waits goes out.
  void flush() {
    deliver(fates(true), [] { return true; });
  }

  std::size_t numWaiting(ImageStream stream) const {
    return queues_[static_cast<std::size_t>(stream)].waiting.size();
  }

 private:
  static constexpr double kInfinity = std::numeric_limits<double>::infinity();
  // Part of the smallest gap within which no further image is expected.
  static constexpr double kSurePart = 0.9;

  struct Waiting {
    double stamp;
    Item item;
  };

  struct Queue {
    std::deque<Waiting> waiting;  // by stamp
    double last = -kInfinity;     // stamp of the last image that came
    double next = -kInfinity;     // no image is expected to be older
    StampGap gap;
  };

  Queue& queueOf(ImageStream stream) { return queues_[static_cast<std::size_t>(stream)]; }

  /// An image is older than the one before: others may be, too. After a jump of time what waits
  /// belongs to the time before.
  void goBack(double stamp, bool is_jump) {
    if (is_jump) flush();
    for (Queue& queue : queues_) {
      queue.next = std::min(queue.next, stamp);
      if (is_jump) queue.last = std::min(queue.last, stamp);
    }
  }

  double leastGap(const Queue& queue) const {
    const double learned = options_.learns_gap ? kSurePart * queue.gap.smallest() : 0.0;
    return std::max(options_.min_gap, learned);
  }

  WaitingStamps waitingStamps(const Queue& queue, bool is_end) const {
    WaitingStamps stamps;
    for (const Waiting& waiting : queue.waiting) stamps.stamps.push_back(waiting.stamp);
    stamps.next = is_end ? kInfinity : queue.next;
    return stamps;
  }

  PairFates fates(bool is_end) const {
    return decidePairs(waitingStamps(queues_[0], is_end), waitingStamps(queues_[1], is_end),
                       options_.max_difference);
  }

  /// Gives out from the front what is certain, while the condition holds.
  template <typename Condition>
  void deliver(const PairFates& fates, const Condition& goes_on) {
    const auto is = [](const std::vector<PairFate>& list, std::size_t i, PairFate::Kind kind) {
      return i < list.size() && list[i].kind == kind;
    };
    for (std::size_t i = 0, j = 0; goes_on();) {
      if (is(fates.first, i, PairFate::Kind::kSingle)) {
        ++i;
        giveSingle(ImageStream::kColor);
      } else if (is(fates.second, j, PairFate::Kind::kSingle)) {
        ++j;
        giveSingle(ImageStream::kDepth);
      } else if (is(fates.first, i, PairFate::Kind::kPaired) && fates.first[i].partner == j) {
        ++i;
        ++j;
        Item color = takeFront(ImageStream::kColor);
        Item depth = takeFront(ImageStream::kDepth);
        on_pair_(color, depth);
      } else {
        return;
      }
    }
  }

  void giveSingle(ImageStream stream) {
    Item item = takeFront(stream);
    on_single_(stream, item);
  }

  Item takeFront(ImageStream stream) {
    Queue& queue = queueOf(stream);
    Item item = std::move(queue.waiting.front().item);
    queue.waiting.pop_front();
    return item;
  }

  PairingOptions options_;
  OnPair on_pair_;
  OnSingle on_single_;
  std::array<Queue, 2> queues_;
};

/// The same for two whole lists of stamps (s), each in order: pairs of numbers of color and depth.
std::vector<std::pair<std::size_t, std::size_t>> pairByStamp(
    const std::vector<double>& color, const std::vector<double>& depth,
    double max_difference = kMaxPairDifference);

}  // namespace mivo
