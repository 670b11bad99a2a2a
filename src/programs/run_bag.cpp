// SPDX-License-Identifier: BSD-3-Clause
#include <iostream>
#include <string>

#include "programs/bag_options.h"
#include "programs/command_line.h"
#include "programs/tracking_run.h"
#include "ros/bag_source.h"

namespace {

void run(int argc, char** argv) {
  std::string bag;
  mivo::RgbdTopics topics;
  mivo::CommandLine line("run_bag",
                         "Visual odometry over a bag, as fast as it goes and without a ROS master: "
                         "tracks each frame and writes the camera's trajectory.");
  line.argument("BAG", &bag, "a bag with colour images, registered depth images and camera_info");
  mivo::declareTopics(line, &topics);
  mivo::TrackingCommandLine tracking;
  tracking.declare(line);
  if (!line.parse(argc, argv)) return;
  const mivo::TrackingOptions options = tracking.options(line);

  mivo::BagSource source(bag, topics, options.range);
  const mivo::TrackingSummary summary = trackFrames(source, options);
  print(std::cout, summary);
  requireTracked(summary);
}

}  // namespace

int main(int argc, char** argv) {
  return mivo::runProgram("run_bag", [&] { run(argc, argv); });
}
