// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "evaluation/absolute_trajectory_error.h"
#include "mivo/trajectory/stamped_pose.h"

namespace mivo {

/// Error of the motion between two poses of the estimate.
struct RelativePoseError {
  double stamp;        ///< s, of the first of the two
  double translation;  ///< m
  double rotation;     ///< rad, 0..pi
};

/// Drift over `delta` seconds (J. Sturm et al., "A Benchmark for the Evaluation of RGB-D SLAM
/// Systems", 2012, Sec. IV): with the true poses Q and the estimated ones P, the error is
/// (P_j^-1 P_i)^-1 (Q_j^-1 Q_i), measured by the norm of its translation and the angle of its
/// rotation. That is the order in the benchmark's tool, whose figures these are; the paper's order
/// gives the same angle, and a translation that differs by the rotation error times the motion.
/// Pairs are made as the benchmark's tool makes them with a fixed delta: each pose i with
/// the pose j nearest to i's stamp + delta; pairs whose j is the very last pose are dropped, for
/// most of them end there only because nothing comes after it. The true pose is the nearest in
/// time; where it is more than `max_time_difference` s away, or the same for both, the pair is
/// dropped. (The tool's own limit is twice the median interval of the truth.)
/// Both trajectories are sorted first, see sortedByStamp.
std::vector<RelativePoseError> relativePoseErrors(const Trajectory& truth,
                                                  const Trajectory& estimate, double delta,
                                                  double max_time_difference);

/// From each matched pose to the next, (Q_i^-1 Q_j)^-1 (P_i^-1 P_j): evo's relative pose error,
/// "evo_rpe --delta 1 --delta_unit f".
std::vector<RelativePoseError> stepErrors(const MatchedPoses& poses);

/// The same between poses `delta` meters of the true path apart, one pair after the other: "evo_rpe
/// --delta DELTA --delta_unit m --pairs_from_reference". The first pair begins where the path first
/// is that long.
std::vector<RelativePoseError> pathErrors(const MatchedPoses& poses, double delta);

}  // namespace mivo
