// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <tuple>
#include <utility>
#include <vector>

namespace mivo {

/// Pairs (index in `first`, index in `second`) of stamps nearest to each other: of all pairs less
/// than `max_difference` apart the closest is taken, then the closest among what is left, and so
/// on, so that each stamp is used once at most. Both lists must be sorted. The pairs are in the
/// order of `first`.
inline std::vector<std::pair<std::size_t, std::size_t>> associate(const std::vector<double>& first,
                                                                  const std::vector<double>& second,
                                                                  double max_difference) {
  std::vector<std::tuple<double, std::size_t, std::size_t>> candidates;
  std::size_t begin = 0;
  for (std::size_t i = 0; i < first.size(); ++i) {
    while (begin < second.size() && first[i] - second[begin] >= max_difference) ++begin;
    for (std::size_t j = begin; j < second.size() && second[j] - first[i] < max_difference; ++j) {
      candidates.emplace_back(std::abs(first[i] - second[j]), i, j);
    }
  }
  std::sort(candidates.begin(), candidates.end());
  std::vector<bool> first_used(first.size(), false);
  std::vector<bool> second_used(second.size(), false);
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (const auto& [difference, i, j] : candidates) {
    static_cast<void>(difference);  // only their order counts
    if (first_used[i] || second_used[j]) continue;
    first_used[i] = true;
    second_used[j] = true;
    pairs.emplace_back(i, j);
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

}  // namespace mivo
