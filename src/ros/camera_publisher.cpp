// SPDX-License-Identifier: BSD-3-Clause
#include "ros/camera_publisher.h"

#include <boost/predef/other/endian.h>
#include <image_transport/image_transport.h>
#include <sensor_msgs/image_encodings.h>

#include <boost/make_shared.hpp>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

namespace mivo {
namespace {

constexpr std::uint32_t kQueueSize =
    5;                                  // images that wait for a slow subscriber of another process
constexpr std::size_t kMaxWaiting = 4;  // images that wait for their partner
// Stamps of a pair that differ by less are those of one exposure: both get the color's, so that
// exact synchronizers find them.
constexpr std::uint64_t kSameExposure = 1000;  // microseconds
constexpr double kMillimeter = 0.001;
constexpr double kUnitPrecision = 1e-9;
constexpr double kMicrosecondsPerSecond = 1e6;

// Rows without the padding behind them.
void copyRows(const ImageView& view, std::size_t row_bytes, std::vector<std::uint8_t>& data) {
  if (view.stride == row_bytes) {
    data.assign(view.data, view.data + row_bytes * static_cast<std::size_t>(view.height));
    return;
  }
  data.reserve(row_bytes * static_cast<std::size_t>(view.height));
  for (int y = 0; y < view.height; ++y) {
    const std::uint8_t* row = view.data + static_cast<std::size_t>(y) * view.stride;
    data.insert(data.end(), row, row + row_bytes);
  }
}

void convertToMeters(const ImageView& view, std::vector<std::uint8_t>& data) {
  const auto width = static_cast<std::size_t>(view.width);
  data.resize(width * static_cast<std::size_t>(view.height) * sizeof(float));
  auto* meters = reinterpret_cast<float*>(data.data());
  const auto unit = static_cast<float>(view.depth_unit);
  for (int y = 0; y < view.height; ++y) {
    const auto* row = reinterpret_cast<const std::uint16_t*>(
        view.data + static_cast<std::size_t>(y) * view.stride);
    for (std::size_t x = 0; x < width; ++x) {
      *meters++ =
          row[x] == 0 ? std::numeric_limits<float>::quiet_NaN() : static_cast<float>(row[x]) * unit;
    }
  }
}

/// By device stamps: whole microseconds that always grow.
PairingOptions pairingOptions(double tolerance) {
  PairingOptions options;
  // Half a step more: the tolerance itself is within, whatever the rounding.
  options.max_difference = tolerance + 0.5 / kMicrosecondsPerSecond;
  options.capacity = kMaxWaiting;
  options.time_jump = 0.0;  // the device's clock went back
  // The tolerance is less than half a period, or neighbors would be taken for partners. So nothing
  // that is still to come fits better than an image within it.
  options.min_gap = 2.0 * options.max_difference;
  return options;
}

ros::Time toRosTime(std::int64_t nanoseconds) {
  ros::Time time;
  time.fromNSec(static_cast<std::uint64_t>(nanoseconds));
  return time;
}

}  // namespace

sensor_msgs::ImagePtr toMessage(const ImageView& view) {
  auto message = boost::make_shared<sensor_msgs::Image>();
  message->width = static_cast<std::uint32_t>(view.width);
  message->height = static_cast<std::uint32_t>(view.height);
  message->is_bigendian = BOOST_ENDIAN_BIG_BYTE ? 1 : 0;
  const auto width = static_cast<std::size_t>(view.width);
  std::size_t row_bytes = 0;
  if (view.kind == StreamKind::kColor) {
    message->encoding = sensor_msgs::image_encodings::RGB8;
    row_bytes = 3 * width;
    copyRows(view, row_bytes, message->data);
  } else if (std::abs(view.depth_unit - kMillimeter) < kUnitPrecision) {
    message->encoding = sensor_msgs::image_encodings::TYPE_16UC1;
    row_bytes = sizeof(std::uint16_t) * width;
    copyRows(view, row_bytes, message->data);
  } else {
    // 16UC1 means millimeters to everybody: other units go out in meters.
    message->encoding = sensor_msgs::image_encodings::TYPE_32FC1;
    row_bytes = sizeof(float) * width;
    convertToMeters(view, message->data);
  }
  message->step = static_cast<std::uint32_t>(row_bytes);
  return message;
}

CameraPublisher::CameraPublisher(ros::NodeHandle node, const CameraParameters& parameters,
                                 std::function<void(const StreamDemand&)> on_demand)
    : color_frame_(parameters.rgbOpticalFrame()),
      depth_frame_(parameters.device.registration ? parameters.rgbOpticalFrame()
                                                  : parameters.depthOpticalFrame()),
      registered_(parameters.device.registration),
      on_demand_(std::move(on_demand)),
      color_calibration_(ros::NodeHandle(node, "rgb"), "rgb", parameters.rgb_camera_info_url),
      pairer_(
          pairingOptions(parameters.pair_tolerance),
          [this](PublishedImage& color, PublishedImage& depth) { publishPair(color, depth); },
          [this](ImageStream stream, PublishedImage& image) {
            publishSingle(stream == ImageStream::kColor ? StreamKind::kColor : StreamKind::kDepth,
                          image);
          }) {
  if (!registered_) {
    depth_calibration_ = std::make_unique<CameraCalibration>(
        ros::NodeHandle(node, "depth"), "depth", parameters.depth_camera_info_url);
  }
  advertise(std::move(node), registered_);
}

CameraPublisher::~CameraPublisher() {
  const std::lock_guard<std::mutex> lock(gate_->mutex);
  gate_->is_open = false;
}

void CameraPublisher::advertise(ros::NodeHandle node, bool registration) {
  image_transport::ImageTransport transport(node);
  const auto change = [this, gate = gate_] {
    const std::lock_guard<std::mutex> lock(gate->mutex);
    if (gate->is_open) {
      updateDemand();
    }
  };
  const auto image_change = [change](const image_transport::SingleSubscriberPublisher&) {
    change();
  };
  const auto info_change = [change](const ros::SingleSubscriberPublisher&) { change(); };
  const auto open = [&](const std::string& topic) {
    return transport.advertiseCamera(topic, kQueueSize, image_change, image_change, info_change,
                                     info_change);
  };
  // Somebody may subscribe before both publishers exist: that waits for the gate.
  const std::lock_guard<std::mutex> lock(gate_->mutex);
  color_publisher_ = open("rgb/image_raw");
  depth_publisher_ = open(registration ? "depth_registered/image_raw" : "depth/image_raw");
}

void CameraPublisher::updateDemand() {
  StreamDemand demand;
  demand.color = color_publisher_.getNumSubscribers() > 0;
  demand.depth = depth_publisher_.getNumSubscribers() > 0;
  color_wanted_ = demand.color;
  depth_wanted_ = demand.depth;
  on_demand_(demand);
}

void CameraPublisher::setDevice(const DeviceDescription& device) {
  color_calibration_.setDevice(device.serial, device.color_field_of_view);
  if (depth_calibration_) {
    depth_calibration_->setDevice(device.serial, device.depth_field_of_view);
  }
}

void CameraPublisher::setTimeOffsets(double color, double depth) {
  color_time_offset_ = color;
  depth_time_offset_ = depth;
}

void CameraPublisher::add(const ImageView& view, std::int64_t stamp) {
  const bool is_color = view.kind == StreamKind::kColor;
  sensor_msgs::ImagePtr message = toMessage(view);
  message->header.frame_id = is_color ? color_frame_ : depth_frame_;
  message->header.stamp = toRosTime(stamp);
  if (color_wanted_ && depth_wanted_) {
    pairer_.push(is_color ? ImageStream::kColor : ImageStream::kDepth,
                 static_cast<double>(view.device_stamp) / kMicrosecondsPerSecond,
                 {std::move(message), view.device_stamp});
  } else {
    pairer_.flush();
    publish(view.kind, message);
  }
}

void CameraPublisher::publishPair(const PublishedImage& color, const PublishedImage& depth) {
  const auto offset = static_cast<std::int64_t>(depth.device_stamp - color.device_stamp);
  if (static_cast<std::uint64_t>(std::abs(offset)) <= kSameExposure) {
    depth.message->header.stamp = color.message->header.stamp;
  }
  {
    const std::lock_guard<std::mutex> lock(statistics_mutex_);
    ++statistics_.pairs;
    statistics_.offset = static_cast<double>(offset) / kMicrosecondsPerSecond;
  }
  publish(StreamKind::kColor, color.message);
  publish(StreamKind::kDepth, depth.message);
}

void CameraPublisher::publishSingle(StreamKind kind, const PublishedImage& image) {
  publish(kind, image.message);
  const std::lock_guard<std::mutex> lock(statistics_mutex_);
  ++statistics_.singles;
}

void CameraPublisher::publish(StreamKind kind, const sensor_msgs::ImagePtr& image) {
  const bool is_color = kind == StreamKind::kColor;
  const double offset = is_color ? color_time_offset_ : depth_time_offset_;
  if (offset != 0.0) {
    image->header.stamp += ros::Duration(offset);
  }
  CameraCalibration& calibration =
      is_color || !depth_calibration_ ? color_calibration_ : *depth_calibration_;
  auto info = boost::make_shared<sensor_msgs::CameraInfo>(
      calibration.info(static_cast<int>(image->width), static_cast<int>(image->height)));
  info->header = image->header;
  (is_color ? color_publisher_ : depth_publisher_).publish(image, info);
}

PairStatistics CameraPublisher::statistics() const {
  const std::lock_guard<std::mutex> lock(statistics_mutex_);
  return statistics_;
}

}  // namespace mivo
