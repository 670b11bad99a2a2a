// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

namespace mivo {

/// The topics of an RGB-D camera. A compressed topic carries its transport at the end of its name:
/// /compressed or /compressedDepth.
struct RgbdTopics {
  std::string color;
  std::string depth;
  std::string camera_info;
  std::string depth_info = "";  ///< calibration of depth; empty where there is none
};

/// A topic without the transport at the end of its name.
std::string withoutTransport(const std::string& topic);

/// How a family of drivers and tools names its topics.
struct BagLayout {
  std::string name;  ///< tum, openni2, rtabmap, realsense
  RgbdTopics topics;
  bool float_depth;  ///< depth as 32FC1 in meters, otherwise 16UC1 in millimeters
  bool rectified;    ///< the images have no distortion
  std::string optical_frame;
};

/// The layouts that sequence_to_bag writes; the first topics of each are looked for in bags.
const std::vector<BagLayout>& bagLayouts();

/// What recorded some topics: the name of a layout, or of a driver that mivo does not write as, or
/// "unknown".
std::string layoutOf(const RgbdTopics& topics);

/// Throws Error, listing the layouts, for an unknown name.
const BagLayout& bagLayout(const std::string& name);

/// Topics of a bag and their types, e.g. "sensor_msgs/Image".
using BagContents = std::map<std::string, std::string>;

/// Fills in what is empty in `wanted`, where a topic without transport means a compressed form of
/// it, too: the first known pair of color and depth topics that the bag
/// holds, raw or compressed, registered ones first, and the camera_info beside the topics. Throws
/// Error, listing the image topics of the bag, when nothing fits or a wanted topic is not there.
RgbdTopics findTopics(const BagContents& contents, const RgbdTopics& wanted);

/// Color topics of other cameras than the one in `topics`, without their transports.
std::set<std::string> otherCameras(const BagContents& contents, const RgbdTopics& topics);

}  // namespace mivo
