// SPDX-License-Identifier: BSD-3-Clause
#include <iostream>
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
  line.argument("FOLDER", &folder, "rgb.txt, depth.txt, [associations.txt,] camera.txt and images");
  mivo::TrackingCommandLine tracking;
  tracking.declare(line);
  if (!line.parse(argc, argv)) return;
  const mivo::TrackingOptions options = tracking.options(line);

  mivo::SequenceReader sequence(folder, options.range);
  if (!sequence.notice().empty()) std::cerr << "run_sequence: note: " << sequence.notice() << "\n";
  const mivo::TrackingSummary summary = trackFrames(sequence, options);
  print(std::cout, summary);
  requireTracked(summary);
}

}  // namespace

int main(int argc, char** argv) {
  return mivo::runProgram("run_sequence", [&] { run(argc, argv); });
}
