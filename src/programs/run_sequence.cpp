// SPDX-License-Identifier: BSD-3-Clause
#include <filesystem>
#include <string>

#include "mivo/io/sequence_reader.h"
#include "programs/command_line.h"
#include "programs/tracking_run.h"

namespace {

void run(int argc, char** argv) {
  std::string folder;
  mivo::CommandLine line(
      "run_sequence",
      "Tracks an RGB-D camera through a sequence folder and writes its trajectory.");
  line.argument("FOLDER", &folder,
                "sequence folder in the layout of TUM (images and camera.txt), 7-Scenes, ScanNet, "
                "SUN3D, ...");
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
