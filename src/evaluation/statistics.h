// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

namespace mivo {

/// Summary of non-negative errors.
struct Statistics {
  double rmse = 0.0;
  double mean = 0.0;
  double median = 0.0;
  double max = 0.0;
};

/// All zero for an empty list.
Statistics statisticsOf(const std::vector<double>& errors);

/// The value below which a fraction `q` (0..1) of the values lies, interpolated between neighbors;
/// 0 for an empty list.
double quantile(std::vector<double> values, double q);

}  // namespace mivo
