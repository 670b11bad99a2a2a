// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "evaluation/stamps.h"

namespace mivo {

/// The true trajectory of a file, asked at stamps.
class TruePoses {
 public:
  /// A pose counts for stamps up to `tolerance` (s) away.
  TruePoses(const std::string& path, double tolerance);

  /// Throws Error when there is none.
  const Eigen::Isometry3d& at(double stamp) const;

 private:
  std::string path_;
  double tolerance_;
  Trajectory truth_;
  std::vector<double> stamps_;
};

}  // namespace mivo
