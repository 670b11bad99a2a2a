// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "mivo/core/parameters.h"

namespace mivo {

/// Sets the parameters that a YAML file of lines `name: value` names; the others keep their values.
/// Throws Error, naming file and line, for a file that is no flat map, an unknown name (with the
/// nearest known one), a name given twice, or a value of the wrong type or out of range (with the
/// range). The parameters are unchanged then.
void readParameters(const std::string& path, Parameters& parameters);

}  // namespace mivo
