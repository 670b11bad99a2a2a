// SPDX-License-Identifier: BSD-3-Clause
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
                "folder with rgb.txt, depth.txt, [associations.txt,] camera.txt and images");
  mivo::TrackingCommandLine tracking;
  tracking.declare(line);
  if (!line.parse(argc, argv)) return;
  const mivo::TrackingOptions options = tracking.options(line);

  mivo::SequenceReader sequence(folder, options.range);
  mivo::runTracking("run_sequence", sequence, options);
}

}  // namespace

int main(int argc, char** argv) {
  return mivo::runProgram("run_sequence", [&] { run(argc, argv); });
}
