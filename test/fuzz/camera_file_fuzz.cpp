// SPDX-License-Identifier: BSD-3-Clause
// camera.txt.
#include "fuzz/fuzz_file.h"
#include "mivo/io/camera_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t count) {
  static mivo::FuzzFile file;
  mivo::expectErrorOrSuccess([&] {
    const mivo::SequenceCamera camera = mivo::readCamera(file.holding(bytes, count));
    camera.camera.ray({0.0, 0.0});
  });
  return 0;
}
