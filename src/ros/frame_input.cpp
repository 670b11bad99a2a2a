// SPDX-License-Identifier: BSD-3-Clause
#include "ros/frame_input.h"

#include <fmt/format.h>
#include <ros/console.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "ros/node_topics.h"
#include "ros/stamp.h"
#include "trajectory/association.h"

namespace mivo {
namespace {

// A stamp that is older than the last one by more than this means that time was set back.
constexpr double kTimeJump = 1.0;  // s
constexpr double kSilence = 5.0;   // s without a pair before a warning
// Without a message for this long no better partner will come for what is waiting.
constexpr double kIdle = 0.5;          // s
constexpr double kWatchPeriod = 0.25;  // s

// Part of the smallest period so far within which no further image of a topic is expected.
constexpr double kSurePart = 0.9;

// Where no frame may be lost, one topic may run ahead of the other by this many images at least.
constexpr int kQueueWithoutLoss = 100;

NodeParameters withLongQueue(NodeParameters parameters) {
  if (!parameters.drop_frames) {
    parameters.queue_size = std::max(parameters.queue_size, kQueueWithoutLoss);
  }
  return parameters;
}

std::uint32_t subscriberQueue(const NodeParameters& parameters) {
  return parameters.drop_frames ? static_cast<std::uint32_t>(parameters.queue_size)
                                : 0;  // 0: no end
}

std::vector<double> stampsOf(const std::deque<ImageMessageConstPtr>& messages) {
  std::vector<double> stamps;
  for (const ImageMessageConstPtr& message : messages) {
    stamps.push_back(toSeconds(message->header.stamp));
  }
  return stamps;
}

bool isEarlier(const ImageMessageConstPtr& a, const ImageMessageConstPtr& b) {
  return a->header.stamp < b->header.stamp;
}

void forgetUntil(std::deque<ImageMessageConstPtr>& messages, const ros::Time& stamp) {
  messages.erase(std::remove_if(messages.begin(), messages.end(),
                                [&](const ImageMessageConstPtr& message) {
                                  return message->header.stamp <= stamp;
                                }),
                 messages.end());
}

}  // namespace

FrameInput::FrameInput(const ros::NodeHandle& private_node, const NodeParameters& parameters,
                       PairCallback callback)
    : parameters_(withLongQueue(parameters)),
      callback_(std::move(callback)),
      colour_(private_node, topicBeside(private_node, topics::kColour), parameters.rgb_transport,
              static_cast<int>(subscriberQueue(parameters)),
              [this](const ImageMessageConstPtr& message) {
                observe(message, waiting_colour_);
                expect(0, waiting_colour_, message->header.stamp);
              }),
      depth_(private_node, topicBeside(private_node, topics::kDepth), parameters.depth_transport,
             static_cast<int>(subscriberQueue(parameters)),
             [this](const ImageMessageConstPtr& message) {
               observe(message, waiting_depth_);
               expect(1, waiting_depth_, message->header.stamp);
             }),
      last_pair_(ros::WallTime::now()),
      next_warning_(kSilence) {
  ros::NodeHandle handle(private_node);
  const std::string camera_info_topic = topicBeside(private_node, topics::kCameraInfo);
  waiting_colour_.count.topic = colour_.topic();
  waiting_depth_.count.topic = depth_.topic();
  camera_info_count_.topic = handle.resolveName(camera_info_topic);
  connect();
  const boost::function<void(const sensor_msgs::CameraInfoConstPtr&)> take =
      [this](const sensor_msgs::CameraInfoConstPtr& message) { takeCameraInfo(message); };
  camera_info_subscriber_ = handle.subscribe<sensor_msgs::CameraInfo>(
      camera_info_topic, static_cast<std::uint32_t>(parameters.queue_size), take);
  colour_.subscribe(private_node);
  depth_.subscribe(private_node);
  timer_ = handle.createWallTimer(ros::WallDuration(kWatchPeriod),
                                  [this](const ros::WallTimerEvent&) { watch(); });
}

void FrameInput::connect() {
  approximate_.reset();
  exact_.reset();
  const auto queue_size = static_cast<std::uint32_t>(parameters_.queue_size);
  if (parameters_.approximate_sync) {
    Approximate policy(queue_size);
    policy.setMaxIntervalDuration(ros::Duration(parameters_.sync_tolerance));
    approximate_ = std::make_unique<message_filters::Synchronizer<Approximate>>(
        std::as_const(policy), colour_, depth_);
    approximate_->registerCallback(&FrameInput::takePair, this);
  } else {
    const Exact policy(queue_size);
    exact_ = std::make_unique<message_filters::Synchronizer<Exact>>(std::as_const(policy), colour_,
                                                                    depth_);
    exact_->registerCallback(&FrameInput::takePair, this);
  }
}

void FrameInput::observe(const ImageMessageConstPtr& message, Waiting& waiting) {
  bool jumped = false;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    InputCount& count = waiting.count;
    jumped = count.messages > 0 && (count.last_stamp - message->header.stamp).toSec() > kTimeJump;
    ++count.messages;
    count.last_stamp = message->header.stamp;
    count.last_arrival = ros::WallTime::now();
  }
  if (jumped) {
    // The images before the jump would wait for ever. The other topic jumps too: let it.
    deliverWaiting();
    const std::lock_guard<std::mutex> lock(mutex_);
    waiting_colour_.count.last_stamp = waiting_depth_.count.last_stamp = message->header.stamp;
  }
  const std::lock_guard<std::mutex> lock(mutex_);
  waiting.messages.push_back(message);
  while (waiting.messages.size() > static_cast<std::size_t>(parameters_.queue_size)) {
    waiting.messages.pop_front();
  }
}

// Colour and depth that are not taken together could each get a better partner with the next image,
// and a pair would wait for it, a whole period. Live, that next image is not expected sooner than
// nine tenths of its period after the last: what it cannot better goes on at once.
void FrameInput::expect(int input, Waiting& waiting, const ros::Time& stamp) {
  waiting.gap.add(stamp);
  if (approximate_ && parameters_.drop_frames) {
    approximate_->setInterMessageLowerBound(input, waiting.gap.smallest() * kSurePart);
  }
}

void FrameInput::takePair(const ImageMessageConstPtr& colour, const ImageMessageConstPtr& depth) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    forgetUntil(waiting_colour_.messages, colour->header.stamp);
    forgetUntil(waiting_depth_.messages, depth->header.stamp);
  }
  deliver({colour, depth, nullptr});
}

void FrameInput::deliverWaiting() {
  std::deque<ImageMessageConstPtr> colours;
  std::deque<ImageMessageConstPtr> depths;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    colours.swap(waiting_colour_.messages);
    depths.swap(waiting_depth_.messages);
  }
  connect();  // forgets them too
  if (!parameters_.approximate_sync) return;
  std::stable_sort(colours.begin(), colours.end(), isEarlier);
  std::stable_sort(depths.begin(), depths.end(), isEarlier);
  for (const auto& [i, j] :
       associate(stampsOf(colours), stampsOf(depths), parameters_.sync_tolerance)) {
    deliver({colours[i], depths[j], nullptr});
  }
}

void FrameInput::takeCameraInfo(const sensor_msgs::CameraInfoConstPtr& message) {
  std::vector<ImagePair> early;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    ++camera_info_count_.messages;
    camera_info_count_.last_stamp = message->header.stamp;
    camera_info_count_.last_arrival = ros::WallTime::now();
    camera_info_ = message;
    early.swap(early_);
  }
  for (ImagePair& pair : early) deliver(pair);
}

void FrameInput::deliver(ImagePair pair) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (!camera_info_) {
      if (parameters_.drop_frames) early_.clear();
      early_.push_back(pair);
      return;
    }
    pair.camera_info = camera_info_;
    last_pair_ = ros::WallTime::now();
    next_warning_ = kSilence;
  }
  callback_(pair);
}

void FrameInput::watch() {
  bool idle = false;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    const ros::WallTime last =
        std::max(waiting_colour_.count.last_arrival, waiting_depth_.count.last_arrival);
    idle = !waiting_colour_.messages.empty() && !waiting_depth_.messages.empty() &&
           (ros::WallTime::now() - last).toSec() > kIdle;
  }
  if (idle) deliverWaiting();
  const std::string warning = silence();
  if (!warning.empty()) ROS_WARN_STREAM(warning);
}

void FrameInput::stop() {
  timer_.stop();
  colour_.shutdown();
  depth_.shutdown();
  camera_info_subscriber_.shutdown();
  deliverWaiting();
  approximate_.reset();
  exact_.reset();
}

std::string FrameInput::silence() {
  const std::lock_guard<std::mutex> lock(mutex_);
  const double seconds = (ros::WallTime::now() - last_pair_).toSec();
  if (seconds < next_warning_) return {};
  next_warning_ = 2.0 * seconds;  // less and less often
  return explain(seconds);
}

std::string FrameInput::explain(double seconds) const {
  const ros::WallTime now = ros::WallTime::now();
  std::string silent;
  std::string text;
  const std::pair<const InputCount*, std::uint32_t> inputs[] = {
      {&waiting_colour_.count, colour_.publishers()},
      {&waiting_depth_.count, depth_.publishers()},
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
  if (!silent.empty()) {
    return fmt::format("no frame for {:.0f} s, nothing comes on: {}", seconds, silent) + text;
  }
  const double difference =
      std::abs((waiting_colour_.count.last_stamp - waiting_depth_.count.last_stamp).toSec());
  return fmt::format(
             "no frame for {:.0f} s: images come, but their stamps are not {}; the last ones "
             "differ "
             "by {:.3f} s (parameters approximate_sync, sync_tolerance)",
             seconds,
             parameters_.approximate_sync ? fmt::format("within {} s", parameters_.sync_tolerance)
                                          : std::string("equal"),
             difference) +
         text;
}

std::vector<InputCount> FrameInput::counts() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  std::vector<InputCount> counts = {waiting_colour_.count, waiting_depth_.count,
                                    camera_info_count_};
  counts[0].publishers = colour_.publishers();
  counts[1].publishers = depth_.publishers();
  counts[2].publishers = camera_info_subscriber_.getNumPublishers();
  return counts;
}

}  // namespace mivo
