// SPDX-License-Identifier: BSD-3-Clause
#include "ros/bag_topics.h"

#include <algorithm>
#include <array>

#include "mivo/core/error.h"
#include "ros/leading_slash.h"
#include "ros/topics.h"

namespace mivo {
namespace {

constexpr char kImageType[] = "sensor_msgs/Image";
constexpr char kCompressedType[] = "sensor_msgs/CompressedImage";
constexpr char kCameraInfoType[] = "sensor_msgs/CameraInfo";

struct Pair {
  const char* layout;
  const char* color;
  const char* depth;
};

// Pairs of topics that are looked for, in this order: what is registered and unambiguous first.
constexpr Pair kKnownPairs[] = {
    {"tum", "/camera/rgb/image_color", "/camera/depth/image"},
    {"rtabmap", "/camera/rgb/image_rect_color", "/camera/depth_registered/image_raw"},
    {"rtabmap", "/camera/rgb/image_rect_color", "/camera/depth_registered/image_rect"},
    {"openni2", "/camera/rgb/image_rect_color",
     "/camera/depth_registered/hw_registered/image_rect_raw"},
    {"openni2", "/camera/rgb/image_color", "/camera/depth_registered/image_raw"},
    {"openni2", "/camera/rgb/image_raw", "/camera/depth_registered/image_raw"},
    {"openni2", "/camera/rgb/image_raw", "/camera/depth_registered/image"},
    {"openni2", "/camera/rgb/image_raw", "/camera/depth_registered/hw_registered/image_rect_raw"},
    {"openni2", "/camera/rgb/image_rect_mono", "/camera/depth_registered/image_raw"},
    {"realsense", "/camera/color/image_raw", "/camera/aligned_depth_to_color/image_raw"},
    {"realsense", "/camera/color/image_rect_color", "/camera/aligned_depth_to_color/image_raw"},
    {"azure_kinect", "/rgb/image_raw", "/depth_to_rgb/image_raw"},
    {"azure_kinect", "/k4a/rgb/image_raw", "/k4a/depth_to_rgb/image_raw"},
    {"rtabmap", "/rgb/image_rect_color", "/depth_registered/image_raw"},
    {"rtabmap", "/camera/data_throttled_image", "/camera/data_throttled_image_depth"},
    {"rtabmap", "/data_throttled_image", "/data_throttled_image_depth"},
    {"orbbec", "/camera/color/image_raw", "/camera/depth_registered/image_raw"},
    // Not registered, or registered in the driver, as the frames of the images say.
    {"orbbec", "/camera/color/image_raw", "/camera/depth/image_raw"},
    {"realsense", "/camera/color/image_raw", "/camera/depth/image_rect_raw"},
    {"openni2", "/camera/rgb/image_raw", "/camera/depth/image_raw"},
    {"openni2", "/camera/rgb/image_raw", "/camera/depth/image"},
    {"azure_kinect", "/rgb/image_raw", "/depth/image_raw"},
    {"azure_kinect", "/k4a/rgb/image_raw", "/k4a/depth/image_raw"},
};

constexpr std::array<const char*, 3> kTransports = {"", "/compressed", "/compressedDepth"};

bool isImage(const std::string& type) {
  return type == kImageType || type == kCompressedType;
}

/// A topic, which the bag may spell with or without its first slash.
BagContents::const_iterator find(const BagContents& contents, const std::string& topic) {
  const auto entry = contents.find(topic);
  if (entry != contents.end()) return entry;
  const std::string other = withoutSlash(topic);
  return contents.find(other == topic ? '/' + topic : other);
}

/// The topic itself or a compressed form of it, as the bag spells it; empty when the bag has
/// neither.
std::string findImage(const BagContents& contents, const std::string& topic) {
  for (const char* transport : kTransports) {
    const auto entry = find(contents, topic + transport);
    if (entry != contents.end() && isImage(entry->second)) return entry->first;
  }
  return {};
}

/// Whether a topic, in whatever form, is one of those that layouts name.
bool isForm(const std::string& topic, const std::string& known) {
  return withoutSlash(withoutTransport(topic)) == withoutSlash(known);
}

/// Where drivers and tools put the calibration of a color topic.
std::string findCameraInfo(const BagContents& contents, const std::string& color) {
  const std::string base = withoutTransport(color);
  std::string throttled = base;
  const std::string image = "_image";
  const std::size_t at = throttled.rfind(image);
  if (at != std::string::npos) throttled.replace(at, image.size(), "_camera_info");
  for (const std::string& topic :
       {base.substr(0, base.rfind('/') + 1) + "camera_info", throttled}) {
    const auto entry = find(contents, topic);
    if (entry != contents.end() && entry->second == kCameraInfoType) return entry->first;
  }
  return {};
}

/// What is before the last slash: a driver publishes the same images there, raw, rectified, gray.
std::string folderOf(const std::string& topic) {
  const std::string base = withoutTransport(topic);
  return base.substr(0, base.rfind('/') + 1);
}

/// Whether a topic may be one of color, by what drivers call the others.
bool isColorName(const std::string& topic) {
  constexpr std::array<const char*, 6> kOthers = {"depth", "/ir/",       "infra",
                                                  "disp",  "confidence", "mask"};
  return std::none_of(kOthers.begin(), kOthers.end(),
                      [&](const char* word) { return topic.find(word) != std::string::npos; });
}

std::string listTopics(const BagContents& contents) {
  std::string list;
  for (const auto& [topic, type] : contents) {
    if (isImage(type) || type == kCameraInfoType) {
      list += (list.empty() ? "" : ", ") + topic;
    }
  }
  return list.empty() ? "none" : list;
}

[[noreturn]] void refuse(const BagContents& contents, const std::string& what) {
  throw Error(what + "; image and camera_info topics of the bag: " + listTopics(contents));
}

}  // namespace

std::string withoutTransport(const std::string& topic) {
  for (const std::string transport : kTransports) {
    if (!transport.empty() && topic.size() > transport.size() &&
        topic.compare(topic.size() - transport.size(), transport.size(), transport) == 0) {
      return topic.substr(0, topic.size() - transport.size());
    }
  }
  return topic;
}

std::string layoutOf(const RgbdTopics& topics) {
  for (const Pair& pair : kKnownPairs) {
    if (isForm(topics.color, pair.color) && isForm(topics.depth, pair.depth)) {
      return pair.layout;
    }
  }
  return "unknown";
}

const std::vector<BagLayout>& bagLayouts() {
  static const std::vector<BagLayout> layouts = {
      {"tum",
       {"/camera/rgb/image_color", "/camera/depth/image", "/camera/rgb/camera_info"},
       true,
       false,
       "openni_rgb_optical_frame"},
      {"openni2",
       {"/camera/rgb/image_raw", "/camera/depth_registered/image_raw", "/camera/rgb/camera_info"},
       false,
       false,
       frames::kColorOptical},
      {"rtabmap",
       {"/camera/rgb/image_rect_color", "/camera/depth_registered/image_raw",
        "/camera/rgb/camera_info"},
       false,
       true,
       frames::kColorOptical},
      {"realsense",
       {"/camera/color/image_raw", "/camera/aligned_depth_to_color/image_raw",
        "/camera/color/camera_info"},
       false,
       false,
       "camera_color_optical_frame"},
  };
  return layouts;
}

const BagLayout& bagLayout(const std::string& name) {
  std::string known;
  for (const BagLayout& layout : bagLayouts()) {
    if (layout.name == name) return layout;
    known += ' ' + layout.name;
  }
  throw Error("unknown layout '" + name + "', expected one of" + known);
}

RgbdTopics findTopics(const BagContents& contents, const RgbdTopics& given) {
  RgbdTopics wanted = given;
  for (std::string* topic : {&wanted.color, &wanted.depth}) {
    if (topic->empty()) continue;
    const std::string found = findImage(contents, *topic);
    if (found.empty()) refuse(contents, "the bag has no images on the topic " + *topic);
    *topic = found;
  }
  RgbdTopics topics = wanted;
  for (const Pair& pair : kKnownPairs) {
    if (!topics.color.empty() && !topics.depth.empty()) break;
    const std::string color = wanted.color.empty() ? findImage(contents, pair.color) : wanted.color;
    const std::string depth = wanted.depth.empty() ? findImage(contents, pair.depth) : wanted.depth;
    if (color.empty() || depth.empty()) continue;
    // A color topic of the user's choice goes with the depth topic of its own driver first.
    if (!wanted.color.empty() && !isForm(wanted.color, pair.color) &&
        std::any_of(std::begin(kKnownPairs), std::end(kKnownPairs), [&](const Pair& other) {
          return isForm(wanted.color, other.color) && !findImage(contents, other.depth).empty();
        })) {
      continue;
    }
    topics.color = color;
    topics.depth = depth;
  }
  if (topics.color.empty() || topics.depth.empty()) {
    refuse(contents,
           "no known pair of color and depth topics; name them with --rgb and "
           "--depth");
  }
  if (topics.camera_info.empty()) topics.camera_info = findCameraInfo(contents, topics.color);
  const auto info = find(contents, topics.camera_info);
  if (info == contents.end() || info->second != kCameraInfoType) {
    refuse(contents, topics.camera_info.empty()
                         ? "no camera_info beside " + topics.color + "; name it with --camera-info"
                         : "the bag has no camera_info on the topic " + topics.camera_info);
  }
  topics.camera_info = info->first;
  if (topics.depth_info.empty()) topics.depth_info = findCameraInfo(contents, topics.depth);
  return topics;
}

std::set<std::string> otherCameras(const BagContents& contents, const RgbdTopics& topics) {
  std::set<std::string> others;
  for (const auto& [topic, type] : contents) {
    if (isImage(type) && isColorName(topic) && folderOf(topic) != folderOf(topics.color)) {
      others.insert(withoutTransport(topic));
    }
  }
  return others;
}

}  // namespace mivo
