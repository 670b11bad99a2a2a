// SPDX-License-Identifier: BSD-3-Clause
// record_virtual_xtion FILE.oni IMAGES: a recording of the virtual camera, for tests. Lets the
// sequence play by the camera's control file.

#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <iostream>
#include <sstream>
#include <string>
#include <thread>

#include "openni2/recorder.h"

namespace {

constexpr unsigned kWatchdog = 100;  // s: the SDK's recorder is known to lock up
// How long the first image is shown before the sequence starts: part of the recording.
constexpr std::chrono::milliseconds kStillTime(500);
constexpr int kWholeSequence = 1000000;

void play() {
  const std::string path = std::getenv("MIVO_VIRTUAL_XTION");
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  std::this_thread::sleep_for(kStillTime);
  std::ofstream(path + ".new") << text.str() << "until " << kWholeSequence << '\n';
  std::rename((path + ".new").c_str(), path.c_str());
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3 || std::getenv("MIVO_VIRTUAL_XTION") == nullptr) {
    std::cerr << "usage: MIVO_VIRTUAL_XTION=CONTROL record_virtual_xtion FILE.oni IMAGES\n";
    return 2;
  }
  alarm(kWatchdog);
  try {
    mivo::recordVirtualXtion(argv[1], std::atoi(argv[2]), play);
  } catch (const std::exception& error) {
    std::cerr << "record_virtual_xtion: " << error.what() << '\n';
    return 1;
  }
  return 0;
}
