// SPDX-License-Identifier: BSD-3-Clause
#include "ros/frame_input.h"

#include <fmt/format.h>
#include <ros/console.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "ros/clock_fault.h"
#include "ros/depth_geometry.h"
#include "ros/guarded_call.h"
#include "ros/node_topics.h"
#include "ros/stamp.h"

namespace mivo {
namespace {

constexpr double kSilence = 5.0;       // s without a pair before a warning
constexpr double kWatchPeriod = 0.25;  // s
// Looks in a row without a new message after which no better partner is expected for waiting
// images. Looks are counted, not seconds: a node that was not scheduled has messages before it.
// Where no frame may be lost, a stalled player has more time.
constexpr int kIdleLooks = 2;
constexpr int kIdleLooksWithoutLoss = 8;

// Pairs that wait for their calibration, which comes with the image or not at all.
constexpr std::size_t kMostWaiting = 3;

// Least queue, in images, where no frame may be dropped: one topic may run ahead of the other.
constexpr int kQueueWithoutLoss = 100;

NodeParameters withLongQueue(NodeParameters parameters) {
  if (!parameters.drop_frames) {
    parameters.queue_size = std::max(parameters.queue_size, kQueueWithoutLoss);
  }
  return parameters;
}

int subscriberQueue(const NodeParameters& parameters) {
  return parameters.drop_frames ? parameters.queue_size : static_cast<int>(kMaxBacklog);
}

PairingOptions pairingOptions(const NodeParameters& parameters) {
  PairingOptions options;
  options.max_difference = parameters.approximate_sync ? parameters.sync_tolerance : 0.0;
  options.capacity = static_cast<std::size_t>(parameters.queue_size);
  // Live, a pair need not wait a whole period for an image that is not expected to fit better.
  options.learns_gap = parameters.drop_frames;
  return options;
}

}  // namespace

FrameInput::FrameInput(const ros::NodeHandle& private_node, const NodeParameters& parameters,
                       PairCallback callback)
    : parameters_(withLongQueue(parameters)),
      callback_(std::move(callback)),
      pairer_(
          pairingOptions(parameters_),
          [this](ImageMessageConstPtr& color, ImageMessageConstPtr& depth) {
            ImagePair pair;
            pair.color = color;
            pair.depth = depth;
            deliver(std::move(pair));
          },
          [this](ImageStream stream, ImageMessageConstPtr&) { countSingle(stream); }),
      color_(private_node, topicBeside(private_node, topics::kColor), parameters.rgb_transport,
             subscriberQueue(parameters),
             [this](const ImageMessageConstPtr& message) {
               guardedCall("the input of images", [&] { take(ImageStream::kColor, message); });
             }),
      depth_(private_node, topicBeside(private_node, topics::kDepth), parameters.depth_transport,
             subscriberQueue(parameters),
             [this](const ImageMessageConstPtr& message) {
               guardedCall("the input of images", [&] { take(ImageStream::kDepth, message); });
             }),
      early_(parameters.drop_frames ? FrameQueue<ImagePair>::Policy::kNewest
                                    : FrameQueue<ImagePair>::Policy::kAll,
             static_cast<std::size_t>(parameters_.queue_size)),
      last_pair_(ros::WallTime::now()),
      next_warning_(kSilence) {
  ros::NodeHandle handle(private_node);
  const std::string camera_info_topic = topicBeside(private_node, topics::kCameraInfo);
  countOf(ImageStream::kColor).topic = color_.topic();
  countOf(ImageStream::kDepth).topic = depth_.topic();
  camera_info_count_.topic = handle.resolveName(camera_info_topic);
  const boost::function<void(const sensor_msgs::CameraInfoConstPtr&)> take_info =
      [this](const sensor_msgs::CameraInfoConstPtr& message) {
        guardedCall("the input of camera_info", [&] { takeCameraInfo(message); });
      };
  camera_info_subscriber_ = handle.subscribe<sensor_msgs::CameraInfo>(
      camera_info_topic, static_cast<std::uint32_t>(parameters.queue_size), take_info);
  const boost::function<void(const sensor_msgs::CameraInfoConstPtr&)> take_depth_info =
      [this](const sensor_msgs::CameraInfoConstPtr& message) {
        guardedCall("the input of camera_info", [&] { takeDepthInfo(message); });
      };
  depth_info_subscriber_ = handle.subscribe<sensor_msgs::CameraInfo>(
      cameraInfoBeside(depth_.topic()), static_cast<std::uint32_t>(parameters.queue_size),
      take_depth_info);
  color_.subscribe(private_node);
  depth_.subscribe(private_node);
  timer_ =
      handle.createWallTimer(ros::WallDuration(kWatchPeriod), [this](const ros::WallTimerEvent&) {
        guardedCall("the watch of the inputs", [this] { watch(); });
      });
}

void FrameInput::take(ImageStream stream, const ImageMessageConstPtr& message) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    InputCount& count = countOf(stream);
    ++count.messages;
    count.last_stamp = message->header.stamp;
    count.last_arrival = ros::WallTime::now();
    clock_offset_.add(stream, toSeconds(message->header.stamp), toSeconds(ros::Time::now()));
  }
  pairer_.push(stream, toSeconds(message->header.stamp), message);
}

void FrameInput::countSingle(ImageStream stream) {
  const std::lock_guard<std::mutex> lock(mutex_);
  ++countOf(stream).without_partner;
}

void FrameInput::takeCameraInfo(const sensor_msgs::CameraInfoConstPtr& message) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    ++camera_info_count_.messages;
    camera_info_count_.last_stamp = message->header.stamp;
    camera_info_count_.last_arrival = ros::WallTime::now();
    calibrations_.add(toSeconds(message->header.stamp), message);
    if (calibrations_.empty()) return;
  }
  while (early_.size() > 0) complete(*early_.pop());
  giveOut(false);
}

void FrameInput::takeDepthInfo(const sensor_msgs::CameraInfoConstPtr& message) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    depth_calibrations_.add(toSeconds(message->header.stamp), message);
  }
  giveOut(false);
}

void FrameInput::deliver(ImagePair pair) {
  waiting_.push_back(std::move(pair));
  giveOut(waiting_.size() > kMostWaiting);
}

/// Pairs whose calibration is there, in their order; all of them `at_once` whatever may come.
void FrameInput::giveOut(bool at_once) {
  while (!waiting_.empty() &&
         (at_once || !(expectsCalibration(waiting_.front().color->header.stamp) ||
                       expectsDepthCalibration(waiting_.front())))) {
    ImagePair pair = std::move(waiting_.front());
    waiting_.pop_front();
    last_given_ = pair.color->header.stamp;
    complete(std::move(pair));
  }
}

/// Whether there is one with each image, and that of this stamp is on its way: topics overtake each
/// other, and a calibration that changes has to change with its own image.
bool FrameInput::expectsCalibration(const ros::Time& stamp) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  const ros::Time& last = camera_info_count_.last_stamp;
  return camera_info_count_.messages > 1 && !last_given_.isZero() && last >= last_given_ &&
         last < stamp;
}

/// Whether depth has to be registered, and the first calibration for that is on its way.
bool FrameInput::expectsDepthCalibration(const ImagePair& pair) const {
  if (parameters_.depth_registered == "yes" || depth_info_subscriber_.getNumPublishers() == 0) {
    return false;
  }
  const std::lock_guard<std::mutex> lock(mutex_);
  return depth_calibrations_.empty() &&
         (parameters_.depth_registered == "no" ||
          isUnregistered(pair.color->header.frame_id, pair.depth->header.frame_id, depth_.topic()));
}

void FrameInput::complete(ImagePair pair) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (calibrations_.empty()) {
      keepEarly(std::move(pair));
      return;
    }
    pair.camera_info = calibrations_.at(toSeconds(pair.color->header.stamp));
    pair.depth_info = depth_calibrations_.at(toSeconds(pair.depth->header.stamp));
    const std::optional<double> offset = clock_offset_.seconds();
    if (offset) pair.fault = describeClockFault(*offset);
    last_pair_ = ros::WallTime::now();
    next_warning_ = kSilence;
  }
  callback_(pair);
}

void FrameInput::keepEarly(ImagePair pair) {
  const std::size_t bytes = pair.bytes();
  early_.push(std::move(pair), bytes);
  if (parameters_.drop_frames || early_.dropped() == 0) return;
  ROS_WARN_THROTTLE(kSilence,
                    "no calibration has arrived on %s, and more frames than queue_size (%d) wait "
                    "for it: the oldest are dropped",
                    camera_info_count_.topic.c_str(), parameters_.queue_size);
}

void FrameInput::watch() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    const std::uint64_t messages =
        countOf(ImageStream::kColor).messages + countOf(ImageStream::kDepth).messages;
    idle_looks_ = messages == messages_seen_ ? idle_looks_ + 1 : 0;
    messages_seen_ = messages;
  }
  const bool idle = idle_looks_ >= (parameters_.drop_frames ? kIdleLooks : kIdleLooksWithoutLoss);
  if (idle && pairer_.numWaiting(ImageStream::kColor) > 0 &&
      pairer_.numWaiting(ImageStream::kDepth) > 0) {
    pairer_.flush();
  }
  if (idle) giveOut(true);
  const std::string warning = silence();
  if (!warning.empty()) ROS_WARN_STREAM(warning);
}

void FrameInput::stop() {
  timer_.stop();
  color_.shutdown();
  depth_.shutdown();
  camera_info_subscriber_.shutdown();
  depth_info_subscriber_.shutdown();
  guardedCall("the last frames", [this] {
    pairer_.flush();
    giveOut(true);
  });
}

std::string FrameInput::silence() {
  const std::lock_guard<std::mutex> lock(mutex_);
  const double seconds = (ros::WallTime::now() - last_pair_).toSec();
  if (seconds < next_warning_) return {};
  next_warning_ = 2.0 * seconds;  // increasingly rare
  return explain(seconds);
}

std::string FrameInput::explain(double seconds) const {
  const ros::WallTime now = ros::WallTime::now();
  std::string silent;
  std::string text;
  const std::pair<const InputCount*, std::uint32_t> inputs[] = {
      {&countOf(ImageStream::kColor), color_.publishers()},
      {&countOf(ImageStream::kDepth), depth_.publishers()},
      {&camera_info_count_, camera_info_subscriber_.getNumPublishers()}};
  for (const auto& [count, publishers] : inputs) {
    const bool never = count->messages == 0;
    const bool is_info = count == &camera_info_count_;
    if (never || (!is_info && (now - count->last_arrival).toSec() >= kSilence)) {
      silent += (silent.empty() ? "" : ", ") + count->topic;
    }
    text += fmt::format(
        "\n  {}: {} messages, {} publisher{}{}", count->topic, count->messages, publishers,
        publishers == 1 ? "" : "s",
        never ? std::string() : fmt::format(", last stamp {:.3f}", count->last_stamp.toSec()));
  }
  if (silent.empty() && calibrations_.empty() && calibrations_.sawUncalibrated()) {
    return fmt::format(
        "no frame for {:.0f} s: camera_info is not calibrated, all messages on {} are zero; set "
        "the camera's calibration file",
        seconds, camera_info_count_.topic);
  }
  if (!silent.empty()) {
    return fmt::format("no frame for {:.0f} s, no messages on: {}", seconds, silent) + text;
  }
  const double difference = std::abs(countOf(ImageStream::kColor).last_stamp.toSec() -
                                     countOf(ImageStream::kDepth).last_stamp.toSec());
  return fmt::format(
             "no frame for {:.0f} s: images arrive, but the stamps of color and depth are not {}; "
             "the last ones differ by {:.3f} s (parameters approximate_sync, sync_tolerance)",
             seconds,
             parameters_.approximate_sync ? fmt::format("within {} s", parameters_.sync_tolerance)
                                          : std::string("equal"),
             difference) +
         text;
}

std::vector<InputCount> FrameInput::counts() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  std::vector<InputCount> counts = {image_counts_[0], image_counts_[1], camera_info_count_};
  counts[0].publishers = color_.publishers();
  counts[1].publishers = depth_.publishers();
  counts[2].publishers = camera_info_subscriber_.getNumPublishers();
  return counts;
}

}  // namespace mivo
