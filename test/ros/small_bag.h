// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <rosbag/bag.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>

#include <cstdint>
#include <functional>
#include <string>

#include "ros/stamp.h"

namespace mivo {

/// Bags of small images with the topics of openni2. Each message can be changed before it is
/// written.
class SmallBag {
 public:
  static constexpr int kWidth = 32;
  static constexpr int kHeight = 24;
  static constexpr double kFirst = 1600000001.0;  // s, stamp of frame 0

  /// One frame's messages, and when they are recorded.
  struct Messages {
    sensor_msgs::Image color;
    sensor_msgs::Image depth;
    sensor_msgs::CameraInfo info;
    ros::Time recorded;
    bool has_info = true;
  };
  using Change = std::function<void(int i, Messages& messages)>;

  static double stamp(int i) { return kFirst + i / 30.0; }

  static Messages messagesOf(int i) {
    Messages m;
    m.recorded = toTime(stamp(i) + 0.01);
    for (sensor_msgs::Image* image : {&m.color, &m.depth}) {
      image->header.stamp = toTime(stamp(i));
      image->header.frame_id = "camera_rgb_optical_frame";
      image->width = kWidth;
      image->height = kHeight;
      const bool is_depth = image == &m.depth;
      image->encoding = is_depth ? "16UC1" : "mono8";
      image->step = kWidth * (is_depth ? 2U : 1U);
      // 16 bits: 0x0404 and more, about a meter.
      image->data.assign(image->step * kHeight, static_cast<std::uint8_t>(4 + i));
    }
    m.info.header = m.color.header;
    m.info.width = kWidth;
    m.info.height = kHeight;
    m.info.distortion_model = "plumb_bob";
    m.info.D.assign(5, 0.0);
    m.info.K = {30.0, 0.0, 15.5, 0.0, 30.0, 11.5, 0.0, 0.0, 1.0};
    m.info.P = {30.0, 0.0, 15.5, 0.0, 0.0, 30.0, 11.5, 0.0, 0.0, 0.0, 1.0, 0.0};
    return m;
  }

  static void write(
      const std::string& path, int first, int end, const Change& change = [](int, Messages&) {},
      rosbag::CompressionType compression = rosbag::compression::Uncompressed) {
    rosbag::Bag bag(path, rosbag::bagmode::Write);
    bag.setCompression(compression);
    bag.setChunkThreshold(2 * kWidth * kHeight);  // about a chunk per frame
    for (int i = first; i < end; ++i) {
      Messages m = messagesOf(i);
      change(i, m);
      if (m.has_info) {
        bag.write("/camera/rgb/camera_info", m.recorded, m.info);
      }
      if (!m.color.data.empty()) bag.write("/camera/rgb/image_raw", m.recorded, m.color);
      if (!m.depth.data.empty()) {
        bag.write("/camera/depth_registered/image_raw", m.recorded, m.depth);
      }
    }
  }
};

}  // namespace mivo
