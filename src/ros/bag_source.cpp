// SPDX-License-Identifier: BSD-3-Clause
#include "ros/bag_source.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nav_msgs/Path.h>
#include <sensor_msgs/CameraInfo.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/camera_doubt.h"
#include "mivo/core/error.h"
#include "ros/camera_conversion.h"
#include "ros/clock_fault.h"
#include "ros/depth_geometry.h"
#include "ros/header_only.h"
#include "ros/pose_conversion.h"
#include "ros/stamp.h"
#include "ros/topics.h"
#include "session/median.h"
#include "session/stamp_order.h"

namespace mivo {
namespace {

// Images that are looked at, one after the other, until one can be read.
constexpr std::size_t kMostUnreadable = 100;

/// rosbag could not read a message that its index names.
struct DamagedBag {};

ImageMessageConstPtr readImage(const RecordedMessage& message) {
  if (message.is<sensor_msgs::CompressedImage>()) {
    return wrap(message.read<sensor_msgs::CompressedImage>());
  }
  return wrap(message.read<sensor_msgs::Image>());
}

}  // namespace

/// The image messages of a recording.
struct BagSource::Index {
  std::vector<StreamedImage> images;  // in the order in which they were recorded
  std::size_t damaged = 0;
  std::optional<double> clock_offset;

  std::vector<double> stamps(ImageStream stream) const {
    std::vector<double> stamps;
    for (const StreamedImage& image : images) {
      if (image.stream == stream) stamps.push_back(image.image.stamp);
    }
    return stamps;
  }
};

BagSource::BagSource(const std::vector<std::string>& paths, const RgbdTopics& wanted,
                     const FrameRange& range) {
  try {
    open(paths, wanted, Recording::Reader::kIndexed);
  } catch (const DamagedBag&) {
    open(paths, wanted, Recording::Reader::kSalvage);
  }
  try {
    findDepthGeometry(!wanted.depth.empty());
    take(range);
    frames_ = std::make_unique<FrameMaker>(isRectifiedTopic(topics_.color));
    camera_ = toCamera(*calibrations_.at(pairs_.front().color.stamp),
                       isRectifiedTopic(topics_.color), sizeOfColor());
    tell(doubtOf(camera_));
  } catch (const std::exception& error) {
    throw Error(recording_->name() + ": " + error.what());
  }
}

void BagSource::open(const std::vector<std::string>& paths, const RgbdTopics& wanted,
                     Recording::Reader reader) {
  recording_ = std::make_unique<Recording>(paths, reader);
  calibrations_ = {};
  depth_calibrations_ = {};
  pairs_.clear();
  left_out_.clear();
  notice_.clear();
  tell(recording_->damage());
  try {
    topics_ = findTopics(recording_->contents(), wanted);
    const std::set<std::string> others = otherCameras(recording_->contents(), topics_);
    if (!others.empty()) {
      tell(fmt::format("{} and {} are taken; --rgb and --depth choose another camera: {}",
                       topics_.color, topics_.depth, fmt::join(others, ", ")));
    }
    findPairs(readIndex(reader));
  } catch (const std::exception& error) {
    throw Error(recording_->name() + ": " + error.what());
  }
}

BagSource::Index BagSource::readIndex(Recording::Reader reader) {
  Index index;
  ClockOffset clock_offset;
  std::vector<std::string> topics = {topics_.color, topics_.depth, topics_.camera_info};
  if (!topics_.depth_info.empty()) topics.push_back(topics_.depth_info);
  for (const RecordedMessage& message : recording_->messages(topics)) {
    try {
      const double stamp = toSeconds(message.read<HeaderOnly>()->header.stamp);
      if (message.topic() == topics_.camera_info) {
        calibrations_.add(stamp, message.read<sensor_msgs::CameraInfo>());
        continue;
      }
      if (message.topic() == topics_.depth_info) {
        depth_calibrations_.add(stamp, message.read<sensor_msgs::CameraInfo>());
        continue;
      }
      const ImageStream stream =
          message.topic() == topics_.color ? ImageStream::kColor : ImageStream::kDepth;
      clock_offset.add(stream, stamp, toSeconds(message.time()));
      index.images.push_back({stream, {stamp, message}});
    } catch (const Error&) {
      throw;  // another type than the topic should have
    } catch (const std::exception&) {
      if (reader == Recording::Reader::kIndexed) throw DamagedBag();
      ++index.damaged;
    }
  }
  index.clock_offset = clock_offset.seconds();
  return index;
}

/// Of the first frame that can be read: what is damaged costs its frame, not the recording.
template <typename Read>
auto BagSource::ofFirstReadable(const Read& read) const {
  std::string fault;
  for (std::size_t i = 0; i < std::min(pairs_.size(), kMostUnreadable); ++i) {
    try {
      return read(pairs_[i]);
    } catch (const std::exception& error) {
      if (fault.empty()) fault = error.what();
    }
  }
  throw Error(fault);
}

cv::Size BagSource::sizeOfColor() const {
  if (!clock_fault_.empty()) throw Error(clock_fault_);
  return ofFirstReadable(
      [](const Pair& pair) { return readImage(pair.color.recorded)->toColorImage().image.size(); });
}

void BagSource::tell(const std::string& text) {
  if (!text.empty()) notice_ += (notice_.empty() ? "" : "; ") + text;
}

void BagSource::findPairs(const Index& index) {
  if (calibrations_.empty()) {
    throw Error(calibrations_.sawUncalibrated()
                    ? "camera_info is not calibrated: all messages on " + topics_.camera_info +
                          " are zero; set the camera's calibration file"
                    : "there is no message on the topic " + topics_.camera_info);
  }
  for (const ImageStream stream : {ImageStream::kColor, ImageStream::kDepth}) {
    const std::vector<double> stamps = index.stamps(stream);
    const bool is_same = std::all_of(stamps.begin(), stamps.end(),
                                     [&](double stamp) { return stamp == stamps.front(); });
    if (stamps.size() < 2 || !is_same) continue;
    try {
      refuseEqualStamps(stamps.size(), stamps.front());
    } catch (const Error& error) {
      throw Error("the images on " +
                  (stream == ImageStream::kColor ? topics_.color : topics_.depth) + ": " +
                  error.what());
    }
  }
  clock_offset_ = index.clock_offset;
  if (index.clock_offset) clock_fault_ = describeClockFault(*index.clock_offset);
  BagPairs found = pairImages(index.images);
  pairs_ = std::move(found.pairs);
  left_out_ = std::move(found.left_out);
  if (index.damaged > 0) left_out_["damaged message"] = index.damaged;
  if (found.is_sorted_anew) {
    tell("the images were recorded in another order than that of their stamps, and are sorted");
  }
  requirePairs(index);
  tell(describePairOffset(pairOffset()));
}

double BagSource::pairOffset() const {
  std::vector<double> offsets;
  for (const Pair& pair : pairs_) offsets.push_back(pair.depth.stamp - pair.color.stamp);
  return medianOf(std::move(offsets));
}

void BagSource::requirePairs(const Index& index) const {
  if (!pairs_.empty()) return;
  const std::string offset = index.clock_offset
                                 ? "; depth that comes with a color image is stamped " +
                                       std::to_string(*index.clock_offset) + " s later"
                                 : "";
  throw Error("no depth image is within 20 ms of a color image (" +
              std::to_string(index.stamps(ImageStream::kColor).size()) + " color images on " +
              topics_.color + ", " + std::to_string(index.stamps(ImageStream::kDepth).size()) +
              " depth images on " + topics_.depth + ")" + offset);
}

void BagSource::take(const FrameRange& range) {
  if (range.count == 0 || range.start >= pairs_.size()) {
    throw Error("no frame left: there are " + std::to_string(pairs_.size()) +
                ", numbered from 0, and frames from " + std::to_string(range.start) +
                " on were asked for");
  }
  const std::size_t end = range.start + std::min(range.count, pairs_.size() - range.start);
  pairs_.erase(pairs_.begin() + static_cast<std::ptrdiff_t>(end), pairs_.end());
  pairs_.erase(pairs_.begin(), pairs_.begin() + static_cast<std::ptrdiff_t>(range.start));
}

/// @param is_depth_chosen  the topic of depth was named by the user, who may know better
void BagSource::findDepthGeometry(bool is_depth_chosen) {
  T_color_depth_.reset();
  const Pair& pair = pairs_.front();
  const std::string color = pair.color.recorded.read<HeaderOnly>()->header.frame_id;
  const std::string depth = pair.depth.recorded.read<HeaderOnly>()->header.frame_id;
  if (!isUnregistered(color, depth, topics_.depth)) return;
  T_color_depth_ = findTransform(*recording_, color, depth);
  if (T_color_depth_ && !depth_calibrations_.empty()) {
    tell("depth on " + topics_.depth + " is registered to color here");
    return;
  }
  const std::string missing = describeMissingGeometry(color, depth, cameraInfoBeside(topics_.depth),
                                                      !depth_calibrations_.empty());
  if (!is_depth_chosen)
    throw Error(missing + "; if it is registered all the same, say --depth " + topics_.depth);
  T_color_depth_.reset();
  tell(missing + "; it is taken as registered");
}

ImagePair BagSource::messagesOf(const Pair& pair) {
  if (!clock_fault_.empty()) throw Error(clock_fault_);
  ImagePair messages;
  messages.color = readImage(pair.color.recorded);
  messages.depth = readImage(pair.depth.recorded);
  messages.camera_info = calibrations_.at(pair.color.stamp);
  if (T_color_depth_) {
    messages.depth_geometry =
        DepthGeometry{depth_calibrations_.at(pair.depth.stamp), *T_color_depth_};
  }
  return messages;
}

MessageImages BagSource::read(const Pair& pair) {
  last_ = messagesOf(pair);
  return frames_->read(last_);
}

FrameSource::Status BagSource::next(Frame& frame, FrameFault& fault) {
  if (next_ >= pairs_.size()) return Status::kEnd;
  const Pair& pair = pairs_[next_++];
  starts_anew_ = starts_anew_after_fault_ || pair.is_new_time;
  try {
    last_ = messagesOf(pair);
    const MessageFrame message = frames_->make(last_);
    camera_ = message.camera;
    frame = message.frame;
    starts_anew_after_fault_ = false;
    return Status::kFrame;
  } catch (const std::exception& error) {
    fault.reason = error.what();
  }
  starts_anew_after_fault_ = starts_anew_;
  fault.text = recording_->name() + ", frame of stamp " + std::to_string(pair.color.stamp) + ": " +
               fault.reason;
  return Status::kSkipped;
}

double BagSource::depthUnitsPerMeter() const {
  constexpr double kMillimeters = 1000.0;
  constexpr double kOfMeters = 5000.0;
  const int type = ofFirstReadable(
      [](const Pair& pair) { return readImage(pair.depth.recorded)->toDepthImage().image.type(); });
  return type == CV_16UC1 ? kMillimeters : kOfMeters;
}

Trajectory BagSource::groundTruth() const {
  Trajectory truth;
  for (const RecordedMessage& message : recording_->messages({topics::kGroundTruth})) {
    if (!message.is<nav_msgs::Path>()) continue;
    const auto path = message.read<nav_msgs::Path>();
    for (const geometry_msgs::PoseStamped& pose : path->poses) {
      truth.push_back({toSeconds(pose.header.stamp), toIsometry(pose.pose)});
    }
    break;
  }
  return truth;
}

}  // namespace mivo
