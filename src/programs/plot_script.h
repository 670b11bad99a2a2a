// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace mivo {

/// Throws UsageError unless the ending is that of a kind of file that plots are written as: .png,
/// .pdf or .svg.
void requirePlotEnding(const std::string& option, const std::string& path);

/// Runs a plotting script that lies beside the program: it draws `data`, which it gets on its
/// standard input, into the file `path`. Throws Error with the script's last line on stderr when it
/// fails, as without matplotlib.
void runPlotScript(const std::string& script, const std::string& path, const std::string& data);

}  // namespace mivo
