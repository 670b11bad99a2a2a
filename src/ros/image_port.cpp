// SPDX-License-Identifier: BSD-3-Clause
#include "ros/image_port.h"

#include <image_transport/image_transport.h>

#include <utility>

#include "mivo/core/error.h"

namespace mivo {

ImagePort::ImagePort(const ros::NodeHandle& node, const std::string& topic,
                     const std::string& transport, int queue_size,
                     std::function<void(const ImageMessageConstPtr&)> callback)
    : node_(node),
      base_topic_(node_.resolveName(topic)),
      transport_(transport),
      topic_(transport == "raw" ? base_topic_ : base_topic_ + '/' + transport),
      queue_size_(static_cast<std::uint32_t>(queue_size)),
      callback_(std::move(callback)) {}

bool ImagePort::isBuiltIn() const {
  return transport_ == "compressed" || transport_ == "compressedDepth";
}

void ImagePort::subscribe(const ros::NodeHandle& private_node) {
  const ros::TransportHints hints = ros::TransportHints().tcpNoDelay();
  if (isBuiltIn()) {
    const boost::function<void(const sensor_msgs::CompressedImageConstPtr&)> callback =
        [this](const sensor_msgs::CompressedImageConstPtr& message) { callback_(wrap(message)); };
    compressed_subscriber_ = node_.subscribe<sensor_msgs::CompressedImage>(
        topic_, queue_size_, callback, ros::VoidConstPtr(), hints);
    return;
  }
  try {
    const boost::function<void(const sensor_msgs::ImageConstPtr&)> callback =
        [this](const sensor_msgs::ImageConstPtr& message) { callback_(wrap(message)); };
    image_transport::ImageTransport transport(node_);
    image_subscriber_ =
        transport.subscribe(base_topic_, queue_size_, callback, ros::VoidPtr(),
                            image_transport::TransportHints(transport_, hints, private_node));
  } catch (const std::exception& error) {
    throw Error(
        "image transport '" + transport_ + "' of " + base_topic_ +
        " is not available (raw, compressed and compressedDepth always are): " + error.what());
  }
}

void ImagePort::shutdown() {
  image_subscriber_.shutdown();
  compressed_subscriber_.shutdown();
}

std::uint32_t ImagePort::publishers() const {
  return isBuiltIn() ? compressed_subscriber_.getNumPublishers()
                     : image_subscriber_.getNumPublishers();
}

}  // namespace mivo
