// SPDX-License-Identifier: BSD-3-Clause
#include "programs/tracking_summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <ostream>

#include "evaluation/statistics.h"
#include "mivo/core/error.h"

namespace mivo {
namespace {

/// The reason that most frames have.
CountByReason::value_type mostFrequent(const TrackingSummary& summary) {
  CountByReason reasons = summary.skipped;
  for (const auto& [reason, count] : summary.not_measured) reasons[reason] += count;
  if (reasons.empty()) return {"there was no frame", 0};
  return *std::max_element(reasons.begin(), reasons.end(),
                           [](const auto& a, const auto& b) { return a.second < b.second; });
}

}  // namespace

void TrackingSummary::add(const Frame& frame, const TrackingResult& result, double frame_cpu_ms) {
  ++frames;
  switch (result.state) {
    case TrackingState::kInitializing:
      ++initializing;
      break;
    case TrackingState::kTracking:
      ++tracked;
      break;
    case TrackingState::kDegraded:
      ++degraded;
      break;
    case TrackingState::kLost:
      ++lost;
      break;
  }
  if (!result.isMeasured()) {
    ++not_measured[describeReason(result)];
  } else if (result.keyframe > 0) {
    ++motions;
  }
  keyframes = result.keyframes;
  segments = result.segment + 1;
  rolling_shutter_readout = result.rolling_shutter_readout;
  depth_time_offset = result.depth_time_offset;
  cpu_ms.push_back(frame_cpu_ms);
  depth.add(frame);
}

bool TrackingSummary::addSkipped(const std::string& reason) {
  ++skipped_frames;
  return ++skipped[reason] == 1;
}

void print(std::ostream& stream, const TrackingSummary& summary) {
  stream << "frames: " << summary.frames << "\n"
         << "initializing: " << summary.initializing << "\n"
         << "tracked: " << summary.tracked << "\n"
         << "degraded: " << summary.degraded << "\n"
         << "lost: " << summary.lost << "\n"
         << "skipped_frames: " << summary.skipped_frames << "\n";
  for (const auto& [reason, count] : summary.skipped) {
    stream << "skipped (" << reason << "): " << count << "\n";
  }
  for (const auto& [reason, count] : summary.left_out) {
    stream << "left_out (" << reason << "): " << count << "\n";
  }
  stream << "keyframes: " << summary.keyframes << "\n"
         << "segments: " << summary.segments << "\n"
         << "rolling_shutter_readout_s: " << summary.rolling_shutter_readout << "\n"
         << "depth_time_offset_s: " << summary.depth_time_offset << "\n";
  if (summary.frames > 0) {
    stream << "depth_median_m: " << summary.depth.median() << "\n"
           << "depth_coverage: " << summary.depth.coverage() << "\n";
  }
  if (summary.cpu_ms.empty()) return;
  stream << "cpu_ms_median: " << quantile(summary.cpu_ms, 0.5) << "\n"
         << "cpu_ms_p95: " << quantile(summary.cpu_ms, 0.95) << "\n";
}

void requireTracked(const TrackingSummary& summary, const DepthParameters& parameters,
                    const std::string& depth_unit) {
  const std::size_t all = summary.frames + summary.skipped_frames;
  // Of a single frame nothing but the keyframe can come.
  if (summary.motions > 0 || (all == 1 && summary.keyframes > 0)) return;
  const auto [reason, count] = mostFrequent(summary);
  std::string text = fmt::format("nothing was tracked: {} ({} of {} frames)", reason, count, all);
  const std::string depth =
      summary.depth.findFault(parameters, depth_unit, DepthAccount::Expected::kRoom);
  if (!depth.empty()) {
    text += "; " + depth;
  } else if (summary.frames > 0) {
    text += "; " + summary.depth.describe();
  }
  throw Error(text);
}

}  // namespace mivo
