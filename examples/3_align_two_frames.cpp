// SPDX-License-Identifier: BSD-3-Clause
// Aligns two frames of a folder, prints the motion of the camera between them, and writes the
// residual image.
//   3_align_two_frames FOLDER FIRST SECOND RESIDUAL.png
#include <mivo/core/error.h>
#include <mivo/core/odometry.h>
#include <mivo/io/sequence_reader.h>

#include <iostream>
#include <opencv2/imgcodecs.hpp>
#include <string>

namespace {

mivo::Frame readFrame(const std::string& folder, std::size_t number) {
  mivo::SequenceReader reader(folder, mivo::FrameRange{number, 1});
  mivo::Frame frame;
  mivo::FrameFault fault;
  if (reader.next(frame, fault) != mivo::FrameSource::Status::kFrame) throw mivo::Error(fault.text);
  return frame;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 5) {
    std::cerr << "usage: 3_align_two_frames FOLDER FIRST SECOND RESIDUAL.png\n";
    return 2;
  }
  try {
    const std::string folder = argv[1];
    mivo::Odometry odometry(mivo::SequenceReader(folder).camera(), mivo::Parameters());
    odometry.process(readFrame(folder, std::stoul(argv[2])));  // becomes the keyframe
    const mivo::TrackingResult& result = odometry.process(readFrame(folder, std::stoul(argv[3])));

    const Eigen::AngleAxisd rotation(result.T_odom_camera.linear());
    std::cout << toString(result.state) << ": translation "
              << result.T_odom_camera.translation().transpose() << " m, rotation "
              << rotation.angle() << " rad\n";
    const cv::Mat residual = odometry.residualImage();  // 128: both images agree
    std::cout << "mean difference "
              << cv::norm(residual, cv::Mat(residual.size(), residual.type(), 128), cv::NORM_L1) /
                     static_cast<double>(residual.total())
              << " gray levels\n";
    if (!cv::imwrite(argv[4], residual)) throw mivo::Error("cannot write " + std::string(argv[4]));
  } catch (const std::exception& error) {
    std::cerr << error.what() << "\n";
    return 1;
  }
  return 0;
}
