// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <opencv2/core/utility.hpp>

namespace mivo {

/// Points per chunk. Sums are formed per chunk and then added in the order of the chunks, so they
/// do not depend on the number of threads. Large enough to be worth handing to another thread.
constexpr std::size_t kChunkSize = 2048;

inline std::size_t numChunks(std::size_t num_points) {
  return (num_points + kChunkSize - 1) / kChunkSize;
}

/// Calls function(chunk, begin, end) for each chunk of 0..num_points, on at most `threads` threads.
template <typename Function>
void forEachChunk(std::size_t num_points, int threads, const Function& function) {
  const auto run = [&](std::size_t chunk) {
    const std::size_t begin = chunk * kChunkSize;
    function(chunk, begin, std::min(num_points, begin + kChunkSize));
  };
  const std::size_t chunks = numChunks(num_points);
  if (threads <= 1 || chunks <= 1) {
    for (std::size_t chunk = 0; chunk < chunks; ++chunk) run(chunk);
    return;
  }
  cv::parallel_for_(
      cv::Range(0, static_cast<int>(chunks)),
      [&](const cv::Range& range) {
        for (int chunk = range.start; chunk < range.end; ++chunk) {
          run(static_cast<std::size_t>(chunk));
        }
      },
      threads);
}

}  // namespace mivo
