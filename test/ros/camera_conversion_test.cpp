// SPDX-License-Identifier: BSD-3-Clause
#include "ros/camera_conversion.h"

#include <gtest/gtest.h>

#include <cstdint>
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

TEST(CameraConversionTest, EightCoefficientsAreARationalPolynomial) {
  sensor_msgs::CameraInfo info = toCameraInfo(makeCamera());
  info.distortion_model = "rational_polynomial";
  info.D.resize(8, 0.0);
  EXPECT_EQ(makeCamera(), toCamera(info, false));  // a denominator of 1
  info.D = {0.6, -2.7, 5e-4, -2e-4, 1.5, 0.5, -2.5, 1.4, 0.0, 0.0, 0.0, 0.0};
  Camera camera = makeCamera();
  camera.distortion = {0.6, -2.7, 5e-4, -2e-4, 1.5, 0.5, -2.5, 1.4};
  EXPECT_EQ(camera, toCamera(info, false));
  EXPECT_EQ(camera, toCamera(toCameraInfo(camera), false));
  info.D[9] = 0.01;
  EXPECT_ERROR(toCamera(info, false), "'rational_polynomial' with 12 coefficients");
}

TEST(CameraConversionTest, EquidistantLensesHaveFour) {
  sensor_msgs::CameraInfo info = toCameraInfo(makeCamera());
  info.distortion_model = "equidistant";
  info.D = {0.1, -0.05, 0.01, 0.002};
  Camera camera = makeCamera();
  camera.distortion = {0.1, -0.05, 0.0, 0.0, 0.01, 0.002, 0.0, 0.0, LensModel::kEquidistant};
  EXPECT_EQ(camera, toCamera(info, false));
  EXPECT_EQ(camera, toCamera(toCameraInfo(camera), false));
  info.D.push_back(0.3);
  EXPECT_ERROR(toCamera(info, false), "'equidistant' with 5 coefficients");
  EXPECT_TRUE(toCamera(info, true).distortion.isZero());
}

TEST(CameraConversionTest, ZerosArePinholesUnlessAFisheyeIsMeant) {
  sensor_msgs::CameraInfo info = toCameraInfo(makeCamera());
  info.D.assign(4, 0.0);
  for (const char* model : {"", "equidistant", "thin_prism", "None", "Brown Conrady"}) {
    info.distortion_model = model;
    EXPECT_TRUE(toCamera(info, false).distortion.isZero()) << model;
  }
  info.distortion_model = "equidistant";
  info.K[0] = info.K[4] = 305.0;  // 120 degrees
  EXPECT_EQ(toCamera(info, false).distortion.model, LensModel::kEquidistant);
}

TEST(CameraConversionTest, OtherLensModelsAreRefusedWithTheRemedy) {
  sensor_msgs::CameraInfo info = toCameraInfo(makeCamera());
  for (const char* model : {"", "thin_prism", "ftheta"}) {
    info.distortion_model = model;
    EXPECT_ERROR(toCamera(info, false), "the lens model '" + std::string(model) + "', expected");
    EXPECT_TRUE(toCamera(info, true).distortion.isZero());
  }
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

TEST(CameraConversionTest, ARegionBeyondTheSensorIsRefused) {
  sensor_msgs::CameraInfo info = toCameraInfo(makeCamera());
  info.roi.x_offset = 160;
  info.roi.width = 480;
  info.roi.height = 480;
  info.roi.do_rectify = 1;
  EXPECT_EQ(480, toCamera(info, false).width);
  info.roi.x_offset = 161;
  EXPECT_ERROR(toCamera(info, false), "the roi of 480 x 480 pixels at (161, 0) lies outside");
  info.roi.x_offset = std::numeric_limits<std::uint32_t>::max();  // the sum must not wrap around
  EXPECT_ERROR(toCamera(info, false), "lies outside of its 640 x 480 pixels");
}

TEST(CameraConversionTest, BinnedPixelsAreTheMeanOfTheirs) {
  sensor_msgs::CameraInfo info = toCameraInfo(makeCamera());
  info.binning_x = info.binning_y = 1;
  EXPECT_EQ(makeCamera(), toCamera(info, false));
  info.binning_x = 2;
  info.binning_y = 4;
  info.roi.x_offset = 20;
  info.roi.y_offset = 40;
  info.roi.width = 600;
  info.roi.height = 400;
  const Camera camera = toCamera(info, false);
  EXPECT_EQ(300, camera.width);
  EXPECT_EQ(100, camera.height);
  EXPECT_DOUBLE_EQ(517.3 / 2.0, camera.fx);
  EXPECT_DOUBLE_EQ(516.5 / 4.0, camera.fy);
  // The left edge of the region, -0.5, stays the left edge.
  EXPECT_DOUBLE_EQ((318.6 - 20.0 + 0.5) / 2.0 - 0.5, camera.cx);
  EXPECT_DOUBLE_EQ((255.3 - 40.0 + 0.5) / 4.0 - 0.5, camera.cy);
  EXPECT_EQ(makeCamera().distortion, camera.distortion);
}

TEST(CameraConversionTest, WithoutASizeItIsThatOfTheImages) {
  sensor_msgs::CameraInfo info = toCameraInfo(makeCamera());
  info.width = info.height = 0;
  EXPECT_EQ(makeCamera(), toCamera(info, false, {640, 480}));
  EXPECT_ERROR(toCamera(info, false), "0 x 0 pixels");
}

TEST(CameraConversionTest, UnusableCalibrationsAreRefused) {
  EXPECT_ERROR(toCamera(sensor_msgs::CameraInfo(), false), "not calibrated");
  sensor_msgs::CameraInfo info = toCameraInfo(makeCamera());
  info.K[2] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_ERROR(toCamera(info, false), "");
  info = toCameraInfo(makeCamera());
  info.D[1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_ERROR(toCamera(info, false), "finite");
  info = toCameraInfo(makeCamera());
  info.K[1] = 0.5;
  EXPECT_ERROR(toCamera(info, false), "skew");
  info = toCameraInfo(makeCamera());
  info.K = {772.87, 0.0, 319.5, 0.0, 770.0, 239.5, 0.0, 6.9e-310, 2.5e-323};
  EXPECT_ERROR(toCamera(info, false), "K has a last row that is not 0 0 1");
}

TEST(CameraConversionTest, CoefficientsThatAreNotModeledAreRefused) {
  sensor_msgs::CameraInfo info = toCameraInfo(makeCamera());
  info.distortion_model = "rational_polynomial";
  for (const std::size_t count : {12U, 14U}) {
    info.D.resize(8);
    info.D.resize(count, 0.0);
    const Camera camera = toCamera(info, false);
    EXPECT_EQ(makeCamera(), camera);
    info.D.back() = 1e-3;
    EXPECT_ERROR(toCamera(info, false), "with " + std::to_string(count) +
                                            " coefficients, of which those from number 9 on are "
                                            "not 0 (thin prism, tilt), expected");
  }
  info.distortion_model = "equidistant";
  EXPECT_ERROR(toCamera(info, false), "from number 5 on are not 0, expected");
}

TEST(CameraConversionTest, FewCoefficientsAreFollowedByZeros) {
  sensor_msgs::CameraInfo info = toCameraInfo(makeCamera());
  info.D = {0.1};
  const Camera camera = toCamera(info, false);
  EXPECT_EQ(camera.distortion.k1, 0.1);
  EXPECT_EQ(camera.distortion.k2, 0.0);
  EXPECT_EQ(camera.distortion.p1, 0.0);
}

TEST(CameraConversionTest, FocalLengthsThatAreNegativeNanOrOnlyInPAreRefused) {
  for (const double fx : {-525.0, 0.0, std::numeric_limits<double>::quiet_NaN()}) {
    sensor_msgs::CameraInfo info = toCameraInfo(makeCamera());
    info.K[0] = fx;
    EXPECT_ERROR(toCamera(info, false), "K has no positive focal length");
  }
  sensor_msgs::CameraInfo only_p = toCameraInfo(makeCamera());
  only_p.K.fill(0.0);
  EXPECT_ERROR(toCamera(only_p, false), "K has no positive focal length");
  EXPECT_EQ(toCamera(only_p, true).fx, makeCamera().fx);
  sensor_msgs::CameraInfo only_k = toCameraInfo(makeCamera());
  only_k.P.fill(0.0);
  EXPECT_ERROR(toCamera(only_k, true), "P has no positive focal length");
  only_k.width = 0;
  EXPECT_ERROR(toCamera(only_k, false), "0 x 480 pixels");
}

TEST(CameraConversionTest, CalibrationsThatCannotBeRightAreRefused) {
  const auto with = [](double fx, double fy, double cx, double cy) {
    sensor_msgs::CameraInfo info = toCameraInfo(makeCamera());
    info.K = {fx, 0.0, cx, 0.0, fy, cy, 0.0, 0.0, 1.0};
    info.D.assign(5, 0.0);
    return info;
  };
  EXPECT_ERROR(toCamera(with(525.0, 525.0, 2000.0, -500.0), false), "lies outside of images");
  EXPECT_ERROR(toCamera(with(5250.0, 5250.0, 319.5, 239.5), false), "span 6.9");
}

}  // namespace
}  // namespace mivo
