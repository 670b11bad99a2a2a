// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "image_pair.h"
#include "mivo/core/parameters.h"
#include "mivo/io/output_file.h"
#include "parameter_options.h"
#include "programs/command_line.h"
#include "programs/progress_bar.h"

namespace mivo {

/// What experiments on pairs of frames have in common: a series of random starts for each
/// magnitude, the same ones for every method, and one file of results.
class PairExperiment {
 public:
  explicit PairExperiment(long long trials) : trials_(trials) {}

  /// Adds argument and options; `rows` tells what the output file consists of. The object must live
  /// until after CommandLine::parse.
  void declare(CommandLine& line, const std::string& rows);

  /// Adds `--live`: live frames from another folder.
  void declareLive(CommandLine& line);

  /// To be called after CommandLine::parse. Throws UsageError.
  void validate();

  Parameters parameters() const { return parameter_options_.parameters(); }
  ImagePairs loadPairs(const Parameters& parameters) const;
  OutputFile openOutput() const;

  const std::vector<double>& magnitudes() const { return magnitudes_; }  ///< of each series
  std::size_t trials() const { return static_cast<std::size_t>(trials_); }
  ProgressBar progressBar() const { return ProgressBar(magnitudes_.size() * trials()); }

  /// Visits each trial of a series with the pose T_live_ref to start from.
  using Visit = std::function<void(const ImagePair& pair, const Eigen::Isometry3d& start)>;
  void run(const ImagePairs& images, std::size_t series, ProgressBar& progress,
           const Visit& visit) const;

 private:
  PairOptions pairs_;
  std::vector<double> magnitudes_;
  long long trials_;
  long long seed_ = 1;
  std::string output_;
  bool force_ = false;
  ParameterOptions parameter_options_;
};

}  // namespace mivo
