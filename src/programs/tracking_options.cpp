// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "mivo/core/error.h"
#include "mivo/io/config_file.h"
#include "programs/tracking_run.h"

namespace mivo {
namespace {

namespace po = boost::program_options;

/// A value from the command line: an invalid one is a usage error.
void setFromCommandLine(Parameters& parameters, const std::string& name, const std::string& value) {
  try {
    setParameter(parameters, name, value);
  } catch (const Error& error) {
    throw UsageError(error.what());
  }
}

Disturbance disturbanceOf(const std::vector<double>& norms, long long seed) {
  for (const double norm : norms) {
    if (!std::isfinite(norm) || norm < 0.0) {
      throw UsageError("--disturb takes two nonnegative numbers, METERS and RADIANS");
    }
  }
  if (seed < 0) throw UsageError("--seed must not be negative");
  return Disturbance(norms[0], norms[1], static_cast<std::uint64_t>(seed));
}

}  // namespace

void TrackingCommandLine::declare(CommandLine& line) {
  line.options()("output", po::value(&output_)->value_name("TRAJECTORY"),
                 "output file, lines 'stamp tx ty tz qx qy qz qw' (required)")(
      "method", po::value(&method_)->value_name("ssd|mi|hybrid"), "same as --set method=...")(
      "config", po::value(&config_)->value_name("FILE"), "YAML file with lines 'name: value'")(
      "set", po::value(&settings_)->composing()->value_name("name=value"),
      "set one parameter; can be repeated, overrides all other settings")(
      "start", po::value(&start_)->value_name("N")->default_value(0), "number of the first frame")(
      "count", po::value(&count_)->value_name("N"), "number of frames (default: all)")(
      "threads", po::value(&threads_)->value_name("N"), "same as --set threads=...")(
      "statistics", po::value(&statistics_)->value_name("FILE.csv"), "write one row per frame")(
      "write-lost", po::bool_switch(&write_lost_),
      "also write the guessed poses of lost frames; the file does not mark them")(
      "force", po::bool_switch(&force_), "replace existing files")(
      "reference", po::value(&reference_)->value_name("first"),
      "keep the first frame as the only keyframe and start each alignment at the last pose")(
      "disturb", twoNumbers(&disturbance_)->value_name("METERS RADIANS"),
      "displace the start of each alignment by a random translation and rotation of these "
      "norms")("seed", po::value(&seed_)->value_name("N")->default_value(0), "seed of --disturb");
}

TrackingOptions TrackingCommandLine::options(const CommandLine& line) const {
  TrackingOptions options;
  if (output_.empty()) throw UsageError("--output TRAJECTORY is missing");
  options.output = output_;
  options.statistics = statistics_;
  options.force = force_;
  options.write_lost = write_lost_;
  if (start_ < 0) throw UsageError("--start must not be negative");
  options.range.start = static_cast<std::size_t>(start_);
  if (line.has("count")) {
    if (count_ < 1) throw UsageError("--count must be at least 1");
    options.range.count = static_cast<std::size_t>(count_);
  }
  if (line.has("disturb")) {
    options.disturbance = disturbanceOf(disturbance_, seed_);
  } else if (line.has("seed")) {
    throw UsageError("--seed requires --disturb");
  }

  Parameters& parameters = options.parameters;
  if (line.has("config")) readParameters(config_, parameters);
  if (line.has("method")) setFromCommandLine(parameters, "method", method_);
  if (line.has("threads")) setFromCommandLine(parameters, "threads", threads_);
  if (line.has("reference")) {
    if (reference_ != "first") throw UsageError("--reference must be 'first'");
    setFromCommandLine(parameters, "keyframe_policy", "first");
    setFromCommandLine(parameters, "motion_model", "constant_pose");
  }
  for (const std::string& setting : settings_) {
    const std::size_t equals = setting.find('=');
    if (equals == std::string::npos) {
      throw UsageError("--set " + setting + " is not of the form name=value");
    }
    setFromCommandLine(parameters, setting.substr(0, equals), setting.substr(equals + 1));
  }
  try {
    parameters.validate();
  } catch (const Error& error) {
    throw UsageError(error.what());
  }
  return options;
}

}  // namespace mivo
