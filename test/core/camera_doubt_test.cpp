// SPDX-License-Identifier: BSD-3-Clause
#include "core/camera_doubt.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/error_text.h"

namespace mivo {
namespace {

const Camera kXtion{640, 480, 525.0, 525.0, 319.5, 239.5, {}};

Camera withFocalLengths(double fx, double fy) {
  Camera camera = kXtion;
  camera.fx = fx;
  camera.fy = fy;
  return camera;
}

Camera withCenter(double cx, double cy) {
  Camera camera = kXtion;
  camera.cx = cx;
  camera.cy = cy;
  return camera;
}

/// A pinhole camera whose longer side of 640 pixels spans this angle.
double focalLength(double degrees) {
  return 320.0 / std::tan(0.5 * degrees * M_PI / 180.0);
}

TEST(CameraDoubtTest, PublishedCamerasAreBeyondDoubt) {
  const Camera cameras[] = {
      kXtion,
      {640, 480, 517.3, 516.5, 318.6, 255.3, {0.2624, -0.9531, -0.0054, 0.0026, 1.1633}},
      {640, 480, 542.822841, 542.576870, 315.593520, 237.756098, {}},
      {739, 458, 726.28741455078, 726.28741455078, 354.6496887207, 186.46566772461, {}},
      {1280, 720, 910.0, 911.0, 640.0, 366.0, {}},
      {1241, 376, 718.856, 718.856, 607.1928, 185.2157, {}},
      {512, 512, 252.0, 252.0, 256.0, 252.0, {}}};
  for (const Camera& camera : cameras) {
    EXPECT_EQ(errorText([&] { camera.validate(); }), "nothing thrown") << camera.width;
    EXPECT_EQ(doubtOf(camera), "") << camera.width;
  }
}

TEST(CameraDoubtTest, AnglesBelow10AndAbove170DegreesAreRefused) {
  for (const double degrees : {10.1, 60.0, 169.9}) {
    const Camera camera = withFocalLengths(focalLength(degrees), focalLength(degrees));
    EXPECT_EQ(findCameraFault(camera), "") << degrees;
  }
  for (const double degrees : {9.9, 170.1}) {
    for (const Camera& camera : {withFocalLengths(focalLength(degrees), 525.0),
                                 withFocalLengths(525.0, focalLength(degrees))}) {
      const std::string error = errorText([&] { camera.validate(); });
      EXPECT_EQ(error.find("camera: with a focal length of "), 0U) << error;
      EXPECT_NE(error.find("10 to 170 are possible"), std::string::npos) << error;
    }
  }
  Camera strip = kXtion;  // a strip of an image is no telephoto lens
  strip.height = 16;
  strip.cy = 7.5;
  EXPECT_EQ(findCameraFault(strip), "");
}

TEST(CameraDoubtTest, PrincipalPointOutsideOfTheImageIsRefused) {
  EXPECT_EQ(findCameraFault(withCenter(639.5, 479.5)), "");
  EXPECT_EQ(findCameraFault(withCenter(-0.5, 100.0)), "");
  for (const Camera& camera : {withCenter(-0.6, 239.5), withCenter(319.5, 479.6),
                               withCenter(-5000.0, 239.5), withCenter(319.5, -20.0)}) {
    const std::string error = errorText([&] { camera.validate(); });
    EXPECT_EQ(error.find("camera: the principal point ("), 0U) << error;
    EXPECT_NE(error.find("lies outside of images of 640 x 480 pixels"), std::string::npos);
    EXPECT_EQ(error.find("calibration for"), std::string::npos) << error;
  }
  EXPECT_NE(findCameraFault(withCenter(959.5, 719.5)).find("for images of 1920 x 1440 pixels?"),
            std::string::npos);
}

TEST(CameraDoubtTest, CalibrationOfAnotherSizeIsDoubted) {
  EXPECT_EQ(doubtOf(withCenter(159.5, 119.5)),
            "the principal point (159.5, 119.5) is far from the center of images of 640 x 480 "
            "pixels: is the calibration for images of 320 x 240 pixels?");
  EXPECT_NE(doubtOf(withCenter(479.5, 359.5)).find("for images of 960 x 720"), std::string::npos);
  // Halved without regard to where the centers of pixels are.
  EXPECT_NE(doubtOf(withCenter(159.75, 119.75)).find("for images of 320 x 240"), std::string::npos);
  EXPECT_EQ(
      doubtOf(withCenter(100.0, 239.5)),
      "the principal point (100, 239.5) is far from the center of images of 640 x 480 pixels");
  EXPECT_EQ(doubtOf(withCenter(250.0, 200.0)), "");
}

TEST(CameraDoubtTest, FocalLengthsThatDifferAreDoubted) {
  EXPECT_EQ(doubtOf(withFocalLengths(525.0, 262.5)),
            "the focal lengths 525 and 262.5 differ by more than a lens' do");
  EXPECT_EQ(doubtOf(withFocalLengths(525.0, 500.0)), "");
}

TEST(CameraDoubtTest, SmallImagesAreTold) {
  const Camera small{80, 60, 65.625, 65.625, 39.5, 29.5, {}};
  EXPECT_EQ(describeCoarseness(small),
            "images of 80 x 60 pixels are small: a pixel spans 30 mm at 2 m, and the pose drifts "
            "by centimeters within a second: record larger ones");
  const auto with = [](double focal_length) {
    return describeCoarseness(Camera{120, 90, focal_length, focal_length, 59.5, 44.5, {}});
  };
  EXPECT_EQ(with(90.0), "");
  EXPECT_NE(with(89.9), "");
  const Camera depth_sensor{176, 144, 210.0, 210.0, 87.5, 71.5, {}};
  EXPECT_EQ(describeCoarseness(depth_sensor), "");
}

TEST(CameraDoubtTest, RoundingIsNoDifference) {
  Camera lens = kXtion;
  lens.distortion = {0.2624, -0.9531, -0.0054, 0.0026, 1.1633};
  for (const Camera& camera : {kXtion, lens}) {
    Camera rounded = camera;
    rounded.fx *= 1.0 + 1e-9;
    rounded.cx += 1e-9;
    rounded.distortion.k2 *= 1.0 - 1e-9;
    EXPECT_FALSE(rounded == camera);
    EXPECT_TRUE(isSameButForRounding(camera, rounded));
    Camera other = camera;
    other.fy += 0.05;
    EXPECT_FALSE(isSameButForRounding(camera, other));
    other = camera;
    other.distortion.k1 += 1e-4;
    EXPECT_FALSE(isSameButForRounding(camera, other));
    other = camera;
    other.width -= 1;
    EXPECT_FALSE(isSameButForRounding(camera, other));
  }
}

}  // namespace
}  // namespace mivo
