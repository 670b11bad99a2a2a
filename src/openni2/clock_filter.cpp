// SPDX-License-Identifier: BSD-3-Clause
#include "openni2/clock_filter.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace mivo {
namespace {

constexpr double kBucket = 0.5;        // s of device time, of which the least delayed image is kept
constexpr int kBuckets = 60;           // how far back the line looks: 30 s
constexpr double kSlopeSpan = 5.0;     // s that must be seen before the clocks' rates are compared
constexpr double kSlopeDoubt = 0.25;   // part of the span: see fitLine
constexpr double kMaxSlope = 0.001;    // crystals are better than 1000 ppm
constexpr double kSettle = 1.0;        // s at the start in which corrections act at once
constexpr double kFollowRate = 0.001;  // s per s, afterwards: invisible to a tracker
constexpr double kNews = 0.0005;       // s by which the difference falls when it is not yet known
constexpr int kQuiet = 20;             // images without such news
constexpr int kNear = 6;          // moments whose images came with the smallest delay, or nearly
constexpr double kMoment = 0.01;  // s, between images that were not taken together
constexpr double kJump = 0.5;     // s: more than USB and a busy machine delay
constexpr int kJumpCount = 5;     // images in a row, for a single one may just be very late
constexpr std::int64_t kSmallestStep = 1000;  // ns between two stamps of a stream

constexpr double kMicro = 1e-6;
constexpr double kNano = 1e-9;

}  // namespace

void ClockFilter::restart(std::uint64_t device_stamp, std::int64_t arrival) {
  started_ = true;
  first_device_ = device_stamp;
  first_arrival_ = arrival;
  buckets_.clear();
  last_device_ = 0.0;
  jumped_ = 0;
  floor_ = 0.0;
  quiet_ = 0;
  near_ = 0;
  last_near_ = -kJump;
  slope_ = 0.0;
  offset_ = 0.0;
  applied_ = 0.0;
  applied_at_ = 0.0;
  for (std::int64_t& last : last_) {
    if (last - arrival > static_cast<std::int64_t>(kJump / kNano)) {
      last = 0;  // the host's clock was set back: its users live in the new time too
    }
  }
}

void ClockFilter::observe(std::uint64_t device_stamp, std::int64_t arrival) {
  if (!started_) {
    restart(device_stamp, arrival);
  }
  const double device =
      static_cast<double>(static_cast<std::int64_t>(device_stamp - first_device_)) * kMicro;
  const double host = static_cast<double>(arrival - first_arrival_) * kNano;
  Point point{device, host - device};
  if (isJump(point)) {
    if (++jumped_ < kJumpCount) {
      return;
    }
    restart(device_stamp, arrival);
    point = {0.0, 0.0};
  }
  jumped_ = 0;
  ++quiet_;
  if (point.difference < floor_ - kNews) {
    floor_ = point.difference;
    quiet_ = 0;
    near_ = 0;
  }
  // Color and depth of one moment are late together and count once.
  if (point.difference < floor_ + kNews && std::abs(device - last_near_) > kMoment) {
    ++near_;
    last_near_ = device;
  }
  add(point);
  fitLine();
  follow(std::max(device, applied_at_));
}

bool ClockFilter::isSettled() const {
  // What delays images on a busy machine spreads their delays; only where nothing does they agree.
  return started_ && quiet_ >= kQuiet && near_ >= kNear;
}

bool ClockFilter::isJump(const Point& point) {
  // A stamp that lags by seconds, or an arrival that contradicts the line by half a second.
  const bool jump = !buckets_.empty() &&
                    (std::abs(point.difference - (offset_ + slope_ * point.device)) > kJump ||
                     point.device < last_device_ - kJump);
  last_device_ = jump ? last_device_ : std::max(last_device_, point.device);
  return jump;
}

void ClockFilter::add(const Point& point) {
  const auto number = static_cast<std::int64_t>(std::floor(point.device / kBucket));
  if (!buckets_.empty() && number <= buckets_.back().number) {
    // A late image of the other stream may belong further back.
    const auto bucket = std::find_if(buckets_.rbegin(), buckets_.rend(),
                                     [&](const Bucket& b) { return b.number == number; });
    if (bucket != buckets_.rend() && point.difference < bucket->lowest.difference) {
      bucket->lowest = point;
    }
    return;
  }
  buckets_.push_back({number, point});
  while (buckets_.back().number - buckets_.front().number >= kBuckets) {
    buckets_.pop_front();
  }
}

std::vector<ClockFilter::Point> ClockFilter::lowerHull() const {
  std::vector<Point> hull;
  for (const Bucket& bucket : buckets_) {
    const Point& p = bucket.lowest;
    while (hull.size() >= 2) {
      const Point& a = hull[hull.size() - 2];
      const Point& b = hull.back();
      const double turn = (b.device - a.device) * (p.difference - a.difference) -
                          (b.difference - a.difference) * (p.device - a.device);
      if (turn > 0.0) {
        break;
      }
      hull.pop_back();
    }
    hull.push_back(p);
  }
  return hull;
}

double ClockFilter::offsetBelowAll(double slope) const {
  double offset = std::numeric_limits<double>::max();
  for (const Bucket& bucket : buckets_) {
    offset = std::min(offset, bucket.lowest.difference - slope * bucket.lowest.device);
  }
  return offset;
}

void ClockFilter::fitLine() {
  const double begin = buckets_.front().lowest.device;
  const double end = buckets_.back().lowest.device;
  slope_ = 0.0;
  if (end - begin >= kSlopeSpan) {
    // Of all lines below the points the highest in the middle has the least area between; it runs
    // along an edge of their hull. A level line is kept unless a slope gains what a true one must:
    // half of what it climbs, less what late points take away.
    const double middle = 0.5 * (begin + end);
    const double doubt = kSlopeDoubt * (end - begin);
    double highest = offsetBelowAll(0.0);
    const std::vector<Point> hull = lowerHull();
    for (std::size_t i = 1; i < hull.size(); ++i) {
      const double slope = std::clamp(
          (hull[i].difference - hull[i - 1].difference) / (hull[i].device - hull[i - 1].device),
          -kMaxSlope, kMaxSlope);
      const double height = offsetBelowAll(slope) + slope * middle - doubt * std::abs(slope);
      if (height > highest) {
        highest = height;
        slope_ = slope;
      }
    }
  }
  offset_ = offsetBelowAll(slope_);
}

void ClockFilter::follow(double device) {
  const double target = offset_ + slope_ * device;
  const double elapsed = device - applied_at_;
  const double predicted = applied_ + slope_ * elapsed;
  if (device < kSettle) {
    applied_ = target;
  } else {
    const double limit = kFollowRate * elapsed;
    applied_ = predicted + std::clamp(target - predicted, -limit, limit);
  }
  applied_at_ = device;
}

std::int64_t ClockFilter::hostTime(StreamKind kind, std::uint64_t device_stamp) {
  const auto since_first = static_cast<std::int64_t>(device_stamp - first_device_);
  const double device = static_cast<double>(since_first) * kMicro;
  const double difference = applied_ + slope_ * (device - applied_at_);
  std::int64_t host = first_arrival_ + since_first * 1000 + std::llround(difference / kNano);
  std::int64_t& last = last_[static_cast<std::size_t>(kind)];
  if (last != 0 && host < last + kSmallestStep) {
    host = last + kSmallestStep;
  }
  last = host;
  return host;
}

}  // namespace mivo
