// SPDX-License-Identifier: BSD-3-Clause
#include <iostream>
#include <opencv2/core/utility.hpp>
#include <string>
#include <vector>

#include "core/execution/cpu_clock.h"
#include "evaluation/statistics.h"
#include "mivo/core/error.h"
#include "mivo/io/sequence_reader.h"
#include "mivo/io/trajectory_io.h"
#include "peer_odometry.h"
#include "programs/command_line.h"

namespace {

namespace po = boost::program_options;

struct Options {
  std::string folder;
  std::string output;
  std::string method;
  long long start = 0;
  long long count = 0;
  bool force = false;
};

struct Totals {
  std::size_t frames = 0;
  std::size_t lost = 0;
  std::size_t skipped_frames = 0;
  std::vector<double> cpu_ms;
  std::vector<double> undistortion_ms;
};

void declare(mivo::CommandLine& line, Options& options) {
  line.argument("FOLDER", &options.folder,
                "rgb.txt, depth.txt, [associations.txt,] camera.txt and images");
  line.options()("output", po::value(&options.output)->value_name("TRAJECTORY"),
                 "file for the trajectory (required)")(
      "method", po::value(&options.method)->value_name("rgbd|icp|rgbd_icp"),
      "OpenCV's RgbdOdometry, ICPOdometry or RgbdICPOdometry (required)")(
      "start", po::value(&options.start)->value_name("N")->default_value(0),
      "number of the first frame")("count", po::value(&options.count)->value_name("N"),
                                   "number of frames (default: all)")(
      "force", po::bool_switch(&options.force), "replace an existing file");
}

mivo::FrameRange rangeOf(const mivo::CommandLine& line, const Options& options) {
  mivo::FrameRange range;
  if (options.start < 0) throw mivo::UsageError("--start must not be negative");
  range.start = static_cast<std::size_t>(options.start);
  if (line.has("count")) {
    if (options.count < 1) throw mivo::UsageError("--count must be 1 at least");
    range.count = static_cast<std::size_t>(options.count);
  }
  return range;
}

mivo::Peer peerOf(const Options& options) {
  if (options.method.empty()) throw mivo::UsageError("--method rgbd|icp|rgbd_icp is missing");
  try {
    return mivo::toPeer(options.method);
  } catch (const mivo::Error& error) {
    throw mivo::UsageError(error.what());
  }
}

Totals track(mivo::SequenceReader& sequence, mivo::PeerOdometry& odometry,
             mivo::TrajectoryWriter& trajectory) {
  Totals totals;
  mivo::Frame frame;
  mivo::FrameFault fault;
  for (auto status = sequence.next(frame, fault); status != mivo::FrameSource::Status::kEnd;
       status = sequence.next(frame, fault)) {
    if (status == mivo::FrameSource::Status::kSkipped) {
      ++totals.skipped_frames;
      std::cerr << "skipped: " << fault.text << "\n";
      continue;
    }
    const double start = mivo::processMilliseconds();
    const bool is_tracked = odometry.process(frame);
    totals.cpu_ms.push_back(mivo::processMilliseconds() - start);
    totals.undistortion_ms.push_back(odometry.undistortionMilliseconds());
    trajectory.write({frame.stamp, odometry.T_odom_camera()});
    ++totals.frames;
    if (!is_tracked) ++totals.lost;
  }
  if (totals.frames == 0) {
    throw mivo::Error("there was no frame to track" +
                      (fault.text.empty() ? "" : ": " + fault.text));
  }
  return totals;
}

void print(const Totals& totals) {
  std::cout << "frames: " << totals.frames << "\n"
            << "tracked: " << totals.frames - totals.lost << "\n"
            << "lost: " << totals.lost << "\n"
            << "skipped_frames: " << totals.skipped_frames << "\n"
            << "cpu_ms_median: " << mivo::quantile(totals.cpu_ms, 0.5) << "\n"
            << "cpu_ms_p95: " << mivo::quantile(totals.cpu_ms, 0.95) << "\n"
            << "undistortion_ms_median: " << mivo::quantile(totals.undistortion_ms, 0.5) << "\n";
}

void run(int argc, char** argv) {
  Options options;
  mivo::CommandLine line("run_peer",
                         "One of OpenCV's RGB-D odometries over a sequence folder, frame to frame, "
                         "on one thread, to compare mivo with. Images are undistorted where the "
                         "camera needs it; a frame that OpenCV gives up keeps the last pose.");
  declare(line, options);
  if (!line.parse(argc, argv)) return;
  if (options.output.empty()) throw mivo::UsageError("--output TRAJECTORY is missing");
  const mivo::Peer peer = peerOf(options);
  const mivo::FrameRange range = rangeOf(line, options);

  cv::setNumThreads(1);
  mivo::SequenceReader sequence(options.folder, range);
  if (!sequence.notice().empty()) std::cerr << "run_peer: note: " << sequence.notice() << "\n";
  mivo::PeerOdometry odometry(peer, sequence.camera());
  mivo::TrajectoryWriter trajectory(options.output,
                                    options.force ? mivo::Overwrite::kYes : mivo::Overwrite::kNo);
  print(track(sequence, odometry, trajectory));
}

}  // namespace

int main(int argc, char** argv) {
  return mivo::runProgram("run_peer", [&] { run(argc, argv); });
}
