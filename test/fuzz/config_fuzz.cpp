// SPDX-License-Identifier: BSD-3-Clause
// Configuration files.
#include "fuzz/fuzz_file.h"
#include "mivo/io/config_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t count) {
  static mivo::FuzzFile file;
  mivo::Parameters parameters;
  mivo::expectErrorOrSuccess([&] { mivo::readParameters(file.holding(bytes, count), parameters); });
  parameters.validate();  // whatever the file says
  return 0;
}
