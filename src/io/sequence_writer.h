// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>

#include "mivo/io/camera_file.h"
#include "mivo/io/trajectory_io.h"
#include "mivo/trajectory/stamped_pose.h"

namespace mivo {

/// Writes a sequence folder that SequenceReader reads: images, rgb.txt, depth.txt,
/// associations.txt, camera.txt and, once there is a pose, groundtruth.txt. After each call the
/// folder is complete.
class SequenceWriter {
 public:
  /// Creates the folder (and those above it). Throws Error when it holds a sequence already and may
  /// not be replaced, or when the camera is invalid. What is replaced is removed first: the lists,
  /// rgb/*.png and depth/*.png, nothing else.
  SequenceWriter(const std::string& folder, const SequenceCamera& camera, Overwrite overwrite);

  /// @param stamp        s; frames must come in the order of their stamps, 1 us apart at least
  /// @param image        CV_8UC1 or CV_16UC1, or CV_8UC3 in the order blue, green, red
  /// @param depth_stamp  s, of the depth image
  /// @param depth        same size; CV_16UC1 in the camera's depth units, or CV_32FC1 in meters,
  ///                     which is rounded; what is not finite, not positive or beyond the range of
  ///                     16 bits becomes 0, no reading
  /// Throws Error for anything else, and when a file cannot be written.
  void writeFrame(double stamp, const cv::Mat& image, double depth_stamp, const cv::Mat& depth);

  /// A pose of the ground truth; they need not have the stamps of frames.
  void writePose(const StampedPose& pose);

 private:
  void removeOld() const;
  cv::Mat storedDepth(const cv::Mat& depth) const;

  std::string folder_;
  SequenceCamera camera_;
  std::optional<OutputFile> images_;
  std::optional<OutputFile> depths_;
  std::optional<OutputFile> associations_;
  std::optional<TrajectoryWriter> truth_;
  std::string last_image_;  // names of the last files: a second one of the same name is refused
  std::string last_depth_;
  double last_stamp_;
};

}  // namespace mivo
