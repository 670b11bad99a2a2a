// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "io/depth_account.h"
#include "mivo/io/frame_range.h"
#include "mivo/io/frame_source.h"
#include "mivo/trajectory/stamped_pose.h"
#include "ros/bag_pairs.h"
#include "ros/bag_topics.h"
#include "ros/calibration_history.h"
#include "ros/message_frame.h"
#include "ros/recording.h"

namespace mivo {

/// Frames of one bag, or of several that were recorded together: each color image with the depth
/// image nearest in time, 20 ms away at most, in the order in which they were recorded and by the
/// rules of the node (StampPairer, FrameOrder). Read message by message, never the whole bag.
class BagSource : public FrameSource {
 public:
  /// @param wanted  topics; empty names are looked for (findTopics)
  /// Throws Error when a bag cannot be read, has not these topics, no usable calibration, no
  /// pair, no frame in the range, or when all stamps of a topic are the same.
  BagSource(const std::vector<std::string>& paths, const RgbdTopics& wanted,
            const FrameRange& range = {});
  BagSource(const std::string& path, const RgbdTopics& wanted, const FrameRange& range = {})
      : BagSource(std::vector<std::string>{path}, wanted, range) {}

  const Camera& camera() const override { return camera_; }
  std::size_t size() const override { return pairs_.size(); }

  /// The images of the frame refer to the bag's messages, which live until the next call. A frame
  /// is skipped when one of its messages is malformed.
  Status next(Frame& frame, FrameFault& fault) override;
  bool startsAnew() const override { return starts_anew_; }

  std::string depthUnit() const override { return kDepthUnitOfMessages; }
  const std::string& notice() const override { return notice_; }
  const std::map<std::string, std::size_t>& leftOut() const override { return left_out_; }

  const RgbdTopics& topics() const { return topics_; }
  const Recording& recording() const { return *recording_; }

  /// s, stamp of depth minus that of color in a pair, the median.
  double pairOffset() const;
  /// s, see ClockOffset; nothing when it cannot be told.
  std::optional<double> clockOffset() const { return clock_offset_; }
  /// How many of color differ.
  std::size_t calibrations() const { return calibrations_.size(); }

  /// Leaves out the frame that next() would read.
  void passOver() { ++next_; }

  using Pair = BagPair;
  const std::vector<Pair>& pairs() const { return pairs_; }

  /// Images of one pair, for those who want more than a Frame. They refer to messages that live
  /// until the next call. Throws Error when a message is malformed.
  MessageImages read(const Pair& pair);
  /// Of the colors of a pair, as the tracker sees them.
  cv::Mat toGray(const ColorImage& color) { return frames_->toGray(color); }

  /// 1000 for depth in millimeters. Depth in meters has no unit of its own: 5000, as TUM stores it.
  double depthUnitsPerMeter() const;

  /// Path of the topic /ground_truth; empty when there is none.
  Trajectory groundTruth() const;

 private:
  struct Index;

  void open(const std::vector<std::string>& paths, const RgbdTopics& wanted,
            Recording::Reader reader);
  Index readIndex(Recording::Reader reader);
  template <typename Read>
  auto ofFirstReadable(const Read& read) const;
  cv::Size sizeOfColor() const;
  void findPairs(const Index& index);
  void requirePairs(const Index& index) const;
  void take(const FrameRange& range);
  void tell(const std::string& text);
  void findDepthGeometry(bool is_depth_chosen);
  ImagePair messagesOf(const Pair& pair);

  std::unique_ptr<Recording> recording_;
  RgbdTopics topics_;
  CalibrationHistory calibrations_;
  CalibrationHistory depth_calibrations_;
  std::optional<Eigen::Isometry3d> T_color_depth_;  // of depth that has to be registered
  std::unique_ptr<FrameMaker> frames_;
  Camera camera_;
  std::string notice_;
  std::map<std::string, std::size_t> left_out_;
  std::vector<Pair> pairs_;
  std::size_t next_ = 0;
  bool starts_anew_ = false;
  bool starts_anew_after_fault_ = false;  // the frame before which time was set back was skipped
  std::optional<double> clock_offset_;
  std::string clock_fault_;  // why no pair can be believed; empty: nothing
  ImagePair last_;           // keeps the pixels of the last frame alive
};

}  // namespace mivo
