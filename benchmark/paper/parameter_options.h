// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "mivo/core/parameters.h"
#include "programs/command_line.h"

namespace mivo {

/// `--set name=value`, as the programs that track have it, for experiments on the library itself.
class ParameterOptions {
 public:
  /// Adds the option. The object must live until after CommandLine::parse.
  void declare(CommandLine& line);

  /// The defaults with what was set. Throws UsageError.
  Parameters parameters() const;

 private:
  std::vector<std::string> settings_;
};

}  // namespace mivo
