// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <message_filters/sync_policies/approximate_time.h>
#include <message_filters/sync_policies/exact_time.h>
#include <message_filters/synchronizer.h>
#include <ros/node_handle.h>

#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "ros/image_port.h"
#include "ros/node_parameters.h"
#include "ros/stamp_gap.h"

namespace mivo {

/// What has come in on one topic.
struct InputCount {
  std::string topic;
  std::uint32_t publishers = 0;
  std::uint64_t messages = 0;
  ros::Time last_stamp;        ///< of the header
  ros::WallTime last_arrival;  ///< zero: nothing yet
};

/// Subscribes to colour, depth and calibration, and pairs them by their stamps. All calls of ROS
/// come from one thread, the queue's of the node handle; the other functions may be called from
/// any.
class FrameInput {
 public:
  using PairCallback = std::function<void(const ImagePair&)>;

  /// Throws Error when a transport cannot be used.
  FrameInput(const ros::NodeHandle& private_node, const NodeParameters& parameters,
             PairCallback callback);

  /// Ends the subscriptions. What was waiting for a better partner is delivered, so that a bag's
  /// last frame is not lost. To be called when the queue's thread has stopped.
  void stop();

  /// One line that says which input is silent, or why none of the images fit together, when no pair
  /// has come for a while and it was not said lately; otherwise an empty text.
  std::string silence();

  /// Colour, depth, calibration.
  std::vector<InputCount> counts() const;

  const std::string& colourTopic() const { return colour_.topic(); }

 private:
  using Approximate = message_filters::sync_policies::ApproximateTime<ImageMessage, ImageMessage>;
  using Exact = message_filters::sync_policies::ExactTime<ImageMessage, ImageMessage>;

  struct Waiting {
    std::deque<ImageMessageConstPtr> messages;  // since the last pair
    InputCount count;
    StampGap gap;
  };

  void observe(const ImageMessageConstPtr& message, Waiting& waiting);
  void connect();
  void expect(int input, Waiting& waiting, const ros::Time& stamp);
  void takePair(const ImageMessageConstPtr& colour, const ImageMessageConstPtr& depth);
  void takeCameraInfo(const sensor_msgs::CameraInfoConstPtr& message);
  void deliverWaiting();
  void deliver(ImagePair pair);
  void watch();
  std::string explain(double seconds) const;

  NodeParameters parameters_;
  PairCallback callback_;
  ImagePort colour_;
  ImagePort depth_;
  // Behind the ports, from which they disconnect when they are destroyed.
  std::unique_ptr<message_filters::Synchronizer<Approximate>> approximate_;
  std::unique_ptr<message_filters::Synchronizer<Exact>> exact_;
  ros::Subscriber camera_info_subscriber_;
  ros::WallTimer timer_;

  mutable std::mutex mutex_;  // guards what follows
  Waiting waiting_colour_;
  Waiting waiting_depth_;
  InputCount camera_info_count_;
  sensor_msgs::CameraInfoConstPtr camera_info_;
  std::vector<ImagePair> early_;  // pairs that came before the calibration
  ros::WallTime last_pair_;
  double next_warning_;  // s of silence
};

}  // namespace mivo
