// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace mivo {

/// Draws a table by one of the Python scripts that lie beside the programs, with matplotlib: the
/// table goes to its standard input. Throws Error, in one line, when matplotlib or the script is
/// missing, or it fails.
/// @param file  what is written; its ending says the format
void plotWithPython(const std::string& script, const std::string& table, const std::string& file);

}  // namespace mivo
