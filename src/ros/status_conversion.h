// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mivo/TrackingStatus.h>

#include "mivo/core/tracking_result.h"

namespace mivo {

/// The tracker's part of the message; header, counts of frames, latency and the times of the
/// messages' way are left to the caller.
TrackingStatus toMessage(const TrackingResult& result);

}  // namespace mivo
