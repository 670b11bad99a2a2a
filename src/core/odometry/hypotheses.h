// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/odometry/prediction.h"
#include "core/odometry/search.h"

namespace mivo {

/// How far a sight is from where the motion so far leads: the squared length of the difference over
/// the covariance of both, a chi square of six degrees of freedom when nothing is wrong.
double innovation(const SearchInput& input, const Prediction& prediction, const Sight& sight);

/// How well a sight explains the frame, nats: what its image has in common with the keyframe's, and
/// how little the motion surprises. Sights of one frame are compared by it, from whatever start or
/// level they come. One logarithm for the motion, for cameras do now and then what nobody expects.
double evidence(const SearchInput& input, const Prediction& prediction, const Sight& sight);

/// Whether two sights of a frame explain it alike, and yet end at different poses.
bool isAmbiguous(const SearchInput& input, const Prediction& prediction, const Sight& better,
                 const Sight& other);

/// The better one, with a covariance that has the other's pose in it.
Sight coveringBoth(const SearchInput& input, const Sight& better, const Sight& other);

}  // namespace mivo
