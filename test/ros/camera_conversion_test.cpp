// SPDX-License-Identifier: BSD-3-Clause
#include "ros/camera_conversion.h"

#include <gtest/gtest.h>

#include <limits>

#include "ros/expect_error.h"

namespace mivo {
namespace {

Camera makeCamera() {
  Camera camera;
  camera.width = 640;
  camera.height = 480;
  camera.fx = 517.3;
  camera.fy = 516.5;
  camera.cx = 318.6;
  camera.cy = 255.3;
  camera.distortion = {0.2624, -0.9531, -0.0054, 0.0026, 1.1633};
  return camera;
}

TEST(CameraConversionTest, RoundTripIsExact) {
  EXPECT_EQ(makeCamera(), toCamera(toCameraInfo(makeCamera()), false));
}

TEST(CameraConversionTest, RectifiedImagesHaveThePinholeOfP) {
  sensor_msgs::CameraInfo info = toCameraInfo(makeCamera());
  info.P[0] = 500.0;
  info.P[5] = 501.0;
  info.P[2] = 320.5;
  info.P[6] = 240.5;
  const Camera camera = toCamera(info, true);
  EXPECT_EQ(500.0, camera.fx);
  EXPECT_EQ(501.0, camera.fy);
  EXPECT_EQ(320.5, camera.cx);
  EXPECT_EQ(240.5, camera.cy);
  EXPECT_TRUE(camera.distortion.isZero());
}

TEST(CameraConversionTest, TopicNamesSayWhetherImagesAreRectified) {
  EXPECT_TRUE(isRectifiedTopic("/camera/rgb/image_rect_color"));
  EXPECT_TRUE(isRectifiedTopic("/camera/rgb/image_rect/compressed"));
  EXPECT_TRUE(isRectifiedTopic("image_rect"));
  EXPECT_FALSE(isRectifiedTopic("/camera/rgb/image_raw"));
  EXPECT_FALSE(isRectifiedTopic("/camera/color/image_raw"));
}

TEST(CameraConversionTest, RationalModelWithoutItsDenominatorIsPlumbBob) {
  sensor_msgs::CameraInfo info = toCameraInfo(makeCamera());
  info.distortion_model = "rational_polynomial";
  info.D.resize(8, 0.0);
  EXPECT_EQ(makeCamera(), toCamera(info, false));
  info.D[5] = 0.1;
  EXPECT_ERROR(toCamera(info, false), "rectify the images");
}

TEST(CameraConversionTest, OtherLensModelsAreRefusedWithTheRemedy) {
  sensor_msgs::CameraInfo info = toCameraInfo(makeCamera());
  info.distortion_model = "equidistant";
  EXPECT_ERROR(toCamera(info, false), "'equidistant', expected plumb_bob; rectify");
  info.D.assign(4, 0.0);  // zeros are no pinhole in this model
  EXPECT_ERROR(toCamera(info, false), "equidistant");
  EXPECT_TRUE(toCamera(info, true).distortion.isZero());
}

TEST(CameraConversionTest, EmptyModelWithoutCoefficientsIsAPinhole) {
  sensor_msgs::CameraInfo info = toCameraInfo(makeCamera());
  info.distortion_model.clear();
  info.D.clear();
  EXPECT_TRUE(toCamera(info, false).distortion.isZero());
}

TEST(CameraConversionTest, FourCoefficientsLeaveK3Zero) {
  sensor_msgs::CameraInfo info = toCameraInfo(makeCamera());
  info.D.resize(4);
  EXPECT_EQ(0.0, toCamera(info, false).distortion.k3);
  EXPECT_EQ(makeCamera().distortion.p2, toCamera(info, false).distortion.p2);
}

TEST(CameraConversionTest, RegionOfInterestShiftsThePrincipalPoint) {
  sensor_msgs::CameraInfo info = toCameraInfo(makeCamera());
  info.roi.x_offset = 100;
  info.roi.y_offset = 50;
  info.roi.width = 320;
  info.roi.height = 240;
  const Camera camera = toCamera(info, false);
  EXPECT_EQ(320, camera.width);
  EXPECT_EQ(240, camera.height);
  EXPECT_DOUBLE_EQ(218.6, camera.cx);
  EXPECT_DOUBLE_EQ(205.3, camera.cy);
}

TEST(CameraConversionTest, UnusableCalibrationsAreRefused) {
  EXPECT_ERROR(toCamera(sensor_msgs::CameraInfo(), false), "not calibrated");
  sensor_msgs::CameraInfo info = toCameraInfo(makeCamera());
  info.binning_x = 2;
  EXPECT_ERROR(toCamera(info, false), "binning");
  info = toCameraInfo(makeCamera());
  info.width = 0;
  EXPECT_ERROR(toCamera(info, false), "");
  info = toCameraInfo(makeCamera());
  info.K[2] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_ERROR(toCamera(info, false), "");
  info = toCameraInfo(makeCamera());
  info.K[1] = 0.5;
  EXPECT_ERROR(toCamera(info, false), "skew");
}

}  // namespace
}  // namespace mivo
