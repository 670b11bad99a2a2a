// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "mivo/io/output_file.h"

namespace mivo {

/// A file that a program is to write or to read: the option that names it, and its path.
struct NamedFile {
  std::string option;
  std::string path;  ///< empty: not given
};

/// Looks at all outputs of a program before the first one is opened, so that none is touched when
/// another cannot be written. Throws UsageError when two are one file, by whatever spelling or
/// link, or when one is a file that is read; Error when one exists and may not be replaced, or
/// cannot be created.
void requireOutputs(const std::vector<NamedFile>& outputs, const std::vector<NamedFile>& inputs,
                    Overwrite overwrite);

}  // namespace mivo
