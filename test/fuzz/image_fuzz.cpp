// SPDX-License-Identifier: BSD-3-Clause
// Images of folders and compressed topics.
#include "fuzz/fuzz_file.h"
#include "io/image_decoding.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t count) {
  static const std::string name = "image";
  mivo::expectErrorOrSuccess([&] { mivo::decodeImage(bytes, count, name); });
  return 0;
}
