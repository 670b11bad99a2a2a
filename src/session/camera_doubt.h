// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "mivo/core/camera.h"

namespace mivo {

/// Why a calibration cannot be that of a whole image of its size, as one line that names the
/// values; empty when it can. A cut-out of an image may be as it likes.
std::string findCameraDoubt(const Camera& camera);

}  // namespace mivo
