// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mivo/TrackingStatus.h>

#include "mivo/core/tracking_result.h"

namespace mivo {

/// What there is to say of a frame beside the tracker's result: the part of TrackingStatus that the
/// node knows, in its units.
struct FrameAccount {
  std_msgs::Header header;  ///< of the colour image
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
