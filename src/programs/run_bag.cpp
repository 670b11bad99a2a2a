// SPDX-License-Identifier: BSD-3-Clause
#include <string>
#include <vector>

#include "programs/bag_options.h"
#include "programs/command_line.h"
#include "programs/tracking_run.h"
#include "ros/bag_source.h"

namespace {

void run(int argc, char** argv) {
  std::vector<std::string> bags;
  mivo::RgbdTopics topics;
  mivo::CommandLine line(
      "run_bag",
      "Tracks an RGB-D camera through a bag, as fast as possible and without a ROS "
      "master, and writes its trajectory.");
  line.arguments(
      "BAG", &bags,
      "bag with color images, depth images and camera_info; several bags are one recording");
  mivo::declareTopics(line, &topics);
  mivo::TrackingCommandLine tracking;
  tracking.declare(line);
  if (!line.parse(argc, argv)) return;
  mivo::TrackingOptions options = tracking.options(line);
  for (const std::string& bag : bags) options.inputs.push_back({"BAG", bag});

  mivo::BagSource source(bags, topics, options.range);
  mivo::runTracking("run_bag", source, options);
}

}  // namespace

int main(int argc, char** argv) {
  return mivo::runProgram("run_bag", [&] { run(argc, argv); });
}
