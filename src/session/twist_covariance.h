// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mivo/core/se3.h"

namespace mivo {

/// Bounds of the variances that leave mivo: filters divide by them, and overflow on "unknown".
constexpr double kMinVariance = 1e-12;
constexpr double kMaxVariance = 1e6;
/// Variance of what is not known at all: m2, rad2, or per second squared.
constexpr double kUnknownVariance = 1e4;

/// Covariance of the velocity between two poses of given covariances, `seconds` apart. The two
/// frames are aligned with the keyframe independently of each other, so that their errors add up.
Matrix6 twistCovariance(const Matrix6& before, const Matrix6& now, double seconds);

/// The nearest covariance that is symmetric, positive definite and within the bounds above; one of
/// unknown variance when a number is not finite.
Matrix6 boundedCovariance(const Matrix6& covariance);

}  // namespace mivo
