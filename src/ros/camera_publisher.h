// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <image_transport/camera_publisher.h>
#include <ros/node_handle.h>
#include <sensor_msgs/Image.h>

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <string>

#include "openni2/camera_session.h"
#include "ros/camera_calibration.h"
#include "ros/camera_parameters.h"
#include "session/stamp_pairer.h"

namespace mivo {

/// The message of an image: rgb8; depth 16UC1 when it is in millimeters, otherwise 32FC1 in meters
/// with NaN for no reading. The only copy of the pixels.
sensor_msgs::ImagePtr toMessage(const ImageView& view);

struct PairStatistics {
  std::int64_t pairs = 0;
  std::int64_t singles = 0;  ///< images without a partner
  double offset = 0.0;       ///< s, depth minus color, of the last pair
};

/// Publishes images with their camera_info, color and depth of a pair together, as pointers:
/// nodelets in the same manager receive them without a copy.
class CameraPublisher {
 public:
  /// `on_demand` is called when subscribers come or go.
  CameraPublisher(ros::NodeHandle node, const CameraParameters& parameters,
                  std::function<void(const StreamDemand&)> on_demand);
  ~CameraPublisher();
  CameraPublisher(const CameraPublisher&) = delete;
  CameraPublisher& operator=(const CameraPublisher&) = delete;

  /// From the camera's thread. @param stamp host time, ns
  void add(const ImageView& image, std::int64_t stamp);
  void setDevice(const DeviceDescription& device);
  /// Added to the stamps from now on, s.
  void setTimeOffsets(double color, double depth);

  PairStatistics statistics() const;

 private:
  /// An image that waits for its partner.
  struct PublishedImage {
    sensor_msgs::ImagePtr message;
    std::uint64_t device_stamp;  ///< microseconds
  };

  void advertise(ros::NodeHandle node, bool registration);
  void updateDemand();  // called inside the gate
  void publishPair(const PublishedImage& color, const PublishedImage& depth);
  void publishSingle(StreamKind kind, const PublishedImage& image);
  void publish(StreamKind kind, const sensor_msgs::ImagePtr& image);

  const std::string color_frame_;
  const std::string depth_frame_;
  const bool registered_;
  std::function<void(const StreamDemand&)> on_demand_;
  CameraCalibration color_calibration_;
  std::unique_ptr<CameraCalibration> depth_calibration_;  ///< without registration only

  /// Gate of subscriber callbacks. image_transport does not wait for running callbacks when a
  /// publisher is destroyed; they therefore share ownership of the gate.
  struct Gate {
    std::mutex mutex;
    bool is_open = true;
  };
  std::shared_ptr<Gate> gate_ = std::make_shared<Gate>();
  image_transport::CameraPublisher color_publisher_;
  image_transport::CameraPublisher depth_publisher_;
  std::atomic<bool> color_wanted_{false};
  std::atomic<bool> depth_wanted_{false};
  std::atomic<double> color_time_offset_{0.0};
  std::atomic<double> depth_time_offset_{0.0};

  StampPairer<PublishedImage> pairer_;  // used by the camera thread only
  mutable std::mutex statistics_mutex_;
  PairStatistics statistics_;
};

}  // namespace mivo
