// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mivo/TrackingStatus.h>

#include <cstdint>

#include "mivo/core/tracking_result.h"

namespace mivo {

/// The part of TrackingStatus that is known by the node, not by the tracker.
struct FrameAccount {
  std_msgs::Header header;  ///< of the color image
  std::uint64_t frames = 0;
  std::uint64_t skipped_frames = 0;
  std::uint64_t dropped_frames = 0;
  double conversion_cpu_ms = 0.0;
  double pairing_offset = 0.0;
  double latency = 0.0;
  double processing_latency = 0.0;
};

TrackingStatus toMessage(const TrackingResult& result, const FrameAccount& account);

}  // namespace mivo
