// SPDX-License-Identifier: BSD-3-Clause
#include "ros/bag_source.h"

#include <nav_msgs/Path.h>
#include <rosbag/view.h>
#include <sensor_msgs/CameraInfo.h>

#include <algorithm>

#include "mivo/core/error.h"
#include "ros/camera_conversion.h"
#include "ros/header_only.h"
#include "ros/pose_conversion.h"
#include "ros/stamp.h"
#include "ros/topics.h"
#include "session/stamp_order.h"
#include "session/stamp_pairer.h"

namespace mivo {
namespace {

void open(rosbag::Bag& bag, const std::string& path) {
  try {
    bag.open(path, rosbag::bagmode::Read);
  } catch (const rosbag::BagUnindexedException&) {
    throw Error(path + " has no index, its recording was interrupted; run: rosbag reindex " + path);
  } catch (const std::exception& error) {
    throw Error(path + " cannot be read as a bag: " + error.what());
  }
}

BagContents contentsOf(const rosbag::Bag& bag) {
  BagContents contents;
  rosbag::View view(bag);
  for (const rosbag::ConnectionInfo* connection : view.getConnections()) {
    contents[connection->topic] = connection->datatype;
  }
  return contents;
}

std::vector<double> stampsOf(const std::vector<BagSource::Message>& messages) {
  std::vector<double> stamps;
  for (const BagSource::Message& message : messages) stamps.push_back(message.stamp);
  return stamps;
}

template <typename Message>
boost::shared_ptr<const Message> instantiate(const rosbag::MessageInstance& instance) {
  boost::shared_ptr<const Message> message = instance.instantiate<Message>();
  if (!message) {
    throw Error("the message is a " + instance.getDataType() + ", not a " +
                ros::message_traits::DataType<Message>::value());
  }
  return message;
}

ImageMessageConstPtr readImage(const rosbag::MessageInstance& instance) {
  if (instance.isType<sensor_msgs::CompressedImage>()) {
    return wrap(instantiate<sensor_msgs::CompressedImage>(instance));
  }
  return wrap(instantiate<sensor_msgs::Image>(instance));
}

}  // namespace

BagSource::BagSource(const std::string& path, const RgbdTopics& wanted, const FrameRange& range)
    : path_(path) {
  open(bag_, path);
  try {
    topics_ = findTopics(contentsOf(bag_), wanted);
    readCamera();
    findPairs(range);
  } catch (const std::exception& error) {
    throw Error(path + ": " + error.what());
  }
}

void BagSource::readCamera() {
  rosbag::View view(bag_, rosbag::TopicQuery(topics_.camera_info));
  for (const rosbag::MessageInstance& instance : view) {
    camera_ =
        toCamera(*instantiate<sensor_msgs::CameraInfo>(instance), isRectifiedTopic(topics_.colour));
    return;
  }
  throw Error("there is no message on the topic " + topics_.camera_info);
}

std::vector<BagSource::Message> BagSource::readIndex(const std::string& topic) {
  struct Indexed {
    double stamp;
    std::size_t index;  // instances cannot be assigned, thus not sorted
  };
  rosbag::View view(bag_, rosbag::TopicQuery(topic));
  std::vector<rosbag::MessageInstance> instances(view.begin(), view.end());
  std::vector<Indexed> order;
  for (std::size_t i = 0; i < instances.size(); ++i) {
    order.push_back({toSeconds(instantiate<HeaderOnly>(instances[i])->header.stamp), i});
  }
  StampOrder changes;
  try {
    changes = putInOrder(order);
  } catch (const Error& error) {
    throw Error("the images on " + topic + ": " + error.what());
  }
  changes.was_sorted = true;  // a bag has them as they came in, which nobody needs to know
  const std::string text = describe(changes, "images on " + topic);
  if (!text.empty()) notice_ += (notice_.empty() ? path_ + ": " : "; ") + text;
  std::vector<Message> messages;
  messages.reserve(order.size());
  for (const Indexed& item : order) messages.push_back({item.stamp, instances[item.index]});
  return messages;
}

void BagSource::findPairs(const FrameRange& range) {
  const std::vector<Message> colours = readIndex(topics_.colour);
  const std::vector<Message> depths = readIndex(topics_.depth);
  for (const auto& [i, j] : pairByStamp(stampsOf(colours), stampsOf(depths))) {
    pairs_.push_back({colours[i], depths[j]});
  }
  if (pairs_.empty()) {
    throw Error("no depth image is within 20 ms of a colour image (" +
                std::to_string(colours.size()) + " colour images on " + topics_.colour + ", " +
                std::to_string(depths.size()) + " depth images on " + topics_.depth + ")");
  }
  if (range.count == 0 || range.start >= pairs_.size()) {
    throw Error("no frame left: there are " + std::to_string(pairs_.size()) +
                ", numbered from 0, and frames from " + std::to_string(range.start) +
                " on were asked for");
  }
  const std::size_t end = range.start + std::min(range.count, pairs_.size() - range.start);
  // MessageInstance cannot be assigned: the part is copied, not erased from the whole.
  pairs_ = std::vector<Pair>(pairs_.begin() + static_cast<std::ptrdiff_t>(range.start),
                             pairs_.begin() + static_cast<std::ptrdiff_t>(end));
}

BagSource::Images BagSource::read(const Pair& pair) {
  colour_ = readImage(pair.colour.instance);
  depth_ = readImage(pair.depth.instance);
  return {colour_->toColourImage(), depth_->toDepthImage()};
}

FrameSource::Status BagSource::next(Frame& frame, FrameFault& fault) {
  if (next_ >= pairs_.size()) return Status::kEnd;
  const Pair& pair = pairs_[next_++];
  std::string reason;
  try {
    const Images images = read(pair);
    frame.stamp = pair.colour.stamp;
    frame.image = toGrey(images.colour.image, images.colour.order);
    frame.depth = images.depth.image;
    frame.depth_unit = images.depth.unit;
    reason = findFault(frame, camera_);
  } catch (const std::exception& error) {
    reason = error.what();
  }
  if (reason.empty()) return Status::kFrame;
  fault.text = path_ + ", frame of stamp " + std::to_string(pair.colour.stamp) + ": " + reason;
  fault.reason = reason;
  return Status::kSkipped;
}

double BagSource::depthUnitsPerMetre() const {
  constexpr double kMillimetres = 1000.0;
  constexpr double kOfMetres = 5000.0;
  return readImage(pairs_.front().depth.instance)->toDepthImage().image.type() == CV_16UC1
             ? kMillimetres
             : kOfMetres;
}

Trajectory BagSource::groundTruth() const {
  Trajectory truth;
  rosbag::View view(bag_, rosbag::TopicQuery(topics::kGroundTruth));
  for (const rosbag::MessageInstance& instance : view) {
    if (!instance.isType<nav_msgs::Path>()) continue;
    const auto path = instantiate<nav_msgs::Path>(instance);
    for (const geometry_msgs::PoseStamped& pose : path->poses) {
      truth.push_back({toSeconds(pose.header.stamp), toIsometry(pose.pose)});
    }
    break;
  }
  return truth;
}

}  // namespace mivo
