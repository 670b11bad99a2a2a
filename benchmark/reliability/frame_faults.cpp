// SPDX-License-Identifier: BSD-3-Clause
#include "frame_faults.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <map>
#include <opencv2/core.hpp>
#include <utility>

#include "mivo/core/error.h"

namespace mivo {
namespace {

using Deliveries = std::vector<Delivery>;

constexpr std::size_t kMostEarlier = 15;  // frames, half a second of an Xtion
constexpr std::size_t kMostHeld = 15;
constexpr double kFarAhead = 3600.0;  // s
constexpr double kBack = 5.0;         // s

cv::Mat metersOf(const Frame& frame) {
  cv::Mat meters;
  frame.depth.convertTo(meters, CV_32FC1, frame.depth.type() == CV_16UC1 ? frame.depth_unit : 1.0);
  return meters;
}

int upTo(FrameFaults& state, int most) {
  return std::uniform_int_distribution<int>(0, most)(state.engine());
}

/// A rectangle of the depth, which may be all of it, has one value.
Deliveries spoilDepth(FrameFaults& state, Delivery delivery, float value) {
  cv::Mat meters = metersOf(delivery.frame);
  const int x = upTo(state, meters.cols - 1);
  const int y = upTo(state, meters.rows - 1);
  const bool is_all = upTo(state, 3) == 0;
  const cv::Rect part(x, y, meters.cols - x, meters.rows - y);
  meters(is_all ? cv::Rect(0, 0, meters.cols, meters.rows) : part).setTo(value);
  delivery.frame.depth = meters;
  return {delivery};
}

Deliveries drop(FrameFaults&, Delivery) {
  return {};
}

Deliveries duplicate(FrameFaults&, Delivery delivery) {
  return {delivery, delivery};
}

/// Comes after the next one.
Deliveries reorder(FrameFaults& state, Delivery delivery) {
  state.held().push_back(std::move(delivery));
  if (state.held().size() < 2) return {};
  Deliveries swapped = std::exchange(state.held(), {});
  std::swap(swapped[0], swapped[1]);
  return swapped;
}

/// A pause, and all of its frames at once.
Deliveries burst(FrameFaults& state, Delivery delivery) {
  state.held().push_back(std::move(delivery));
  if (state.held().size() < kMostHeld) return {};
  return std::exchange(state.held(), {});
}

Deliveries cropped(FrameFaults&, Delivery delivery) {
  const cv::Rect part(0, 0, delivery.frame.image.cols / 2, delivery.frame.image.rows / 2);
  delivery.frame.image = delivery.frame.image(part);
  delivery.frame.depth = delivery.frame.depth(part);
  return {delivery};
}

/// The last rows of one of the two are missing.
Deliveries truncated(FrameFaults& state, Delivery delivery) {
  cv::Mat& image = upTo(state, 1) == 0 ? delivery.frame.image : delivery.frame.depth;
  image = image.rowRange(0, upTo(state, image.rows - 1));
  return {delivery};
}

Deliveries wrongType(FrameFaults& state, Delivery delivery) {
  Frame& frame = delivery.frame;
  if (upTo(state, 1) == 0) {
    frame.image = cv::Mat(frame.image.size(), CV_8UC3, cv::Scalar(1, 2, 3));
  } else {
    frame.depth = cv::Mat(frame.depth.size(), CV_64FC1, cv::Scalar(1.0));
  }
  return {delivery};
}

Deliveries notANumber(FrameFaults& state, Delivery delivery) {
  return spoilDepth(state, std::move(delivery), std::numeric_limits<float>::quiet_NaN());
}

Deliveries infinite(FrameFaults& state, Delivery delivery) {
  return spoilDepth(state, std::move(delivery), std::numeric_limits<float>::infinity());
}

Deliveries negative(FrameFaults& state, Delivery delivery) {
  return spoilDepth(state, std::move(delivery), -1.0F);
}

Deliveries zero(FrameFaults& state, Delivery delivery) {
  return spoilDepth(state, std::move(delivery), 0.0F);
}

Deliveries otherDepth(FrameFaults& state, Delivery delivery) {
  if (state.earlier().empty()) return {delivery};
  delivery.frame.depth = state.earlier().front().frame.depth;
  return {delivery};
}

Deliveries saturated(FrameFaults&, Delivery delivery) {
  delivery.frame.image = cv::Mat(delivery.frame.image.size(), CV_8UC1, cv::Scalar(255));
  return {delivery};
}

Deliveries black(FrameFaults&, Delivery delivery) {
  delivery.frame.image = cv::Mat(delivery.frame.image.size(), CV_8UC1, cv::Scalar(0));
  return {delivery};
}

/// The last image again, while stamps and depth run on.
Deliveries frozen(FrameFaults& state, Delivery delivery) {
  if (!state.last()) return {delivery};
  delivery.frame.image = state.last()->frame.image;
  delivery.index = state.last()->index;
  return {delivery};
}

Deliveries stampAhead(FrameFaults&, Delivery delivery) {
  delivery.frame.stamp += kFarAhead;
  return {delivery};
}

Deliveries stampBack(FrameFaults&, Delivery delivery) {
  delivery.frame.stamp -= kBack;
  return {delivery};
}

Deliveries stampZero(FrameFaults&, Delivery delivery) {
  delivery.frame.stamp = 0.0;
  return {delivery};
}

Deliveries stampNotANumber(FrameFaults&, Delivery delivery) {
  delivery.frame.stamp = std::numeric_limits<double>::quiet_NaN();
  return {delivery};
}

Deliveries noFocalLength(FrameFaults&, Delivery delivery) {
  delivery.camera.fx = 0.0;
  return {delivery};
}

Deliveries otherCamera(FrameFaults&, Delivery delivery) {
  delivery.camera.fx *= 1.3;
  delivery.camera.fy *= 1.3;
  return {delivery};
}

/// The publisher writes its next image into the memory of one that it has delivered.
Deliveries overwritten(FrameFaults& state, Delivery delivery) {
  if (state.last()) {
    cv::Mat image = state.last()->frame.image;
    delivery.frame.image.copyTo(image);
  }
  return {delivery};
}

const std::map<std::string, FrameFaults::Fault>& faults() {
  static const std::map<std::string, FrameFaults::Fault> table = {
      {"another camera's calibration", otherCamera},
      {"black image", black},
      {"burst after a pause", burst},
      {"calibration without focal length", noFocalLength},
      {"cropped images", cropped},
      {"depth of another frame", otherDepth},
      {"dropped", drop},
      {"duplicated", duplicate},
      {"frozen image", frozen},
      {"infinite depth", infinite},
      {"NaN as depth", notANumber},
      {"NaN as stamp", stampNotANumber},
      {"negative depth", negative},
      {"overwritten after publishing", overwritten},
      {"reordered", reorder},
      {"saturated image", saturated},
      {"stamp an hour ahead", stampAhead},
      {"stamp five seconds back", stampBack},
      {"stamp of zero", stampZero},
      {"truncated", truncated},
      {"wrong type", wrongType},
      {"zero depth", zero}};
  return table;
}

FrameFaults::Fault find(const std::string& name) {
  const auto entry = faults().find(name);
  if (entry == faults().end()) throw Error("there is no fault '" + name + "'");
  return entry->second;
}

}  // namespace

FrameFaults::FrameFaults(const std::string& fault, double rate, std::uint32_t seed)
    : fault_(find(fault)), hits_(rate), engine_(seed) {}

std::vector<Delivery> FrameFaults::pass(const Delivery& delivery) {
  // What comes out may be overwritten; the recording must not.
  Delivery own = delivery;
  own.frame.image = delivery.frame.image.clone();
  own.frame.depth = delivery.frame.depth.clone();
  Deliveries out;
  if (hits_(engine_)) {
    out = fault_(*this, own);
  } else {
    out = end();  // what was held back is late, and after a pause all the same in its order
    out.insert(fault_ == reorder ? out.begin() : out.end(), own);
  }
  if (!out.empty()) last_ = out.back();
  earlier_.push_back(std::move(own));
  if (earlier_.size() > kMostEarlier) earlier_.pop_front();
  return out;
}

std::vector<Delivery> FrameFaults::end() {
  return std::exchange(held_, {});
}

std::vector<std::string> FrameFaults::names() {
  std::vector<std::string> names;
  for (const auto& [name, fault] : faults()) names.push_back(name);
  return names;
}

}  // namespace mivo
