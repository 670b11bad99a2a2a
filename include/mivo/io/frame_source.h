// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>

#include "mivo/core/camera.h"
#include "mivo/core/frame.h"

namespace mivo {

/// Where frames come from: a folder, a bag. Programs know this interface only.
class FrameSource {
 public:
  virtual ~FrameSource() = default;

  virtual const Camera& camera() const = 0;

  /// Number of frames, skipped ones included, for progress bars.
  virtual std::size_t size() const = 0;

  enum class Status { kFrame, kSkipped, kEnd };

  /// Reads the next frame. kSkipped: this frame is broken, `fault` says what and where; reading
  /// goes on with the next call. Throws Error only when nothing further can be read.
  virtual Status next(Frame& frame, std::string& fault) = 0;
};

}  // namespace mivo
