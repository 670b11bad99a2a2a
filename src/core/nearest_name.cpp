// SPDX-License-Identifier: BSD-3-Clause
#include "core/nearest_name.h"

#include <algorithm>
#include <cstddef>
#include <numeric>

namespace mivo {
namespace {

/// Fewest insertions, deletions and replacements of a character that turn a into b.
std::size_t editDistance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), 0U);
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row.back();
}

}  // namespace

std::string didYouMean(const std::string& name, const std::vector<std::string>& known,
                       const std::string& before, const std::string& after) {
  const auto nearest =
      std::min_element(known.begin(), known.end(), [&](const std::string& a, const std::string& b) {
        return editDistance(a, name) < editDistance(b, name);
      });
  if (nearest == known.end()) return {};
  const std::size_t letters = std::max(nearest->size(), name.size());
  if (3 * editDistance(*nearest, name) > letters) return {};
  return "; did you mean " + before + *nearest + after + "?";
}

}  // namespace mivo
