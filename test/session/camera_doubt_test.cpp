// SPDX-License-Identifier: BSD-3-Clause
#include "session/camera_doubt.h"

#include <gtest/gtest.h>

namespace mivo {
namespace {

Camera camera(double fx, double fy, double cx, double cy) {
  return {640, 480, fx, fy, cx, cy, {}};
}

TEST(CameraDoubtTest, RealCalibrationsAreNotDoubted) {
  EXPECT_EQ(findCameraDoubt(camera(525.0, 525.0, 319.5, 239.5)), "");
  EXPECT_EQ(findCameraDoubt(camera(517.3, 516.5, 318.6, 255.3)), "");
  EXPECT_EQ(findCameraDoubt(camera(300.0, 310.0, 250.0, 200.0)), "");
  Camera fisheye = camera(200.0, 200.0, 319.5, 239.5);  // 183 degrees
  fisheye.distortion.model = LensModel::kEquidistant;
  EXPECT_EQ(findCameraDoubt(fisheye), "");
}

TEST(CameraDoubtTest, AnotherResolutionIsNamed) {
  EXPECT_EQ(findCameraDoubt(camera(262.5, 262.5, 159.75, 119.75)),
            "the calibration (fx 262.5, cx 159.75, cy 119.75) is one for 320 x 240 pixels, but the "
            "images have 640 x 480: calibrate at this size, or scale fx, fy, cx and cy");
  EXPECT_NE(findCameraDoubt(camera(1050.0, 1050.0, 639.5, 479.5)).find("1280 x 960"),
            std::string::npos);
}

TEST(CameraDoubtTest, FocalLengthsThatNoLensHasAreNamed) {
  EXPECT_NE(findCameraDoubt(camera(4000.0, 4000.0, 319.5, 239.5)).find("9 x 7 degrees"),
            std::string::npos);
  EXPECT_NE(findCameraDoubt(camera(772.0, 1.0, 319.5, 239.5)).find("fy 1 mean a field of view"),
            std::string::npos);
  EXPECT_NE(findCameraDoubt(camera(0.525, 0.525, 319.5, 239.5)).find("180 x 180 degrees"),
            std::string::npos);
}

TEST(CameraDoubtTest, APrincipalPointOutsideIsNamed) {
  for (const Camera& c : {camera(525.0, 525.0, 2000.0, 239.5), camera(525.0, 525.0, 319.5, -500.0),
                          camera(525.0, 525.0, 639.1, 239.5)}) {
    EXPECT_NE(findCameraDoubt(c).find("is outside of the image of 640 x 480"), std::string::npos);
  }
}

}  // namespace
}  // namespace mivo
