// SPDX-License-Identifier: BSD-3-Clause
#include "ros/frustum.h"

namespace mivo {

geometry_msgs::Point toPoint(const Eigen::Vector3d& v) {
  geometry_msgs::Point point;
  point.x = v.x();
  point.y = v.y();
  point.z = v.z();
  return point;
}

void addFrustum(const Camera& camera, const Eigen::Isometry3d& T, double depth,
                std::vector<geometry_msgs::Point>& points) {
  const double right = camera.width - 0.5;
  const double bottom = camera.height - 0.5;
  const Eigen::Vector2d corners[] = {{-0.5, -0.5}, {right, -0.5}, {right, bottom}, {-0.5, bottom}};
  const geometry_msgs::Point center = toPoint(T.translation());
  geometry_msgs::Point ends[4];
  for (int i = 0; i < 4; ++i) {
    // A corner that the lens has no ray for is drawn where a pinhole would see it.
    const Eigen::Vector3d pinhole((corners[i].x() - camera.cx) / camera.fx,
                                  (corners[i].y() - camera.cy) / camera.fy, 1.0);
    ends[i] = toPoint(T * (depth * camera.ray(corners[i]).value_or(pinhole)));
  }
  for (int i = 0; i < 4; ++i) {
    points.insert(points.end(), {center, ends[i], ends[i], ends[(i + 1) % 4]});
  }
}

}  // namespace mivo
