// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "mivo/core/camera.h"

namespace mivo {

/// What cannot be right about the focal lengths and the principal point, or an empty text. A part
/// of Camera::validate(), which see.
std::string findCameraFault(const Camera& camera);

/// What is hard to believe, as one line for the user, or an empty text: a principal point far from
/// the center, as when the calibration is for images of another size, or focal lengths that differ.
std::string doubtOf(const Camera& camera);

/// What errors are to be expected, and what to do, when the images are so small that poses are
/// wrong by centimeters; otherwise an empty text.
std::string describeCoarseness(const Camera& camera);

/// Whether two cameras differ by no more than the rounding of numbers on their way: by less than a
/// thousandth of a pixel everywhere in the image.
bool isSameButForRounding(const Camera& a, const Camera& b);

}  // namespace mivo
