// SPDX-License-Identifier: BSD-3-Clause
#include "session/stamp_pairer.h"

namespace mivo {

std::vector<std::pair<std::size_t, std::size_t>> pairByStamp(const std::vector<double>& color,
                                                             const std::vector<double>& depth,
                                                             double max_difference) {
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  PairingOptions options;
  options.max_difference = max_difference;
  options.capacity = color.size() + depth.size();  // they are all here already
  StampPairer<std::size_t> pairer(
      options, [&](std::size_t& i, std::size_t& j) { pairs.emplace_back(i, j); },
      [](ImageStream, std::size_t&) {});
  for (std::size_t i = 0, j = 0; i < color.size() || j < depth.size();) {
    const bool is_color = j == depth.size() || (i < color.size() && color[i] <= depth[j]);
    const double stamp = is_color ? color[i] : depth[j];
    pairer.advance(stamp);
    pairer.push(is_color ? ImageStream::kColor : ImageStream::kDepth, stamp, is_color ? i++ : j++);
  }
  pairer.flush();
  return pairs;
}

}  // namespace mivo
