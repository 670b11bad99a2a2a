// SPDX-License-Identifier: BSD-3-Clause
#include "programs/statistics_file.h"

#include <fmt/format.h>

#include <cmath>

namespace mivo {
namespace {

/// The record of a level, all zero when the frame was not aligned on it.
LevelRecord recordOf(const TrackingResult& result, int level) {
  for (int i = 0; i < result.num_levels; ++i) {
    const LevelRecord& record = result.levels[static_cast<std::size_t>(i)];
    if (record.level == level) return record;
  }
  return {};
}

std::string covarianceNames(const char* name) {
  std::string names;
  for (int i = 0; i < 6; ++i) {
    for (int j = i; j < 6; ++j) names += fmt::format(",{}_{}{}", name, i, j);
  }
  return names;
}

std::string upperTriangle(const Matrix6& covariance) {
  std::string numbers;
  for (int i = 0; i < 6; ++i) {
    for (int j = i; j < 6; ++j) numbers += fmt::format(",{:.9g}", covariance(i, j));
  }
  return numbers;
}

}  // namespace

StatisticsFile::StatisticsFile(const std::string& path, Overwrite overwrite, int levels)
    : file_(path, overwrite), levels_(levels) {
  std::string header = "stamp,state,reason,keyframe,new_keyframe,segment";
  for (int level = 0; level < levels; ++level) {
    header += fmt::format(
        ",iterations_{0},evaluations_{0},points_{0},visible_{0},ms_{0},ms_line_search_{0}", level);
  }
  header +=
      ",mutual_information,residual_scale,overlap,rolling_shutter_readout"
      ",sigma_tx,sigma_ty,sigma_tz,sigma_rx,sigma_ry,sigma_rz"
      ",ms_pyramid,ms_tracking,ms_keyframe,ms_total,cpu_ms";
  header += covarianceNames("covariance");
  header += ",depth_time_offset" + covarianceNames("alignment_covariance");
  file_.write(header + "\n");
}

void StatisticsFile::write(double stamp, const TrackingResult& result, double cpu_ms) {
  std::string row =
      fmt::format("{:.6f},{},{},{},{},{}", stamp, toString(result.state), toString(result.reason),
                  result.keyframe, result.new_keyframe ? 1 : 0, result.segment);
  for (int level = 0; level < levels_; ++level) {
    const LevelRecord record = recordOf(result, level);
    row += fmt::format(",{},{},{},{},{:.4f},{:.4f}", record.iterations, record.evaluations,
                       record.points, record.visible, record.milliseconds,
                       record.line_search_milliseconds);
  }
  row += fmt::format(",{:.6g},{:.6g},{:.6g},{:.5f}", result.mutual_information,
                     result.residual_scale, result.overlap, result.rolling_shutter_readout);
  for (int i = 0; i < 6; ++i) row += fmt::format(",{:.6g}", std::sqrt(result.covariance(i, i)));
  const StageTimes& times = result.milliseconds;
  row += fmt::format(",{:.3f},{:.3f},{:.3f},{:.3f},{:.3f}", times.pyramid, times.tracking,
                     times.keyframe, times.total, cpu_ms);
  row += upperTriangle(result.covariance);
  row += fmt::format(",{:.5f}", result.depth_time_offset);
  row += upperTriangle(result.alignment_covariance);
  file_.write(row + "\n");
}

}  // namespace mivo
