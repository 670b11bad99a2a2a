// SPDX-License-Identifier: BSD-3-Clause
#include "ros/keyframe_cloud.h"

#include <sensor_msgs/point_cloud2_iterator.h>

#include <algorithm>
#include <boost/make_shared.hpp>
#include <cstdint>

namespace mivo {
namespace {

/// Bytes of a PointCloud2's rgb in memory: blue, green, red.
void setColor(const CloudPoint& point, const ColorImage& color, std::uint8_t* bgr) {
  const cv::Mat& image = color.image;
  const bool is_in_color = image.depth() == CV_8U && image.channels() >= 3 &&
                           point.row < image.rows && point.column < image.cols;
  if (!is_in_color) {
    std::fill_n(bgr, 3, static_cast<std::uint8_t>(point.intensity));
    return;
  }
  const auto* pixel = image.ptr<std::uint8_t>(point.row) + point.column * image.channels();
  std::copy_n(pixel, 3, bgr);
  if (color.order == ChannelOrder::kRgb) std::swap(bgr[0], bgr[2]);
}

}  // namespace

sensor_msgs::PointCloud2Ptr toCloud(const std::vector<CloudPoint>& points,
                                    const Eigen::Isometry3d& T, const ColorImage& color) {
  const auto message = boost::make_shared<sensor_msgs::PointCloud2>();
  message->height = 1;
  message->is_dense = true;
  sensor_msgs::PointCloud2Modifier modifier(*message);
  modifier.setPointCloud2Fields(
      5, "x", 1, sensor_msgs::PointField::FLOAT32, "y", 1, sensor_msgs::PointField::FLOAT32, "z", 1,
      sensor_msgs::PointField::FLOAT32, "rgb", 1, sensor_msgs::PointField::FLOAT32, "intensity", 1,
      sensor_msgs::PointField::FLOAT32);
  modifier.resize(points.size());
  sensor_msgs::PointCloud2Iterator<float> position(*message, "x");
  sensor_msgs::PointCloud2Iterator<std::uint8_t> rgb(*message, "rgb");
  sensor_msgs::PointCloud2Iterator<float> intensity(*message, "intensity");
  for (const CloudPoint& point : points) {
    const Eigen::Vector3f p = (T * Eigen::Vector3d(point.x, point.y, point.z)).cast<float>();
    std::copy_n(p.data(), 3, &position[0]);
    setColor(point, color, &rgb[0]);
    *intensity = point.intensity;
    ++position;
    ++rgb;
    ++intensity;
  }
  return message;
}

}  // namespace mivo
