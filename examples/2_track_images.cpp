// SPDX-License-Identifier: BSD-3-Clause
// Tracks images loaded by OpenCV, here from two folders of files sorted by name, and prints the
// standard deviation of each pose. A loop over cv::VideoCapture looks the same.
//   2_track_images COLOR_FOLDER DEPTH_FOLDER FX FY CX CY
// Depth: 16 bits, millimeters, registered to color.
#include <mivo/core/error.h>
#include <mivo/core/odometry.h>

#include <iostream>
#include <memory>
#include <opencv2/core/utility.hpp>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

int main(int argc, char** argv) {
  if (argc != 7) {
    std::cerr << "usage: 2_track_images COLOR_FOLDER DEPTH_FOLDER FX FY CX CY\n";
    return 2;
  }
  try {
    std::vector<cv::String> images;
    std::vector<cv::String> depths;
    cv::glob(std::string(argv[1]) + "/*.png", images);
    cv::glob(std::string(argv[2]) + "/*.png", depths);
    std::unique_ptr<mivo::Odometry> odometry;

    for (std::size_t i = 0; i < images.size() && i < depths.size(); ++i) {
      const cv::Mat image = cv::imread(images[i], cv::IMREAD_COLOR);
      const cv::Mat depth = cv::imread(depths[i], cv::IMREAD_UNCHANGED);
      if (image.empty() || depth.empty()) continue;
      if (!odometry) {
        const mivo::Camera camera{image.cols,         image.rows,         std::stod(argv[3]),
                                  std::stod(argv[4]), std::stod(argv[5]), std::stod(argv[6]),
                                  mivo::Distortion{}};
        odometry = std::make_unique<mivo::Odometry>(camera, mivo::Parameters());
      }
      const double stamp = static_cast<double>(i) / 30.0;  // s; use the camera's time stamp
      const mivo::TrackingResult& result =
          odometry->process({stamp, mivo::toGray(image, mivo::ChannelOrder::kBgr), depth, 0.001});
      if (!result.isMeasured()) {  // lost or refused: the pose is a guess, do not use it
        std::cout << i << " " << toString(result.state) << ": " << describeReason(result) << "\n";
        continue;
      }
      // Standard deviations of position and rotation, in the axes of the camera.
      const mivo::Vector6 sigma = result.covariance.diagonal().cwiseSqrt();
      std::cout << i << " " << toString(result.state) << " segment " << result.segment << " at "
                << result.T_odom_camera.translation().transpose() << " m, sigma "
                << sigma.head<3>().norm() << " m " << sigma.tail<3>().norm() << " rad\n";
    }
  } catch (const std::exception& error) {
    std::cerr << error.what() << "\n";
    return 1;
  }
  return 0;
}
