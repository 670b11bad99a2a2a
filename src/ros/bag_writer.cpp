// SPDX-License-Identifier: BSD-3-Clause
#include "ros/bag_writer.h"

#include <nav_msgs/Path.h>
#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/image_encodings.h>
#include <tf2_msgs/TFMessage.h>

#include <algorithm>
#include <boost/make_shared.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "mivo/core/error.h"
#include "mivo/io/output_file.h"
#include "ros/camera_conversion.h"
#include "ros/pose_conversion.h"
#include "ros/stamp.h"
#include "ros/topics.h"

namespace mivo {
namespace {

namespace encodings = sensor_msgs::image_encodings;

constexpr double kMaxPairDifference = 0.02;  // s
constexpr std::size_t kDepthHeaderBytes = 12;

/// Optical frame (z forward) in the body frame of the camera (x forward, z up), REP 103.
Eigen::Isometry3d opticalInLink() {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() << 0.0, 0.0, 1.0, -1.0, 0.0, 0.0, 0.0, -1.0, 0.0;
  return T;
}

sensor_msgs::Image toRaw(const std_msgs::Header& header, const cv::Mat& image,
                         const std::string& encoding) {
  sensor_msgs::Image message;
  message.header = header;
  message.height = static_cast<std::uint32_t>(image.rows);
  message.width = static_cast<std::uint32_t>(image.cols);
  message.encoding = encoding;
  message.step = static_cast<std::uint32_t>(image.cols * image.elemSize());
  message.data.reserve(static_cast<std::size_t>(message.step) * message.height);
  for (int y = 0; y < image.rows; ++y) {
    const std::uint8_t* row = image.ptr(y);
    message.data.insert(message.data.end(), row, row + message.step);
  }
  return message;
}

/// PNG behind `header_bytes` zero bytes.
sensor_msgs::CompressedImage toPng(const std_msgs::Header& header, const cv::Mat& image,
                                   const std::string& format, std::size_t header_bytes) {
  sensor_msgs::CompressedImage message;
  message.header = header;
  message.format = format;
  std::vector<std::uint8_t> png;
  if (!cv::imencode(".png", image, png)) throw Error("an image could not be encoded as PNG");
  message.data.assign(header_bytes, 0);
  message.data.insert(message.data.end(), png.begin(), png.end());
  return message;
}

/// Meters, by the rule of the tracker for integer depth: both give the same bits.
cv::Mat toMeters(const cv::Mat& depth, double unit) {
  cv::Mat meters(depth.size(), CV_32FC1);
  for (int y = 0; y < depth.rows; ++y) {
    for (int x = 0; x < depth.cols; ++x) {
      const std::uint16_t raw = depth.at<std::uint16_t>(y, x);
      meters.at<float>(y, x) = raw == 0 ? std::numeric_limits<float>::quiet_NaN()
                                        : static_cast<float>(raw) * static_cast<float>(unit);
    }
  }
  return meters;
}

cv::Mat withoutAlpha(const cv::Mat& image) {
  if (image.channels() != 4) return image;
  cv::Mat color;
  cv::cvtColor(image, color, cv::COLOR_BGRA2BGR);
  return color;
}

/// Under which an image in the order blue, green, red is stored; empty: none.
std::string encodingOf(const cv::Mat& image) {
  switch (image.type()) {
    case CV_8UC1:
      return encodings::MONO8;
    case CV_16UC1:
      return encodings::MONO16;
    case CV_8UC3:
      return encodings::RGB8;
    case CV_16UC3:
      return encodings::RGB16;
    default:
      return {};
  }
}

/// Of the channels of a PNG, as image_transport names it.
std::string storedOrder(const std::string& encoding) {
  return encoding == encodings::RGB8 ? "bgr8" : encoding == encodings::RGB16 ? "bgr16" : "";
}

/// The path, when a bag with this camera may be written there. Throws Error.
const std::string& checkedPath(const std::string& path, const BagLayout& layout,
                               const Camera& camera, Overwrite overwrite) {
  camera.validate();
  if (layout.rectified && !camera.distortion.isZero()) {
    throw Error("layout " + layout.name +
                " has rectified images, but the camera has distortion; choose another layout");
  }
  refuseExisting(path, overwrite);
  return path;
}

}  // namespace

BagWriter::BagWriter(const std::string& path, const BagLayout& layout, const SequenceCamera& camera,
                     BagImages images, Overwrite overwrite)
    : layout_(layout),
      camera_(camera),
      images_(images),
      camera_info_(toCameraInfo(camera.camera)),
      bag_(checkedPath(path, layout, camera.camera, overwrite)) {
  camera_info_.header.frame_id = layout.optical_frame;
}

template <typename Message>
void BagWriter::write(const std::string& topic, double stamp, const Message& message) {
  // A bag cannot hold a receipt time of zero, though a stamp may be zero.
  bag_.write(topic, std::max(toTime(stamp), ros::TIME_MIN), message);
}

template <typename Message>
void BagWriter::writeLatched(const std::string& topic, double stamp, const Message& message) {
  const auto header = boost::make_shared<ros::M_string>();
  (*header)["topic"] = topic;
  (*header)["type"] = ros::message_traits::DataType<Message>::value();
  (*header)["md5sum"] = ros::message_traits::MD5Sum<Message>::value();
  (*header)["message_definition"] = ros::message_traits::Definition<Message>::value();
  (*header)["latching"] = "1";
  (*header)["callerid"] = "/mivo";
  bag_.write(topic, std::max(toTime(stamp), ros::TIME_MIN), message, header);
}

void BagWriter::writeStatic(double stamp, const std::string& parent, const std::string& child,
                            const Eigen::Isometry3d& T_parent_child) {
  geometry_msgs::TransformStamped transform;
  transform.header.stamp = toTime(stamp);
  transform.header.frame_id = parent;
  transform.child_frame_id = child;
  transform.transform = toTransform(T_parent_child);
  tf2_msgs::TFMessage message;
  message.transforms.push_back(transform);
  writeLatched(topics::kStaticTransforms, stamp, message);
}

void BagWriter::checkImage(const cv::Mat& image, const char* what) const {
  if (image.cols == camera_.camera.width && image.rows == camera_.camera.height) return;
  throw Error(std::string(what) + " has " + std::to_string(image.cols) + " x " +
              std::to_string(image.rows) + " pixels, but the camera " +
              std::to_string(camera_.camera.width) + " x " + std::to_string(camera_.camera.height));
}

void BagWriter::writeColor(double stamp, const cv::Mat& with_alpha) {
  checkImage(with_alpha, "the color image");
  const cv::Mat image = withoutAlpha(with_alpha);
  const std::string encoding = encodingOf(image);
  if (encoding.empty()) {
    throw Error("the color image has neither one channel nor three, or not 8 or 16 bits");
  }
  if (!has_static_) {
    writeStatic(stamp, frames::kCameraLink, layout_.optical_frame, opticalInLink());
    has_static_ = true;
  }
  std_msgs::Header header;
  header.stamp = toTime(stamp);
  header.frame_id = layout_.optical_frame;
  camera_info_.header = header;
  write(layout_.topics.camera_info, stamp, camera_info_);
  if (images_ == BagImages::kCompressed) {
    write(layout_.topics.color + "/compressed", stamp,
          toPng(header, image, encoding + "; png compressed " + storedOrder(encoding), 0));
    return;
  }
  cv::Mat stored = image;
  if (image.channels() == 3) cv::cvtColor(image, stored, cv::COLOR_BGR2RGB);
  write(layout_.topics.color, stamp, toRaw(header, stored, encoding));
}

void BagWriter::writeDepth(double stamp, const cv::Mat& depth) {
  checkImage(depth, "the depth image");
  if (depth.type() != CV_16UC1) throw Error("the depth image has not 16 bits");
  std_msgs::Header header;
  header.stamp = toTime(stamp);
  header.frame_id = layout_.optical_frame;
  const double unit = 1.0 / camera_.depth_units_per_meter;
  if (layout_.float_depth && images_ == BagImages::kRaw) {
    write(layout_.topics.depth, stamp, toRaw(header, toMeters(depth, unit), encodings::TYPE_32FC1));
    return;
  }
  cv::Mat millimeters = depth;
  constexpr double kMillimetersPerMeter = 1000.0;
  if (camera_.depth_units_per_meter != kMillimetersPerMeter) {
    depth.convertTo(millimeters, CV_16U, unit * kMillimetersPerMeter);
  }
  if (images_ == BagImages::kCompressed) {
    write(layout_.topics.depth + "/compressedDepth", stamp,
          toPng(header, millimeters, "16UC1; compressedDepth", kDepthHeaderBytes));
    return;
  }
  write(layout_.topics.depth, stamp, toRaw(header, millimeters, encodings::TYPE_16UC1));
}

bool BagWriter::writeGroundTruth(const Trajectory& truth, double first_stamp) {
  nav_msgs::Path path;
  path.header.frame_id = frames::kWorld;
  path.header.stamp = toTime(first_stamp);
  for (const StampedPose& pose : truth) {
    geometry_msgs::PoseStamped stamped;
    stamped.header.frame_id = frames::kWorld;
    stamped.header.stamp = toTime(pose.stamp);
    stamped.pose = toPose(pose.pose);
    path.poses.push_back(stamped);
  }
  writeLatched(topics::kGroundTruth, first_stamp, path);

  const auto nearest =
      std::min_element(truth.begin(), truth.end(), [&](const StampedPose& a, const StampedPose& b) {
        return std::abs(a.stamp - first_stamp) < std::abs(b.stamp - first_stamp);
      });
  if (nearest == truth.end() || std::abs(nearest->stamp - first_stamp) >= kMaxPairDifference) {
    return false;
  }
  writeStatic(first_stamp, frames::kWorld, frames::kOdometry,
              nearest->pose * opticalInLink().inverse());
  return true;
}

}  // namespace mivo
