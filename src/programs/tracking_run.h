// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <iosfwd>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "mivo/core/parameters.h"
#include "mivo/io/frame_range.h"
#include "mivo/io/frame_source.h"
#include "programs/command_line.h"
#include "programs/disturbance.h"
#include "session/depth_sample.h"

// What run_sequence and run_bag have in common: everything but where the frames come from.

namespace mivo {

/// What to do with the frames of a source.
struct TrackingOptions {
  std::string output;       ///< trajectory file
  std::string statistics;   ///< CSV file; empty: none
  bool force = false;       ///< existing files may be overwritten
  bool write_lost = false;  ///< the trajectory has the guesses of lost frames, too
  Parameters parameters;
  FrameRange range;  ///< for the source: trackFrames takes all that the source delivers
  std::optional<Disturbance> disturbance;
};

/// Options shared by the programs that track: declare them, parse, then ask for the values.
class TrackingCommandLine {
 public:
  /// Adds the options. The object must live until after CommandLine::parse.
  void declare(CommandLine& line);

  /// The values. Precedence: defaults, --config, --method, --threads and --reference, --set. Throws
  /// UsageError for a value that makes no sense, Error for a configuration file that cannot be
  /// used.
  TrackingOptions options(const CommandLine& line) const;

 private:
  std::string output_;
  std::string statistics_;
  std::string config_;
  std::string method_;
  std::string reference_;
  std::vector<std::string> settings_;
  std::vector<double> disturbance_;
  long long start_ = 0;
  long long count_ = 0;
  std::string threads_;
  long long seed_ = 0;
  bool force_ = false;
  bool write_lost_ = false;
};

/// Totals over a run.
struct TrackingSummary {
  std::size_t frames = 0;  ///< looked at; skipped and refused ones are not among them
  std::size_t initialising = 0;
  std::size_t tracked = 0;
  std::size_t degraded = 0;
  std::size_t lost = 0;
  std::size_t skipped_frames = 0;  ///< broken ones, for which the source could give no image
  std::map<std::string, std::size_t> refused_frames;  ///< by the tracker, see isRefused()
  int keyframes = 0;
  int segments = 0;
  double rolling_shutter_readout = 0.0;  ///< s, at the end; 0: global shutter
  double depth_time_offset = 0.0;        ///< s, at the end: given or estimated
  double cpu_ms_median = 0.0;  ///< of the process, all threads, from decoded images to the pose
  double cpu_ms_p95 = 0.0;
  std::string initialising_reason;  ///< why the last of them could not be tracked
  DepthSample initialising_depth;   ///< of it

  std::size_t numRefused() const;
};

/// Tracks all frames of the source and writes trajectory and statistics line by line: what has been
/// computed is on disk whatever happens later. The trajectory has the poses that were measured, the
/// statistics have a row for each frame. Skipped frames are told on stderr, those that the tracker
/// refused once for each reason. Throws Error when a file exists (without `force`) or cannot be
/// written, when the source fails, or when it did not deliver a single frame.
TrackingSummary trackFrames(FrameSource& source, const TrackingOptions& options);

/// Lines `name: value`.
void print(std::ostream& stream, const TrackingSummary& summary);

/// Throws Error with the reason and the depth that was seen when no frame was tracked: the first
/// one, which is the origin by definition, does not count when all others were refused.
void requireTracked(const TrackingSummary& summary);

}  // namespace mivo
