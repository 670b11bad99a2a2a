// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace mivo {

/// The rigid motion T, without scale, with the least sum of squares of T * from - to (Horn 1987,
/// Umeyama 1991). Columns correspond; there must be one at least. With points on a line the
/// rotation about it is one of many.
Eigen::Isometry3d rigidAlignment(const Eigen::Matrix3Xd& from, const Eigen::Matrix3Xd& to);

/// The factor of `from` in the similarity, rotation, translation and scale, with the least sum of
/// squares (Umeyama 1991). 1 when all points of `from` are the same.
double similarityScale(const Eigen::Matrix3Xd& from, const Eigen::Matrix3Xd& to);

}  // namespace mivo
