// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "mivo/core/parameters.h"

namespace mivo {

/// Sets the parameters in a YAML file of lines `name: value`; others keep their values. Throws
/// Error with file and line for a file that is not a flat map, an unknown name (with the nearest
/// known one), a repeated name, or a value of the wrong type or out of range (with the range).
/// Parameters are unchanged then.
void readParameters(const std::string& path, Parameters& parameters);

}  // namespace mivo
