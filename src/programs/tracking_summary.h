// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <iosfwd>
#include <map>
#include <string>
#include <vector>

#include "io/depth_account.h"
#include "mivo/core/frame.h"
#include "mivo/core/parameters.h"
#include "mivo/core/tracking_result.h"

namespace mivo {

/// Numbers of frames by reason.
using CountByReason = std::map<std::string, std::size_t>;

/// Totals over a run.
struct TrackingSummary {
  std::size_t frames = 0;  ///< processed by the tracker, without skipped ones
  std::size_t initializing = 0;
  std::size_t tracked = 0;
  std::size_t degraded = 0;
  std::size_t lost = 0;
  std::size_t skipped_frames = 0;  ///< that could not be read, or were refused
  CountByReason skipped;           ///< the same by reason
  CountByReason left_out;          ///< images that became no frame, by reason
  CountByReason not_measured;      ///< of `frames`: initializing and lost ones by reason
  std::size_t motions = 0;         ///< frames measured against a keyframe
  int keyframes = 0;
  int segments = 0;
  double rolling_shutter_readout = 0.0;  ///< s, at the end; 0: global shutter
  double depth_time_offset = 0.0;        ///< s, at the end: given or estimated
  std::vector<double> cpu_ms;  ///< of each frame, all threads, from decoded images to the pose
  DepthAccount depth;

  /// Counts a processed frame.
  void add(const Frame& frame, const TrackingResult& result, double cpu_ms);

  /// Counts a skipped frame. Returns whether it is the first with this reason.
  bool addSkipped(const std::string& reason);
};

/// Lines `name: value`.
void print(std::ostream& stream, const TrackingSummary& summary);

/// Throws Error when no motion was measured although there was more than one frame, or when not
/// even a keyframe could be made: says why and what depth there was.
/// @param depth_unit  where the unit of depth comes from, FrameSource::depthUnit()
void requireTracked(const TrackingSummary& summary, const DepthParameters& parameters,
                    const std::string& depth_unit);

}  // namespace mivo
