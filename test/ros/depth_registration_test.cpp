// SPDX-License-Identifier: BSD-3-Clause
#include "ros/depth_registration.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

#include "ros/expect_error.h"

namespace mivo {
namespace {

Camera cameraOf(int width, int height, double f) {
  Camera camera;
  camera.width = width;
  camera.height = height;
  camera.fx = camera.fy = f;
  camera.cx = 0.5 * (width - 1);
  camera.cy = 0.5 * (height - 1);
  return camera;
}

/// Depth of the plane n . X = distance, in meters.
cv::Mat planeDepth(const Camera& camera, const Eigen::Vector3d& normal, double distance) {
  cv::Mat depth(camera.height, camera.width, CV_32FC1);
  for (int y = 0; y < camera.height; ++y) {
    for (int x = 0; x < camera.width; ++x) {
      depth.at<float>(y, x) = static_cast<float>(distance / normal.dot(*camera.ray({x, y})));
    }
  }
  return depth;
}

TEST(EnlargeDepthTest, APlaneStaysAPlane) {
  const Camera large = cameraOf(96, 72, 90.0);
  Camera small = cameraOf(48, 36, 45.0);
  const Eigen::Vector3d normal = Eigen::Vector3d(0.2, -0.1, 1.0).normalized();
  const DepthImage enlarged = enlargeDepth({planeDepth(small, normal, 2.0), 0.001}, {96, 72});
  ASSERT_EQ(enlarged.image.type(), CV_32FC1);
  EXPECT_LT(cv::norm(enlarged.image, planeDepth(large, normal, 2.0), cv::NORM_INF), 1e-5);
}

TEST(EnlargeDepthTest, EdgesAndHolesStayWhereTheyAre) {
  cv::Mat small(4, 4, CV_16UC1, cv::Scalar(1000));
  small.colRange(2, 4) = 3000;
  small.at<std::uint16_t>(0, 0) = 0;
  const DepthImage large = enlargeDepth({small, 0.001}, {12, 12});
  for (int x = 0; x < 12; ++x) {
    EXPECT_FLOAT_EQ(large.image.at<float>(8, x), x < 6 ? 1.0F : 3.0F) << x;
  }
  for (int y = 0; y < 3; ++y) {
    for (int x = 0; x < 3; ++x) EXPECT_TRUE(std::isnan(large.image.at<float>(y, x)));
  }
  EXPECT_FLOAT_EQ(large.image.at<float>(3, 3), 1.0F);
}

TEST(EnlargeDepthTest, OtherRatiosAreLeftAlone) {
  const cv::Mat depth(4, 4, CV_16UC1, cv::Scalar(1000));
  for (const cv::Size& size : {cv::Size(4, 4), cv::Size(8, 12), cv::Size(6, 6), cv::Size(2, 2)}) {
    EXPECT_EQ(enlargeDepth({depth, 0.001}, size).image.data, depth.data);
  }
}

/// 5 cm to the left of the color camera, turned a little, as of a Kinect.
Eigen::Isometry3d depthInColor() {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.translation() << -0.05, 0.002, 0.004;
  T.linear() = Eigen::AngleAxisd(0.01, Eigen::Vector3d(0.3, 1.0, 0.2).normalized()).matrix();
  return T;
}

TEST(DepthRegistrationTest, APlaneIsWhereTheColorCameraSeesIt) {
  const Camera depth_camera = cameraOf(160, 120, 145.0);
  Camera color_camera = cameraOf(160, 120, 130.0);
  color_camera.distortion = {0.1, -0.2, 0.001, 0.0, 0.0};
  const Eigen::Isometry3d T = depthInColor();
  const Eigen::Vector3d normal = Eigen::Vector3d(0.1, 0.2, 1.0).normalized();  // in depth
  const Eigen::Vector3d turned = T.linear() * normal;
  const double distance = 2.0 + turned.dot(T.translation());
  DepthRegistration registration;
  const DepthImage seen = registration.toColor({planeDepth(depth_camera, normal, 2.0), 0.001},
                                               depth_camera, color_camera, T);
  const cv::Mat expected = planeDepth(color_camera, turned, distance);
  int readings = 0;
  for (int y = 12; y < 108; ++y) {
    for (int x = 16; x < 138; ++x) {
      const float meters = seen.image.at<float>(y, x);
      ASSERT_FALSE(std::isnan(meters)) << x << " " << y;  // no seams
      // A pixel's depth is that of the reading beside it: half a pixel of the slope.
      EXPECT_NEAR(meters, expected.at<float>(y, x), 0.006F);
      ++readings;
    }
  }
  EXPECT_GT(readings, 1000);
}

TEST(DepthRegistrationTest, WhatTheColorCameraDoesNotSeeIsHidden) {
  // A board 1 m away hides a part of the wall at 3 m from the color camera, to its left, that the
  // depth camera sees.
  const Camera camera = cameraOf(160, 120, 140.0);
  cv::Mat depth(120, 160, CV_16UC1, cv::Scalar(3000));
  depth.colRange(60, 100) = 1000;
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.translation().x() = 0.1;  // of depth, to the right
  DepthRegistration registration;
  const DepthImage seen = registration.toColor({depth, 0.001}, camera, camera, T);
  // The board moves by 14 pixels, the wall by 4.7: between them is no reading, but the board hides
  // the wall on its other side.
  const auto at = [&](int x) { return seen.image.at<float>(60, x); };
  for (int x = 74; x < 114; ++x) EXPECT_FLOAT_EQ(at(x), 1.0F) << x;
  for (int x = 6; x < 64; ++x) EXPECT_FLOAT_EQ(at(x), 3.0F) << x;
  for (int x = 66; x < 73; ++x) EXPECT_TRUE(std::isnan(at(x))) << x;
  for (int x = 115; x < 158; ++x) EXPECT_FLOAT_EQ(at(x), 3.0F) << x;
}

TEST(DepthRegistrationTest, AnotherSizeThanItsCalibrationsIsRefused) {
  const Camera camera = cameraOf(160, 120, 140.0);
  DepthRegistration registration;
  EXPECT_ERROR(registration.toColor({cv::Mat(60, 80, CV_16UC1), 0.001}, camera, camera,
                                    Eigen::Isometry3d::Identity()),
               "80 x 60 pixels, but its camera_info is for 160 x 120");
}

}  // namespace
}  // namespace mivo
