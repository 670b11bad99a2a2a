// SPDX-License-Identifier: BSD-3-Clause
#include "ros/bag_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <ostream>

#include "mivo/core/error.h"
#include "ros/header_only.h"
#include "ros/stamp.h"

namespace mivo {
namespace {

constexpr double kGapPeriods = 2.5;        // a gap is longer
constexpr double kClockDifference = 10.0;  // s between stamp and recording that no latency explains
constexpr double kClockOffset = 0.1;       // s
constexpr double kEdgeShift = 1.5;         // pixels
constexpr double kExposureJump = 0.15;     // of the brightness, from frame to frame
constexpr double kBlurred = 0.5;           // of the median sharpness
constexpr double kLittleDepth = 0.3;       // of the pixels
constexpr std::size_t kMostFrames = 1500;  // that are decoded
constexpr std::size_t kEdgeFrames = 20;    // that are searched for edges

double median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

StreamReport reportOn(const Recording& recording, const std::string& name,
                      const std::string& topic) {
  StreamReport report;
  report.name = name;
  report.topic = topic;
  std::vector<double> periods;
  std::vector<double> ages;
  std::optional<double> last;
  for (const RecordedMessage& message : recording.messages({topic})) {
    const double stamp = toSeconds(message.read<HeaderOnly>()->header.stamp);
    ++report.messages;
    ages.push_back(toSeconds(message.time()) - stamp);
    if (last && stamp > *last) {
      periods.push_back(stamp - *last);
      report.longest_gap = std::max(report.longest_gap, periods.back());
    }
    if (last && stamp <= *last) ++report.late;
    last = stamp;
  }
  const double period = median(periods);
  report.rate = period > 0.0 ? 1.0 / period : 0.0;
  report.gaps = static_cast<std::size_t>(std::count_if(
      periods.begin(), periods.end(), [&](double p) { return p > kGapPeriods * period; }));
  report.age = median(ages);
  return report;
}

Frame withMirroredImage(const Frame& frame) {
  constexpr int kLeftAndRight = 1;  // change places
  Frame mirrored = frame;
  mirrored.image = cv::Mat();
  cv::flip(frame.image, mirrored.image, kLeftAndRight);
  return mirrored;
}

/// Decodes the frames: all, or evenly spread ones where there are many.
void lookAtFrames(BagSource& source, BagReport& report) {
  const std::size_t step = std::max<std::size_t>(1, source.size() / kMostFrames);
  const std::size_t edge_step = std::max<std::size_t>(1, source.size() / kEdgeFrames);
  EdgeOffset edges;
  EdgeOffset mirrored;
  Frame frame;
  FrameFault fault;
  for (std::size_t i = 0; i < source.size(); ++i) {
    if (i % step != 0) {
      source.passOver();
      continue;
    }
    if (source.next(frame, fault) != FrameSource::Status::kFrame) {
      ++report.unreadable[fault.reason];
      continue;
    }
    report.frames.push_back(lookAt(frame));
    if (i % edge_step >= step) continue;
    edges.add(frame);
    mirrored.add(withMirroredImage(frame));
  }
  report.is_mirrored = mirrored.shift() && mirrored.clarity() > edges.clarity();
  if (!report.is_mirrored) report.edge_shift = edges.shift();
}

std::size_t countBlurred(const std::vector<FrameLook>& frames) {
  std::vector<double> sharpness;
  for (const FrameLook& look : frames) sharpness.push_back(look.sharpness);
  const double usual = median(sharpness);
  return static_cast<std::size_t>(std::count_if(
      sharpness.begin(), sharpness.end(), [&](double value) { return value < kBlurred * usual; }));
}

std::size_t countExposureJumps(const std::vector<FrameLook>& frames) {
  std::size_t jumps = 0;
  for (std::size_t i = 1; i < frames.size(); ++i) {
    const double before = frames[i - 1].brightness;
    if (std::abs(frames[i].brightness - before) > kExposureJump * std::max(1.0, before)) ++jumps;
  }
  return jumps;
}

template <typename Value>
double medianOf(const std::vector<FrameLook>& frames, Value FrameLook::*member) {
  std::vector<double> values;
  for (const FrameLook& look : frames) values.push_back(look.*member);
  return median(values);
}

void warnOfStreams(BagReport& report) {
  const auto warn = [&](const std::string& text) { report.warnings.push_back(text); };
  for (const StreamReport& stream : report.streams) {
    if (stream.name == "calibration") continue;  // drivers may send it once
    if (stream.gaps > 0) {
      warn(
          fmt::format("{}: {} gaps, the longest {:.3f} s: messages were lost (record to a fast "
                      "disk, with --buffsize 0 and --lz4)",
                      stream.topic, stream.gaps, stream.longest_gap));
    }
    if (stream.late > 0) {
      warn(fmt::format("{}: {} stamps are not newer than the one before", stream.topic,
                       stream.late));
    }
    if (std::abs(stream.age) > kClockDifference) {
      warn(fmt::format("{}: stamps are {:.0f} s {} than the clock of the recording", stream.topic,
                       std::abs(stream.age), stream.age > 0.0 ? "older" : "newer"));
    }
  }
}

void warnOfTimes(BagReport& report) {
  const auto warn = [&](const std::string& text) { report.warnings.push_back(text); };
  for (const auto& [reason, count] : report.left_out) {
    warn(fmt::format("{} left out: {}", count, reason));
  }
  if (report.clock_offset && std::abs(*report.clock_offset) > kClockOffset) {
    warn(fmt::format("color and depth that came together are stamped {:.3f} s apart",
                     std::abs(*report.clock_offset)));
  }
}

void warnOfImages(BagReport& report) {
  const auto warn = [&](const std::string& text) { report.warnings.push_back(text); };
  for (const auto& [reason, count] : report.unreadable) {
    warn(fmt::format("{} frames cannot be used: {}", count, reason));
  }
  if (report.calibrations > 1) {
    warn(fmt::format("{} calibrations: tracking restarts with each", report.calibrations));
  }
  if (report.edge_shift && std::hypot(report.edge_shift->x, report.edge_shift->y) > kEdgeShift) {
    warn(fmt::format(
        "edges of depth lie {:.1f} pixels to the {} and {:.1f} pixels {} of those of "
        "color: depth is not registered, or by a wrong calibration",
        std::abs(report.edge_shift->x), report.edge_shift->x > 0.0 ? "left" : "right",
        std::abs(report.edge_shift->y), report.edge_shift->y > 0.0 ? "above" : "below"));
  }
  if (report.is_mirrored) {
    warn(
        "edges of depth lie where those of color would be if it were mirrored: one of the two is "
        "(image_mirroring of the driver)");
  }
  const std::size_t jumps = countExposureJumps(report.frames);
  if (jumps > 0) warn(fmt::format("the exposure jumps {} times by more than 15 %", jumps));
  const std::size_t blurred = countBlurred(report.frames);
  if (blurred > 0) {
    warn(fmt::format("{} frames are blurred: half as sharp as usual, or less", blurred));
  }
  const double coverage = medianOf(report.frames, &FrameLook::depth_coverage);
  if (!report.frames.empty() && coverage < kLittleDepth) {
    warn(fmt::format("only {:.0f} % of the pixels have depth", 100.0 * coverage));
  }
}

}  // namespace

BagReport checkBag(const std::vector<std::string>& paths, const RgbdTopics& wanted) {
  BagSource source(paths, wanted);
  const RgbdTopics& topics = source.topics();
  BagReport report;
  report.layout = layoutOf(topics);
  report.streams = {reportOn(source.recording(), "color", topics.color),
                    reportOn(source.recording(), "depth", topics.depth),
                    reportOn(source.recording(), "calibration", topics.camera_info)};
  report.pairs = source.size();
  report.left_out = source.leftOut();
  report.pair_offset = source.pairOffset();
  report.clock_offset = source.clockOffset();
  report.camera = source.camera();
  report.calibrations = source.calibrations();
  report.notice = source.notice();
  lookAtFrames(source, report);
  if (!report.notice.empty()) report.warnings.push_back(report.notice);
  warnOfStreams(report);
  warnOfTimes(report);
  warnOfImages(report);
  return report;
}

void print(std::ostream& stream, const BagReport& report) {
  stream << "layout: " << report.layout << "\n";
  for (const StreamReport& s : report.streams) {
    stream << fmt::format(
        "{}: {}, {} messages, {:.2f} Hz, longest gap {:.3f} s, recorded {:.3f} s "
        "after the stamp\n",
        s.name, s.topic, s.messages, s.rate, s.longest_gap, s.age);
  }
  const Camera& c = report.camera;
  stream << fmt::format("pairs: {}\npair_offset_s: {:.6f}\n", report.pairs, report.pair_offset);
  if (report.clock_offset) stream << fmt::format("clock_offset_s: {:.3f}\n", *report.clock_offset);
  stream << fmt::format("camera: {} x {} pixels, fx {:.6g}, fy {:.6g}, cx {:.6g}, cy {:.6g}\n",
                        c.width, c.height, c.fx, c.fy, c.cx, c.cy);
  if (report.edge_shift) {
    stream << fmt::format("edge_shift_px: {:.2f} {:.2f}\n", report.edge_shift->x,
                          report.edge_shift->y);
  } else {
    stream << "edge_shift_px: too few edges to tell\n";
  }
  stream << fmt::format("frames_looked_at: {}\nexposure_jumps: {}\nblurred: {}\n",
                        report.frames.size(), countExposureJumps(report.frames),
                        countBlurred(report.frames))
         << fmt::format("depth_coverage: {:.3f}\nmedian_depth_m: {:.3f}\n",
                        medianOf(report.frames, &FrameLook::depth_coverage),
                        medianOf(report.frames, &FrameLook::median_depth));
  for (const std::string& warning : report.warnings) stream << "warning: " << warning << "\n";
}

std::string toCsv(const BagReport& report) {
  std::string text = "stamp,brightness,sharpness,depth_coverage,median_depth_m\n";
  for (const FrameLook& look : report.frames) {
    text += fmt::format("{:.6f},{:.3f},{:.5f},{:.4f},{:.4f}\n", look.stamp, look.brightness,
                        look.sharpness, look.depth_coverage, look.median_depth);
  }
  return text;
}

}  // namespace mivo
