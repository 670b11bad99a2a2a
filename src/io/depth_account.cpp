// SPDX-License-Identifier: BSD-3-Clause
#include "io/depth_account.h"

#include <fmt/format.h>

#include "session/depth_sample.h"
#include "session/median.h"

namespace mivo {
namespace {

// m; the median depth of what is filmed indoors lies between, as far as the sensors reach.
constexpr double kNearRoom = 0.6;
constexpr double kFarRoom = 6.0;
const char* const kMultiplesOf8 =
    "its values are multiples of 8, as if their bits were rotated by three to the left (SUN "
    "RGB-D): "
    "8 times as many units per meter read them, or undo it";

/// What the bits of a depth image say, and what to do; of a coarse one, too.
std::string describeStorage(const DepthStorage& storage) {
  if (storage.is_rotated_right) {
    return "neighboring values jump, unless their 16 bits are rotated by three to the left: undo "
           "what has rotated them to the right";
  }
  if (storage.coarse_step > 0.0) {
    return fmt::format("it comes in steps of {:.1g} m: was it stored in 8 bits, or fewer?",
                       storage.coarse_step);
  }
  return storage.is_multiple_of_8 ? kMultiplesOf8 : "";
}

/// A usual unit with which the median would be one of a room.
std::string otherUnit(double median, double unit) {
  if (unit == 0.0) unit = 1.0;
  for (const double units_per_meter : {1000.0, 5000.0, 10000.0, 256.0}) {
    const double other = median / unit / units_per_meter;
    if (other < kNearRoom || other > kFarRoom) continue;
    return fmt::format(" With {} units per meter it would be {:.4g} m", units_per_meter, other);
  }
  return {};
}

}  // namespace

void DepthAccount::add(const Frame& frame) {
  ++frames_;
  const DepthSample depth = sampleDepth(frame);
  coverages_ += depth.coverage;
  if (depth.coverage > 0.0) medians_.push_back(depth.median);
  unit_ = frame.depth.type() == CV_16UC1 ? frame.depth_unit : 0.0;
  const std::string storage = describeStorage(examineDepthStorage(frame));
  if (!storage.empty()) ++storage_[storage];
}

double DepthAccount::median() const {
  return medians_.empty() ? 0.0 : medianOf(medians_);
}

double DepthAccount::coverage() const {
  return frames_ == 0 ? 0.0 : coverages_ / static_cast<double>(frames_);
}

std::string DepthAccount::describe() const {
  return fmt::format("median depth seen {:.4g} m, {:.0f} % of the pixels", median(),
                     100.0 * coverage());
}

/// The storage that most frames have, or an empty text.
std::string DepthAccount::usualStorage() const {
  for (const auto& [storage, count] : storage_) {
    if (2 * count > frames_) return storage;
  }
  return {};
}

std::string DepthAccount::findFault(const DepthParameters& parameters,
                                    const std::string& unit_source, Expected expected) const {
  if (frames_ == 0) return {};
  if (medians_.empty()) return "the depth images have no reading at all";
  const double seen = median();
  const std::string storage = usualStorage();
  const bool is_out = seen < parameters.min_depth || seen > parameters.max_depth;
  const bool is_unlikely = expected == Expected::kRoom && (seen < kNearRoom || seen > kFarRoom);
  const bool is_rotated = storage == kMultiplesOf8;
  if (!is_out && !is_unlikely && (storage.empty() || is_rotated)) return {};

  std::string text = describe();
  if (is_out) {
    text += fmt::format(", outside of {} to {} m", parameters.min_depth, parameters.max_depth);
  }
  if (!storage.empty()) return text + ": " + storage;
  return text + fmt::format(": is the depth unit wrong ({})?", unit_source) +
         otherUnit(seen, unit_);
}

}  // namespace mivo
