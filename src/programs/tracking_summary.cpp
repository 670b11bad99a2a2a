// SPDX-License-Identifier: BSD-3-Clause
#include "programs/tracking_summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <ostream>

#include "evaluation/statistics.h"
#include "mivo/core/error.h"
#include "session/depth_sample.h"

namespace mivo {
namespace {

// m; the median depth of what is filmed indoors lies between, as far as the sensors reach.
constexpr double kNearRoom = 0.6;
constexpr double kFarRoom = 6.0;
const char* const kMultiplesOf8 =
    "its values are multiples of 8, as if their bits were rotated by three to the left (SUN "
    "RGB-D): "
    "8 times as many units per meter read them, or undo it";

/// The reason that most frames have.
CountByReason::value_type mostFrequent(const TrackingSummary& summary) {
  CountByReason reasons = summary.skipped;
  for (const auto& [reason, count] : summary.not_measured) reasons[reason] += count;
  if (reasons.empty()) return {"there was no frame", 0};
  return *std::max_element(reasons.begin(), reasons.end(),
                           [](const auto& a, const auto& b) { return a.second < b.second; });
}

double medianOf(const std::vector<double>& values) {
  return values.empty() ? 0.0 : quantile(values, 0.5);
}

double coverageOf(const TrackingSummary& summary) {
  return summary.depth_coverage / static_cast<double>(summary.frames);
}

std::string describeDepth(const TrackingSummary& summary) {
  return fmt::format("median depth seen {:.4g} m, {:.0f} % of the pixels",
                     medianOf(summary.depth_medians), 100.0 * coverageOf(summary));
}

/// What the bits of a depth image say, and what to do; of a coarse one, too.
std::string describe(const DepthStorage& storage) {
  if (storage.is_rotated_right) {
    return "neighboring values jump, unless their 16 bits are rotated by three to the left: undo "
           "what has rotated them to the right";
  }
  if (storage.coarse_step > 0.0) {
    return fmt::format("it comes in steps of {:.1g} m: was it stored in 8 bits, or fewer?",
                       storage.coarse_step);
  }
  return storage.is_multiple_of_8 ? kMultiplesOf8 : "";
}

/// The storage that most frames have, or an empty text.
std::string usualStorage(const TrackingSummary& summary) {
  for (const auto& [storage, count] : summary.depth_storage) {
    if (2 * count > summary.frames) return storage;
  }
  return {};
}

/// A usual unit with which the median would be one of a room.
std::string otherUnit(double median, double unit) {
  if (unit == 0.0) unit = 1.0;
  for (const double units_per_meter : {1000.0, 5000.0, 10000.0, 256.0}) {
    const double other = median / unit / units_per_meter;
    if (other < kNearRoom || other > kFarRoom) continue;
    return fmt::format(" With {} units per meter it would be {:.4g} m", units_per_meter, other);
  }
  return {};
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
  const DepthSample depth = sampleDepth(frame);
  depth_coverage += depth.coverage;
  if (depth.coverage > 0.0) depth_medians.push_back(depth.median);
  depth_unit = frame.depth.type() == CV_16UC1 ? frame.depth_unit : 0.0;
  const std::string storage = describe(examineDepthStorage(frame));
  if (!storage.empty()) ++depth_storage[storage];
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
    stream << "depth_median_m: " << medianOf(summary.depth_medians) << "\n"
           << "depth_coverage: " << coverageOf(summary) << "\n";
  }
  if (summary.cpu_ms.empty()) return;
  stream << "cpu_ms_median: " << quantile(summary.cpu_ms, 0.5) << "\n"
         << "cpu_ms_p95: " << quantile(summary.cpu_ms, 0.95) << "\n";
}

std::string findDepthFault(const TrackingSummary& summary, const DepthParameters& parameters,
                           const std::string& depth_unit) {
  if (summary.frames == 0) return {};
  if (summary.depth_medians.empty()) return "the depth images have no reading at all";
  const double median = medianOf(summary.depth_medians);
  const std::string storage = usualStorage(summary);
  const bool is_out = median < parameters.min_depth || median > parameters.max_depth;
  const bool is_unlikely = median < kNearRoom || median > kFarRoom;
  const bool is_rotated = storage == kMultiplesOf8;
  if (!is_out && !is_unlikely && (storage.empty() || is_rotated)) return {};

  std::string text = describeDepth(summary);
  if (is_out) {
    text += fmt::format(", outside of {} to {} m", parameters.min_depth, parameters.max_depth);
  }
  if (!storage.empty()) return text + ": " + storage;
  return text + fmt::format(": is the depth unit wrong ({})?", depth_unit) +
         otherUnit(median, summary.depth_unit);
}

void requireTracked(const TrackingSummary& summary, const DepthParameters& parameters,
                    const std::string& depth_unit) {
  const std::size_t all = summary.frames + summary.skipped_frames;
  // Of a single frame nothing but the keyframe can come.
  if (summary.motions > 0 || (all == 1 && summary.keyframes > 0)) return;
  const auto [reason, count] = mostFrequent(summary);
  std::string text = fmt::format("nothing was tracked: {} ({} of {} frames)", reason, count, all);
  const std::string depth = findDepthFault(summary, parameters, depth_unit);
  if (!depth.empty()) {
    text += "; " + depth;
  } else if (summary.frames > 0) {
    text += "; " + describeDepth(summary);
  }
  throw Error(text);
}

}  // namespace mivo
