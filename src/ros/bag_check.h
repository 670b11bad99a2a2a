// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "ros/bag_source.h"
#include "ros/image_check.h"

namespace mivo {

/// The stamps of one topic as they were recorded.
struct StreamReport {
  std::string name;  ///< color, depth, calibration
  std::string topic;
  std::size_t messages = 0;
  double rate = 0.0;         ///< per second, by the median period; 0: fewer than two
  double longest_gap = 0.0;  ///< s
  std::size_t gaps = 0;      ///< longer than two and a half periods
  std::size_t late = 0;      ///< not newer than the one before
  double age = 0.0;          ///< s, median of recording minus stamp
};

/// What is to be known of a recording before a tracker is blamed.
struct BagReport {
  std::string layout;
  std::vector<StreamReport> streams;
  std::size_t pairs = 0;
  std::map<std::string, std::size_t> left_out;
  double pair_offset = 0.0;            ///< s, median, stamp of depth minus that of color
  std::optional<double> clock_offset;  ///< s, see ClockOffset
  Camera camera;
  std::size_t calibrations = 0;  ///< that differ
  std::string notice;            ///< of the source
  std::vector<FrameLook> frames;
  std::map<std::string, std::size_t> unreadable;  ///< frames, by the reason
  std::optional<EdgeOffset::Shift> edge_shift;    ///< pixels
  bool is_mirrored = false;           ///< color fits depth when left and right change places
  std::vector<std::string> warnings;  ///< what is wrong, a line each
};

/// Reads a recording. Throws Error when it cannot be used at all.
BagReport checkBag(const std::vector<std::string>& paths, const RgbdTopics& wanted);

/// Lines "name: value", then "warning: ...".
void print(std::ostream& stream, const BagReport& report);

/// One row per frame, for plots.
std::string toCsv(const BagReport& report);

}  // namespace mivo
