// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mivo/core/parameters.h"
#include "mivo/io/frame_range.h"
#include "mivo/io/frame_source.h"
#include "programs/command_line.h"
#include "programs/disturbance.h"
#include "programs/output_paths.h"
#include "programs/tracking_summary.h"

// Common part of run_sequence and run_bag: everything except the source of frames.

namespace mivo {

/// What to do with the frames of a source.
struct TrackingOptions {
  std::string output;             ///< trajectory file
  std::string statistics;         ///< CSV file; empty: none
  bool force = false;             ///< existing files may be overwritten
  bool write_lost = false;        ///< the guessed poses of lost frames are written, too
  std::vector<NamedFile> inputs;  ///< must not be written
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

/// Tracks all frames of the source and writes trajectory and statistics line by line: computed
/// results are on disk even if a later step fails. Measured poses are written, and those of lost
/// frames when the options say so. Skipped frames are reported on stderr, once per reason. Both
/// files are looked at before one is opened, see requireOutputs(). Throws UsageError or Error when
/// they cannot be written, Error when the source fails.
TrackingSummary trackFrames(FrameSource& source, const TrackingOptions& options);

/// The body of a program: trackFrames with output on stdout and stderr. Also throws Error when
/// nothing was tracked, see requireTracked().
void runTracking(const std::string& program, FrameSource& source, const TrackingOptions& options);

}  // namespace mivo
