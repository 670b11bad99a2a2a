// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <map>
#include <string>

#include "mivo/core/camera.h"
#include "mivo/core/frame.h"

namespace mivo {

/// Why a frame was skipped.
struct FrameFault {
  std::string text;    ///< what and where, one line
  std::string reason;  ///< the fault only, the same for all frames that have it
};

/// A source of frames: a folder or a bag.
class FrameSource {
 public:
  virtual ~FrameSource() = default;

  /// Camera of the frame that was read last, of the first one before that.
  virtual const Camera& camera() const = 0;

  /// Number of frames, skipped ones included, for progress bars.
  virtual std::size_t size() const = 0;

  /// The origin of the depth unit, in a few words.
  virtual std::string depthUnit() const = 0;

  /// One line about what was assumed or corrected in the input; empty if nothing was.
  virtual const std::string& notice() const = 0;

  enum class Status { kFrame, kSkipped, kEnd };

  /// Reads the next frame. kSkipped: this frame is unusable, see `fault`; the next call continues.
  /// Throws Error only when no further frame can be read.
  virtual Status next(Frame& frame, FrameFault& fault) = 0;

  /// Whether time was set back before the frame that was read last: its stamp cannot be compared
  /// with those before.
  virtual bool startsAnew() const { return false; }

  /// How many images became no frame at all, by the reason: without a partner, of no time.
  virtual const std::map<std::string, std::size_t>& leftOut() const {
    static const std::map<std::string, std::size_t> none;
    return none;
  }
};

}  // namespace mivo
