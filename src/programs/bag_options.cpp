// SPDX-License-Identifier: BSD-3-Clause
#include "programs/bag_options.h"

namespace mivo {

void declareTopics(CommandLine& line, RgbdTopics* topics) {
  namespace po = boost::program_options;
  line.options()("rgb", po::value<std::string>(&topics->colour),
                 "topic of the colour images; looked for when not given")(
      "depth", po::value<std::string>(&topics->depth),
      "topic of the depth images, registered to the colour camera; looked for when not given")(
      "camera-info", po::value<std::string>(&topics->camera_info),
      "topic of the calibration; the one beside the colour topic when not given");
}

}  // namespace mivo
