// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "mivo/core/tracking_result.h"
#include "mivo/io/output_file.h"

namespace mivo {

/// Statistics of each frame as comma-separated values: a row of names, then a row per frame.
/// Columns: stamp (s), state, reason, keyframe (its number, 0: none), new_keyframe (0 or 1),
/// segment; for each level L of the pyramid, 0 the finest, iterations_L, evaluations_L (of the
/// cost), points_L (of the keyframe), visible_L (of them used), ms_L and, of it, ms_line_search_L;
/// mutual_information (nats), residual_scale (gray levels), overlap (0..1); sigma_tx, sigma_ty,
/// sigma_tz (m), sigma_rx, sigma_ry, sigma_rz (rad), square roots of the covariance's diagonal;
/// ms_pyramid, ms_tracking, ms_keyframe, ms_total, processor time by stage; cpu_ms, processor time
/// of the process; covariance_00 to covariance_55, its upper triangle; depth_time_offset (s).
class StatisticsFile {
 public:
  /// Throws Error when the file exists and may not be replaced, or cannot be created.
  StatisticsFile(const std::string& path, Overwrite overwrite, int levels);

  /// The row is on disk when this has returned.
  void write(double stamp, const TrackingResult& result, double cpu_ms);

 private:
  OutputFile file_;
  int levels_;
};

}  // namespace mivo
