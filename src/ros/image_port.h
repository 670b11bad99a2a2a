// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <image_transport/subscriber.h>
#include <ros/node_handle.h>

#include <cstdint>
#include <functional>
#include <string>

#include "ros/image_message.h"

namespace mivo {

/// Subscription to one image topic through any transport. The transports compressed and
/// compressedDepth are decoded by mivo itself; others need their image_transport plugin.
class ImagePort {
 public:
  /// @param callback  called with each message
  ImagePort(const ros::NodeHandle& node, const std::string& topic, const std::string& transport,
            int queue_size, std::function<void(const ImageMessageConstPtr&)> callback);

  /// Throws Error, naming the transport, when there is no plugin for it.
  void subscribe(const ros::NodeHandle& private_node);
  void shutdown();

  const std::string& topic() const { return topic_; }  ///< resolved, with the transport's suffix
  std::uint32_t publishers() const;

 private:
  bool isBuiltIn() const;

  ros::NodeHandle node_;
  std::string base_topic_;
  std::string transport_;
  std::string topic_;
  std::uint32_t queue_size_;
  std::function<void(const ImageMessageConstPtr&)> callback_;
  image_transport::Subscriber image_subscriber_;
  ros::Subscriber compressed_subscriber_;
};

}  // namespace mivo
