// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "mivo/trajectory/stamped_pose.h"

namespace mivo {

/// The poses in the order of their stamps; of several with the same stamp the last one is kept.
Trajectory sortedByStamp(Trajectory trajectory);

/// Stamps of the poses, in their order.
std::vector<double> stampsOf(const Trajectory& trajectory);

/// Index of the stamp nearest to `stamp`. Of two that are equally near it is the one that a binary
/// search over the whole list meets first, as in the published tools of the TUM benchmark: with
/// dropped frames such ties do occur. The list must be sorted and not empty.
std::size_t nearestIndex(const std::vector<double>& stamps, double stamp);

}  // namespace mivo
