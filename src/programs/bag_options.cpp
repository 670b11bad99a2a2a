// SPDX-License-Identifier: BSD-3-Clause
#include "programs/bag_options.h"

namespace mivo {

void declareTopics(CommandLine& line, RgbdTopics* topics) {
  namespace po = boost::program_options;
  line.options()("rgb", po::value<std::string>(&topics->color),
                 "topic of the color images (default: found by known names)")(
      "depth", po::value<std::string>(&topics->depth),
      "topic of the depth images, registered to the color camera (default: found by known names)")(
      "camera-info", po::value<std::string>(&topics->camera_info),
      "topic of the calibration (default: in the namespace of the color topic)");
}

}  // namespace mivo
