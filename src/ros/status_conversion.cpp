// SPDX-License-Identifier: BSD-3-Clause
#include "ros/status_conversion.h"

#include <cstdint>

namespace mivo {
namespace {

// The codes are part of the message's definition: they stay what they are when the core changes.
std::uint8_t code(TrackingState state) {
  switch (state) {
    case TrackingState::kInitializing:
      return TrackingStatus::INITIALIZING;
    case TrackingState::kTracking:
      return TrackingStatus::TRACKING;
    case TrackingState::kDegraded:
      return TrackingStatus::DEGRADED;
    case TrackingState::kLost:
      break;
  }
  return TrackingStatus::LOST;
}

std::uint8_t code(TrackingReason reason) {
  switch (reason) {
    case TrackingReason::kNone:
      return TrackingStatus::REASON_NONE;
    case TrackingReason::kInvalidFrame:
      return TrackingStatus::REASON_INVALID_FRAME;
    case TrackingReason::kStaleStamp:
      return TrackingStatus::REASON_STALE_STAMP;
    case TrackingReason::kTooFewPoints:
      return TrackingStatus::REASON_TOO_FEW_POINTS;
    case TrackingReason::kNoOverlap:
      return TrackingStatus::REASON_NO_OVERLAP;
    case TrackingReason::kOpenDirections:
      return TrackingStatus::REASON_OPEN_DIRECTIONS;
    case TrackingReason::kAmbiguous:
      return TrackingStatus::REASON_AMBIGUOUS;
    case TrackingReason::kImplausibleMotion:
      return TrackingStatus::REASON_IMPLAUSIBLE_MOTION;
    case TrackingReason::kNothingInCommon:
      return TrackingStatus::REASON_NOTHING_IN_COMMON;
    case TrackingReason::kNotFinite:
      break;
  }
  return TrackingStatus::REASON_NOT_FINITE;
}

LevelStatus toMessage(const LevelRecord& record) {
  LevelStatus message;
  message.level = record.level;
  message.points = record.points;
  message.visible = record.visible;
  message.iterations = record.iterations;
  message.evaluations = record.evaluations;
  message.mutual_information = record.mutual_information;
  message.cost = record.cost;
  message.cpu_ms = record.milliseconds;
  message.line_search_cpu_ms = record.line_search_milliseconds;
  return message;
}

}  // namespace

TrackingStatus toMessage(const TrackingResult& result, const FrameAccount& account) {
  TrackingStatus message;
  message.header = account.header;
  message.state = code(result.state);
  message.state_text = toString(result.state);
  message.reason = code(result.reason);
  message.reason_text = describeReason(result);
  for (std::size_t i = 0; i < message.open_directions.size(); ++i) {
    message.open_directions[i] = result.open_directions[i] ? 1 : 0;
  }
  message.keyframe = result.keyframe;
  message.new_keyframe = result.new_keyframe;
  message.keyframes = result.keyframes;
  message.segment = result.segment;
  message.frames = account.frames;
  message.skipped_frames = account.skipped_frames;
  message.dropped_frames = account.dropped_frames;
  message.points = result.points;
  message.overlap = result.overlap;
  message.mutual_information = result.mutual_information;
  message.residual_scale = result.residual_scale;
  message.rolling_shutter_readout = result.rolling_shutter_readout;
  message.depth_time_offset = result.depth_time_offset;
  for (int i = 0; i < result.num_levels; ++i) {
    message.levels.push_back(toMessage(result.levels[static_cast<std::size_t>(i)]));
  }
  message.conversion_cpu_ms = account.conversion_cpu_ms;
  message.pyramid_cpu_ms = result.milliseconds.pyramid;
  message.tracking_cpu_ms = result.milliseconds.tracking;
  message.keyframe_cpu_ms = result.milliseconds.keyframe;
  message.total_cpu_ms = result.milliseconds.total;
  message.pairing_offset = account.pairing_offset;
  message.latency = account.latency;
  message.processing_latency = account.processing_latency;
  return message;
}

}  // namespace mivo
