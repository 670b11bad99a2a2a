// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core/mat.hpp>
#include <optional>
#include <vector>

#include "mivo/core/frame.h"

namespace mivo {

/// What one frame of a recording looks like.
struct FrameLook {
  double stamp = 0.0;           ///< s
  double brightness = 0.0;      ///< mean gray level
  double sharpness = 0.0;       ///< of edges, against the contrast: falls with motion and focus
  double depth_coverage = 0.0;  ///< part of the pixels with a reading
  double median_depth = 0.0;    ///< m; 0: no reading
};

FrameLook lookAt(const Frame& frame);

/// How far the edges of depth lie from those of color, over several frames: in a recording whose
/// depth is registered both are at the same place.
class EdgeOffset {
 public:
  void add(const Frame& frame);

  /// Pixels by which the edges of depth have to be moved to those of color, to the right and down;
  /// nothing where there are too few edges, or no shift fits better than the others.
  struct Shift {
    double x;
    double y;
  };
  std::optional<Shift> shift() const;

  /// How far the best shift stands out: 1 when it fits no better than the others.
  double clarity() const;

 private:
  static constexpr int kReach = 20;  // pixels, of a shift that is looked for
  struct Score {
    std::vector<double> sum = std::vector<double>(2 * kReach + 1);  // by shift
    std::size_t edges = 0;
  };
  static void addRows(const cv::Mat& image, const cv::Mat& depth, Score& score);
  static double clarity(const Score& score);
  static std::optional<double> peak(const Score& score);

  Score columns_;  // vertical edges, moved along rows
  Score rows_;     // of the transposed images
};

}  // namespace mivo
