// SPDX-License-Identifier: BSD-3-Clause
#include <filesystem>
#include <string>

#include "mivo/io/sequence_reader.h"
#include "programs/command_line.h"
#include "programs/tracking_run.h"

namespace {

void run(int argc, char** argv) {
  std::string folder;
  mivo::CommandLine line("run_sequence",
                         "Visual odometry over a sequence folder: tracks each frame and writes the "
                         "camera's trajectory.");
  line.argument("FOLDER", &folder,
                "images and camera.txt as TUM lays them out, or 7-Scenes, ScanNet, SUN3D, ...");
  mivo::TrackingCommandLine tracking;
  tracking.declare(line);
  if (!line.parse(argc, argv)) return;
  mivo::TrackingOptions options = tracking.options(line);
  for (const char* name :
       {"rgb.txt", "depth.txt", "associations.txt", "camera.txt", "groundtruth.txt"}) {
    options.inputs.push_back({name, (std::filesystem::path(folder) / name).string()});
  }

  mivo::SequenceReader sequence(folder, options.range);
  mivo::runTracking("run_sequence", sequence, options);
}

}  // namespace

int main(int argc, char** argv) {
  return mivo::runProgram("run_sequence", [&] { run(argc, argv); });
}
