// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/time.h>

namespace mivo {

/// Seconds of a stamp, rounded once: the same double that reading the stamp's decimals from a text
/// file gives, so that bags and folders agree to the bit.
double toSeconds(const ros::Time& time);

/// Stamp nearest to the seconds. Throws Error for what ros::Time cannot hold: negative, later than
/// 2106, not finite.
ros::Time toTime(double seconds);

}  // namespace mivo
