// SPDX-License-Identifier: BSD-3-Clause
#include "programs/plane_sequence.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <opencv2/core.hpp>
#include <sstream>

#include "io/image_file.h"
#include "mivo/core/se3.h"
#include "mivo/io/trajectory_io.h"

namespace mivo {
namespace {

namespace fs = std::filesystem;

// The plane n . X = d of the world, meters: slanted, so that depth constrains all six directions of
// motion.
const Eigen::Vector3d kNormal = Eigen::Vector3d(0.2, -0.1, 1.0).normalized();
constexpr double kDistance = 1.5;

/// Gray value at a point of the plane: waves of several lengths and directions, 40..210.
double texture(double x, double y) {
  double sum = 0.0;
  for (int i = 1; i <= 6; ++i) {
    const double direction = 2.4 * i;
    const double frequency = 4.0 + 7.0 * i;  // rad/m
    sum += std::sin(frequency * (x * std::cos(direction) + y * std::sin(direction)) + i) / 6.0;
  }
  return 125.0 + 85.0 * sum;
}

}  // namespace

SequenceCamera planeCamera() {
  return {{160, 120, 140.0, 140.0, 79.5, 59.5, {}}, 1000.0};
}

Eigen::Isometry3d planePose(int i) {
  Vector6 twist;
  twist << 0.006, -0.003, 0.004, 0.002, 0.004, -0.003;
  return expSe3(i * twist);
}

double planeStamp(int i) {
  return 100.0 + i / 30.0;
}

void renderPlane(const Eigen::Isometry3d& T_world_camera, cv::Mat& image, cv::Mat& depth) {
  const Camera camera = planeCamera().camera;
  image.create(camera.height, camera.width, CV_8UC1);
  depth.create(camera.height, camera.width, CV_32FC1);
  for (int y = 0; y < camera.height; ++y) {
    for (int x = 0; x < camera.width; ++x) {
      const Eigen::Vector3d ray((x - camera.cx) / camera.fx, (y - camera.cy) / camera.fy, 1.0);
      const double z = (kDistance - kNormal.dot(T_world_camera.translation())) /
                       kNormal.dot(T_world_camera.linear() * ray);
      const Eigen::Vector3d point = T_world_camera * (z * ray);
      image.at<unsigned char>(y, x) =
          static_cast<unsigned char>(std::lround(texture(point.x(), point.y())));
      depth.at<float>(y, x) = static_cast<float>(z);
    }
  }
}

void writePlaneSequence(const std::string& folder, int frames) {
  SequenceWriter writer(folder, planeCamera(), Overwrite::kNo);
  cv::Mat image;
  cv::Mat depth;
  for (int i = 0; i < frames; ++i) {
    renderPlane(planePose(i), image, depth);
    writer.writeFrame(planeStamp(i), image, planeStamp(i), depth);
    writer.writePose({planeStamp(i), planePose(i)});
  }
}

void writeSun3dPlaneSequence(const std::string& folder, int frames) {
  for (const char* images : {"image", "depth"}) fs::create_directories(fs::path(folder) / images);
  const Camera camera = planeCamera().camera;
  std::ofstream(fs::path(folder) / "intrinsics.txt")
      << camera.fx << " 0 " << camera.cx << "\n0 " << camera.fy << ' ' << camera.cy << "\n0 0 1\n";
  cv::Mat image;
  cv::Mat meters;
  for (int i = 0; i < frames; ++i) {
    renderPlane(planePose(i), image, meters);
    cv::Mat depth;
    meters.convertTo(depth, CV_16U, planeCamera().depth_units_per_meter);
    depth.forEach<std::uint16_t>([](std::uint16_t& value, const int*) {
      value = static_cast<std::uint16_t>(value << 3 | value >> 13);
    });
    std::ostringstream name;
    name << std::setfill('0') << std::setw(7) << i + 1 << '-' << std::setw(12)
         << std::lround(i * 1e6 / 30.0) << ".png";
    writePng((fs::path(folder) / "image" / name.str()).string(), image, Overwrite::kNo);
    writePng((fs::path(folder) / "depth" / name.str()).string(), depth, Overwrite::kNo);
  }
}

double largestPlaneError(const std::string& trajectory, int first_frame) {
  const Eigen::Isometry3d start = planePose(first_frame);
  double largest = 0.0;
  for (const StampedPose& pose : readTrajectory(trajectory)) {
    const int i = static_cast<int>(std::lround((pose.stamp - planeStamp(0)) * 30.0));
    const Eigen::Isometry3d truth = start.inverse() * planePose(i);
    largest = std::max(largest, (pose.pose.translation() - truth.translation()).norm());
  }
  return largest;
}

}  // namespace mivo
