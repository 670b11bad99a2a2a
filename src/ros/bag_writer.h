// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sensor_msgs/CameraInfo.h>

#include <opencv2/core/mat.hpp>
#include <string>

#include "mivo/io/camera_file.h"
#include "mivo/trajectory/stamped_pose.h"
#include "ros/bag_topics.h"
#include "ros/output_bag.h"

namespace mivo {

/// How images are stored: as they are, or as PNG, which loses nothing, under the names of
/// image_transport's compressed topics.
enum class BagImages { kRaw, kCompressed };

/// Writes an RGB-D recording with the topics, encodings and frames of a layout. The static
/// transform from camera_link to the optical frame is part of it. The bag is complete once it is
/// closed.
class BagWriter {
 public:
  /// Throws Error when the bag exists and may not be replaced, or the camera has a distortion that
  /// images of this layout cannot have.
  BagWriter(const std::string& path, const BagLayout& layout, const SequenceCamera& camera,
            BagImages images, Overwrite overwrite);

  /// Writes the image and the calibration. `image`: 8 or 16 bits, gray or in the order blue, green,
  /// red; alpha is left out. Throws Error for another type, a wrong size, or when the disk is full.
  void writeColor(double stamp, const cv::Mat& image);

  /// `depth`: CV_16UC1 in the camera's depth units. Layouts with integer depth hold millimeters:
  /// other units are rounded. Throws Error as writeColor.
  void writeDepth(double stamp, const cv::Mat& depth);

  /// Writes the whole path on /ground_truth in the frame "world", latched. With a pose within 20 ms
  /// of `first_stamp`, the first color image's, the static transform from "world" to "odom" is
  /// written too, so that path and odometry lie upon each other; returns whether it was.
  bool writeGroundTruth(const Trajectory& truth, double first_stamp);

  /// Throws Error when the end could not be written.
  void close() { bag_.close(); }

 private:
  template <typename Message>
  void write(const std::string& topic, double stamp, const Message& message);
  template <typename Message>
  void writeLatched(const std::string& topic, double stamp, const Message& message);
  void writeStatic(double stamp, const std::string& parent, const std::string& child,
                   const Eigen::Isometry3d& T_parent_child);
  void checkImage(const cv::Mat& image, const char* what) const;

  BagLayout layout_;
  SequenceCamera camera_;
  BagImages images_;
  sensor_msgs::CameraInfo camera_info_;
  OutputBag bag_;
  bool has_static_ = false;
};

}  // namespace mivo
