// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <rosbag/bag.h>
#include <rosbag/message_instance.h>

#include <string>
#include <vector>

#include "mivo/io/frame_range.h"
#include "mivo/io/frame_source.h"
#include "mivo/trajectory/stamped_pose.h"
#include "ros/bag_topics.h"
#include "ros/image_message.h"

namespace mivo {

/// Frames of a bag: each colour image with the depth image nearest in time, 20 ms away at most, as
/// a sequence folder without associations gives them. Read message by message, never the whole
/// bag.
class BagSource : public FrameSource {
 public:
  /// @param wanted  topics; empty names are looked for (findTopics)
  /// Throws Error when the bag cannot be read, has not these topics, no usable calibration, no
  /// pair, no frame in the range, or when all stamps of a topic are the same.
  BagSource(const std::string& path, const RgbdTopics& wanted, const FrameRange& range = {});

  const Camera& camera() const override { return camera_; }
  std::size_t size() const override { return pairs_.size(); }

  /// The images of the frame refer to the bag's messages, which live until the next call. A frame
  /// is skipped when one of its messages is malformed.
  Status next(Frame& frame, FrameFault& fault) override;

  std::string depthUnit() const override { return "16UC1 is millimetres, 32FC1 metres"; }
  const std::string& notice() const override { return notice_; }

  const RgbdTopics& topics() const { return topics_; }

  /// One image message of the bag.
  struct Message {
    double stamp;  ///< s, of its header
    rosbag::MessageInstance instance;
  };

  struct Pair {
    Message colour;
    Message depth;
  };
  const std::vector<Pair>& pairs() const { return pairs_; }

  /// Images of one pair, for those who want more than a Frame. They refer to messages that live
  /// until the next call.
  struct Images {
    ColourImage colour;
    DepthImage depth;
  };
  /// Throws Error when a message is malformed.
  Images read(const Pair& pair);

  /// 1000 for depth in millimetres. Depth in metres has no unit of its own: 5000, as TUM stores it.
  double depthUnitsPerMetre() const;

  /// Path of the topic /ground_truth; empty when there is none.
  Trajectory groundTruth() const;

 private:
  void findPairs(const FrameRange& range);
  void readCamera();
  std::vector<Message> readIndex(const std::string& topic);

  std::string path_;
  rosbag::Bag bag_;
  RgbdTopics topics_;
  Camera camera_;
  std::string notice_;
  std::vector<Pair> pairs_;
  std::size_t next_ = 0;
  // Keep the pixels of the last frame alive.
  ImageMessageConstPtr colour_;
  ImageMessageConstPtr depth_;
};

}  // namespace mivo
