// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <limits>

namespace mivo {

/// A part of a sequence: `count` frames from number `start` on (the first frame is number 0). Given
/// to a source when it is opened, so that the frames before are never decoded.
struct FrameRange {
  std::size_t start = 0;
  std::size_t count = std::numeric_limits<std::size_t>::max();
};

}  // namespace mivo
