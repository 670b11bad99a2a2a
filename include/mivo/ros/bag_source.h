// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <rosbag/bag.h>
#include <rosbag/message_instance.h>
#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Image.h>

#include <string>
#include <vector>

#include "mivo/io/frame_range.h"
#include "mivo/io/frame_source.h"
#include "mivo/ros/bag_topics.h"
#include "mivo/ros/image_conversion.h"

namespace mivo {

/// Frames of a bag: each colour image with the depth image nearest in time, less than 20 ms away,
/// as a sequence folder without associations gives them. Read message by message, never the whole
/// bag.
class BagSource : public FrameSource {
 public:
  /// @param wanted  topics; empty names are looked for (findTopics)
  /// Throws Error when the bag cannot be read, has not these topics, no usable calibration, no
  /// pair, or no frame in the range.
  BagSource(const std::string& path, const RgbdTopics& wanted, const FrameRange& range = {});

  const Camera& camera() const override { return camera_; }
  std::size_t size() const override { return pairs_.size(); }

  /// The images of the frame refer to the bag's messages, which live until the next call. A frame
  /// is skipped when one of its messages is malformed.
  Status next(Frame& frame, std::string& fault) override;

  const RgbdTopics& topics() const { return topics_; }

  /// One image message of the bag.
  struct Message {
    double stamp;  ///< s, of its header
    rosbag::MessageInstance instance;
  };

  /// A pair, for those who need the messages themselves.
  struct Pair {
    Message colour;
    Message depth;
  };
  const std::vector<Pair>& pairs() const { return pairs_; }

 private:
  void findPairs(const FrameRange& range);
  void readCamera();
  std::vector<Message> readIndex(const std::string& topic) const;

  std::string path_;
  rosbag::Bag bag_;
  RgbdTopics topics_;
  Camera camera_;
  std::vector<Pair> pairs_;
  std::size_t next_ = 0;
  // Keep the pixels of the last frame alive.
  boost::shared_ptr<const sensor_msgs::Image> colour_;
  boost::shared_ptr<const sensor_msgs::Image> depth_;
};

/// Whether a message is compressed.
bool isCompressed(const rosbag::MessageInstance& message);

}  // namespace mivo
