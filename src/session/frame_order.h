// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <utility>

#include "session/stamp_order.h"

namespace mivo {

/// Why a frame has no place in time.
enum class StampFault {
  kLate,    ///< not newer than the frame before it
  kAstray,  ///< far ahead of the frames before and after it
  kUnset    ///< zero, before times of day or among zeros: nobody has set it
};

/// In words, the same for all frames with the fault.
inline const char* describe(StampFault fault) {
  switch (fault) {
    case StampFault::kLate:
      return "stamp is not newer than that of the frame before";
    case StampFault::kAstray:
      return "stamp is far ahead of the frames before and after it";
    case StampFault::kUnset:
      break;
  }
  return "stamp is zero";
}

/// Whose stamps are believed, frame by frame: the rule of every input of mivo. Frames go out in
/// the order in which they came, each newer than the one before.
///  - A frame that is not newer is dropped, until several in a row agree with each other that time
///    was set back (a looped bag, a restarted driver): with the last of them a new time begins.
///  - A frame that is far ahead waits for the next one, which either goes on from there (a pause,
///    or a clock that was set), or shows that its stamp is wrong.
///  - A first frame of stamp zero waits for the next one, too: a recording may begin at zero, but
///    zeros before times of day, or more than one, are stamps that nobody has set.
template <typename Item>
class FrameOrder {
 public:
  /// @param is_new_time  time was set back: nothing before this frame says where it is
  using OnFrame = std::function<void(Item& item, bool is_new_time)>;
  using OnDrop = std::function<void(Item& item, StampFault fault)>;

  FrameOrder(OnFrame on_frame, OnDrop on_drop)
      : on_frame_(std::move(on_frame)), on_drop_(std::move(on_drop)) {}

  /// @param stamp  s
  void push(double stamp, Item item) {
    if (stamp == 0.0 && !last_) {
      takeZero(item);
      return;
    }
    if (zero_) settleZero(stamp > kTimeOfDay);
    if (last_ && stamp <= *last_) {
      takeLate(stamp, item);
      return;
    }
    if (waiting_ && stamp < waiting_->first) {
      on_drop_(waiting_->second, StampFault::kAstray);
      waiting_.reset();
    }
    flush();
    if (last_ && stamp <= *last_) {  // the same as what waited
      takeLate(stamp, item);
      return;
    }
    late_.count = 0;
    if (last_ && stamp > *last_ + kFarAhead) {
      waiting_.emplace(stamp, std::move(item));
      return;
    }
    give(stamp, item, false);
  }

  /// Nothing is to come, or not for a while: what waits goes out.
  void flush() {
    if (zero_) settleZero(false);
    if (!waiting_) return;
    std::pair<double, Item> frame = std::move(*waiting_);
    waiting_.reset();
    give(frame.first, frame.second, false);
  }

  /// Forgets all stamps: what comes next begins a time of its own.
  void restart() {
    waiting_.reset();
    zero_.reset();
    last_.reset();
    late_.count = 0;
  }

 private:
  // s; cameras pause, but a second frame this far ahead is worth waiting for.
  static constexpr double kFarAhead = 10.0;
  // Late frames in a row, each newer than the one before, that together are believed: a sixth of a
  // second of an Xtion is lost to it, and no burst of late messages is as long.
  static constexpr int kAgreeing = 5;
  // s; those that agree are no further apart.
  static constexpr double kTogether = 1.0;

  struct Late {
    int count = 0;
    double last = 0.0;
  };

  void takeZero(Item& item) {
    if (zero_) {
      on_drop_(item, StampFault::kUnset);
      has_more_zeros_ = true;
      return;
    }
    zero_.emplace(std::move(item));
    has_more_zeros_ = false;
  }

  void settleZero(bool is_before_times_of_day) {
    std::optional<Item> frame;
    frame.swap(zero_);
    if (is_before_times_of_day || has_more_zeros_) {
      on_drop_(*frame, StampFault::kUnset);
    } else {
      give(0.0, *frame, false);
    }
  }

  void takeLate(double stamp, Item& item) {
    const bool agrees =
        late_.count > 0 && stamp > late_.last && stamp < late_.last + kTogether && stamp < *last_;
    late_.count = agrees ? late_.count + 1 : 1;
    late_.last = stamp;
    if (late_.count < kAgreeing) {
      on_drop_(item, StampFault::kLate);
      return;
    }
    flush();
    late_.count = 0;
    give(stamp, item, true);
  }

  void give(double stamp, Item& item, bool is_new_time) {
    last_ = stamp;
    on_frame_(item, is_new_time);
  }

  OnFrame on_frame_;
  OnDrop on_drop_;
  std::optional<double> last_;  // stamp of the last frame that went out
  std::optional<std::pair<double, Item>> waiting_;
  std::optional<Item>
      zero_;  // the first frame, while its stamp of zero may be one that nobody has set
  bool has_more_zeros_ = false;
  Late late_;
};

}  // namespace mivo
