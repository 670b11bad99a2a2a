// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/statistics.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace mivo {

Statistics statisticsOf(const std::vector<double>& errors) {
  Statistics statistics;
  if (errors.empty()) return statistics;
  double squares = 0.0;
  double sum = 0.0;
  for (const double error : errors) {
    squares += error * error;
    sum += error;
  }
  const double count = static_cast<double>(errors.size());
  statistics.rmse = std::sqrt(squares / count);
  statistics.mean = sum / count;
  statistics.median = quantile(errors, 0.5);
  statistics.max = *std::max_element(errors.begin(), errors.end());
  return statistics;
}

double quantile(std::vector<double> values, double q) {
  if (values.empty()) return 0.0;
  std::sort(values.begin(), values.end());
  const double position = q * static_cast<double>(values.size() - 1);
  const std::size_t below = static_cast<std::size_t>(position);
  const std::size_t above = std::min(below + 1, values.size() - 1);
  const double fraction = position - static_cast<double>(below);
  return values[below] + fraction * (values[above] - values[below]);
}

}  // namespace mivo
