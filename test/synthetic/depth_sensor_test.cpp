// SPDX-License-Identifier: BSD-3-Clause
#include "synthetic/depth_sensor.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>
#include <set>

#include "mivo/core/error.h"
#include "synthetic/sequence_generator.h"

namespace mivo {
namespace {

SurfaceImage wallAt(float depth, float cosine = 1.0F) {
  return {cv::Mat(240, 320, CV_32FC1, cv::Scalar(depth)),
          cv::Mat(240, 320, CV_32FC1, cv::Scalar(cosine))};
}

DepthSensorOptions ideal() {
  DepthSensorOptions options;
  options.noise = 0.0;
  options.disparity_step = 0.0;
  options.holes = false;
  return options;
}

TEST(DepthSensor, IdealReadingIsRoundedToItsUnit) {
  const DepthSensor sensor(ideal(), xtionCamera(320, 240));
  for (const float z : {0.5F, 1.2345F, 4.9F}) {
    EXPECT_NEAR(sensor.sense(wallAt(z), 1).at<std::uint16_t>(100, 100), 5000.0 * z, 0.51) << z;
  }
}

TEST(DepthSensor, NothingIsReadOutOfRange) {
  const DepthSensor sensor(ideal(), xtionCamera(320, 240));
  EXPECT_EQ(cv::countNonZero(sensor.sense(wallAt(0.39F), 1)), 0);
  EXPECT_EQ(cv::countNonZero(sensor.sense(wallAt(5.01F), 1)), 0);
  EXPECT_EQ(cv::countNonZero(sensor.sense(wallAt(0.0F), 1)), 0);
}

TEST(DepthSensor, NoiseGrowsWithTheSquareOfTheDepth) {
  DepthSensorOptions options = ideal();
  options.noise = 0.06;
  const DepthSensor sensor(options, xtionCamera(320, 240));
  for (const double z : {1.0, 2.0, 4.0}) {
    cv::Scalar mean;
    cv::Scalar deviation;
    cv::meanStdDev(sensor.sense(wallAt(static_cast<float>(z)), 5), mean, deviation);
    const double expected = 0.06 * z * z / (575.0 * 0.075);
    EXPECT_NEAR(sensor.deviation(z), expected, 1e-12);
    // About 8500 independent cells: the deviation is accurate to 1 %.
    EXPECT_NEAR(deviation[0] / 5000.0 / expected, 1.0, 0.05) << z;
    EXPECT_NEAR(mean[0] / 5000.0, z, 0.1 * expected) << z;
  }
}

TEST(DepthSensor, ReadingsAreStepsOfTheDisparity) {
  DepthSensorOptions options;
  options.holes = false;
  const DepthSensor sensor(options, xtionCamera(320, 240));
  const cv::Mat image = sensor.sense(wallAt(3.0F), 5);
  std::set<std::uint16_t> values(image.begin<std::uint16_t>(), image.end<std::uint16_t>());
  EXPECT_GT(values.size(), 2U);
  EXPECT_LT(values.size(), 8U);
  for (const std::uint16_t value : values) {
    const double steps = 575.0 * 0.075 / (value / 5000.0) / 0.125;
    EXPECT_NEAR(steps, std::round(steps), 0.005) << value;  // half a unit of 0.2 mm
  }
}

// A screen in front of a wall casts a shadow of the projector on its left: the columns between the
// two disparities fx b / z.
TEST(DepthSensor, ShadowIsAsWideAsTheDifferenceOfDisparities) {
  DepthSensorOptions options = ideal();
  options.holes = true;
  const Camera camera = xtionCamera(320, 240);
  const DepthSensor sensor(options, camera);
  SurfaceImage surface = wallAt(2.5F);
  surface.depth.colRange(150, 220).setTo(1.0F);
  const cv::Mat row = sensor.sense(surface, 5).row(120);
  const double width = camera.fx * 0.075 * (1.0 / 1.0 - 1.0 / 2.5);  // 11.8 pixels
  int holes = 0;
  for (int x = 100; x < 150; ++x) holes += row.at<std::uint16_t>(x) == 0 ? 1 : 0;
  EXPECT_NEAR(holes, width, 1.0);
  for (int x = 222; x < 320; ++x) EXPECT_NE(row.at<std::uint16_t>(x), 0) << x;
}

TEST(DepthSensor, GrazingAndAbsorbingSurfacesGiveHoles) {
  DepthSensorOptions options = ideal();
  options.holes = true;
  const DepthSensor sensor(options, xtionCamera(320, 240));
  EXPECT_EQ(cv::countNonZero(sensor.sense(wallAt(2.0F, 0.0F), 5)), 0);
  EXPECT_EQ(cv::countNonZero(sensor.sense(wallAt(2.0F, 0.5F), 5)), 320 * 240);
  EXPECT_NEAR(cv::countNonZero(sensor.sense(wallAt(2.0F, 0.11F), 5)) / (320.0 * 240.0), 0.5, 0.02);
}

TEST(DepthSensor, RefusesWhatCannotBe) {
  DepthSensorOptions options;
  options.max_depth = 14.0;  // 70000 units
  EXPECT_THROW(DepthSensor(options, xtionCamera()), Error);
  options = {};
  options.noise = -1.0;
  EXPECT_THROW(DepthSensor(options, xtionCamera()), Error);
}

}  // namespace
}  // namespace mivo
