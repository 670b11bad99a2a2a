// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/node_handle.h>

#include <array>
#include <deque>
#include <functional>
#include <mutex>
#include <string>
#include <vector>

#include "ros/calibration_history.h"
#include "ros/frame_queue.h"
#include "ros/image_port.h"
#include "ros/node_parameters.h"
#include "session/clock_offset.h"
#include "session/stamp_pairer.h"

namespace mivo {

/// Statistics of one topic.
struct InputCount {
  std::string topic;
  std::uint32_t publishers = 0;
  std::uint64_t messages = 0;
  std::uint64_t without_partner = 0;  ///< images without a partner
  ros::Time last_stamp;               ///< of the header
  ros::WallTime last_arrival;         ///< zero: nothing yet
};

/// Subscribes to color, depth and calibration, and pairs them by their stamps. ROS callbacks run
/// in one thread, that of the node handle's queue; the other functions may be called from any
/// thread.
class FrameInput {
 public:
  using PairCallback = std::function<void(const ImagePair&)>;

  /// Throws Error when a transport cannot be used.
  FrameInput(const ros::NodeHandle& private_node, const NodeParameters& parameters,
             PairCallback callback);

  /// Ends the subscriptions and delivers waiting pairs, so that the last frame of a bag is not
  /// lost. Call it after the queue's thread has stopped.
  void stop();

  /// A line that names the silent input, or says why images do not pair, if no pair has arrived for
  /// a while and this was not reported recently; otherwise empty.
  std::string silence();

  /// Color, depth, calibration.
  std::vector<InputCount> counts() const;

  const std::string& colorTopic() const { return color_.topic(); }
  const std::string& depthTopic() const { return depth_.topic(); }

 private:
  void take(ImageStream stream, const ImageMessageConstPtr& message);
  void takeCameraInfo(const sensor_msgs::CameraInfoConstPtr& message);
  void takeDepthInfo(const sensor_msgs::CameraInfoConstPtr& message);
  void deliver(ImagePair pair);
  void giveOut(bool at_once);
  bool expectsCalibration(const ros::Time& stamp) const;
  bool expectsDepthCalibration(const ImagePair& pair) const;
  void complete(ImagePair pair);
  void keepEarly(ImagePair pair);
  void countSingle(ImageStream stream);
  void watch();
  std::string explain(double seconds) const;
  InputCount& countOf(ImageStream stream) {
    return image_counts_[static_cast<std::size_t>(stream)];
  }
  const InputCount& countOf(ImageStream stream) const {
    return image_counts_[static_cast<std::size_t>(stream)];
  }

  NodeParameters parameters_;
  PairCallback callback_;
  StampPairer<ImageMessageConstPtr> pairer_;  // used by the queue's thread only
  ImagePort color_;
  ImagePort depth_;
  ros::Subscriber camera_info_subscriber_;
  ros::Subscriber depth_info_subscriber_;
  ros::WallTimer timer_;

  std::deque<ImagePair> waiting_;    // for the calibration of their own stamp; the thread's own
  ros::Time last_given_;             // stamp of the last pair that had it
  FrameQueue<ImagePair> early_;      // pairs that arrived before the calibration
  std::uint64_t messages_seen_ = 0;  // at the last look of watch()
  int idle_looks_ = 0;

  mutable std::mutex mutex_;  // guards what follows
  std::array<InputCount, 2> image_counts_;
  InputCount camera_info_count_;
  CalibrationHistory calibrations_;
  CalibrationHistory depth_calibrations_;
  ClockOffset clock_offset_;
  ros::WallTime last_pair_;
  double next_warning_;  // s of silence
};

}  // namespace mivo
