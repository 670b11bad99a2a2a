// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/time.h>

namespace mivo {

/// Seconds of a stamp, rounded once: the same double as when parsing its decimals from a text file,
/// so that bags and folders agree bit by bit.
double toSeconds(const ros::Time& time);

/// Stamp nearest to the seconds. Throws Error for values that ros::Time cannot represent: negative,
/// later than 2106, not finite.
ros::Time toTime(double seconds);

}  // namespace mivo
