// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace mivo {

/// Throws UsageError unless the ending is that of a kind of file that plots are written as: .png,
/// .pdf or .svg.
void requirePlotEnding(const std::string& option, const std::string& path);

/// Draws a table by one of the Python scripts that lie beside the programs, with matplotlib: the
/// table goes to its standard input. Throws Error, in one line, when matplotlib or the script is
/// missing, or it fails: the last line that it told.
/// @param file  what is written; its ending says the format
void plotWithPython(const std::string& script, const std::string& table, const std::string& file);

}  // namespace mivo
