// SPDX-License-Identifier: BSD-3-Clause
// Bags, read by rosbag where it can and salvaged where it cannot.
#include "fuzz/fuzz_file.h"
#include "ros/bag_source.h"

namespace {

constexpr int kMostFrames = 20;

void readAll(const std::string& path) {
  mivo::BagSource source(path, mivo::RgbdTopics{});
  mivo::Frame frame;
  mivo::FrameFault fault;
  for (int i = 0; i < kMostFrames; ++i) {
    if (source.next(frame, fault) == mivo::FrameSource::Status::kEnd) break;
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t count) {
  static mivo::FuzzFile file;
  mivo::expectErrorOrSuccess([&] { readAll(file.holding(bytes, count)); });
  return 0;
}
