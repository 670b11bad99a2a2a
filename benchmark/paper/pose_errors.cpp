// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <iostream>
#include <string>

#include "mivo/core/error.h"
#include "mivo/io/trajectory_io.h"
#include "programs/command_line.h"
#include "random_twist.h"
#include "true_poses.h"

// The paper's error, one row per frame: Eq. 6 with the steps from frame to frame, or (section IV-C,
// static tests) with the motion since the first frame.

namespace {

namespace po = boost::program_options;

constexpr double kMaxTimeDifference = 0.02;  // s, as evaluate_trajectory

void run(int argc, char** argv) {
  std::string truth_path;
  std::string estimate_path;
  std::string reference;
  mivo::CommandLine line("pose_errors",
                         "Prints the error of each pose as the paper defines it (Eq. 6), in rows "
                         "'stamp,translation_m,rotation_rad'.");
  line.argument("TRUTH", &truth_path, "true trajectory");
  line.argument("ESTIMATE", &estimate_path, "estimated trajectory");
  line.options()("reference", po::value(&reference)->value_name("first"),
                 "motion since the first frame, instead of since the frame before");
  if (!line.parse(argc, argv)) return;
  if (!reference.empty() && reference != "first") {
    throw mivo::UsageError("--reference knows 'first' only");
  }

  const mivo::TruePoses truth(truth_path, kMaxTimeDifference);
  const mivo::Trajectory estimate = mivo::sortedByStamp(mivo::readTrajectory(estimate_path));
  if (estimate.size() < 2) throw mivo::Error(estimate_path + ": fewer than two poses");
  std::cout << "stamp,translation_m,rotation_rad\n";
  for (std::size_t i = 1; i < estimate.size(); ++i) {
    const mivo::StampedPose& from = estimate[reference.empty() ? i - 1 : 0];
    const Eigen::Isometry3d motion = from.pose.inverse() * estimate[i].pose;
    const Eigen::Isometry3d true_motion =
        truth.at(from.stamp).inverse() * truth.at(estimate[i].stamp);
    const mivo::PoseDifference error = mivo::difference(motion.inverse(), true_motion.inverse());
    std::cout << fmt::format("{:.6f},{:.9g},{:.9g}\n", estimate[i].stamp, error.translation,
                             error.rotation);
  }
}

}  // namespace

int main(int argc, char** argv) {
  return mivo::runProgram("pose_errors", [&] { run(argc, argv); });
}
