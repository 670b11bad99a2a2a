// SPDX-License-Identifier: BSD-3-Clause
#include "core/images/frame_pyramid.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "support/scene.h"

namespace mivo {
namespace {

Frame frameOfAnEdge() {
  const Camera camera = testing::smallCamera();
  Frame frame = testing::render(testing::wallScene(), camera, Eigen::Isometry3d::Identity());
  frame.image.setTo(40);
  frame.image.colRange(camera.width / 2, camera.width).setTo(120);
  return frame;
}

TEST(FramePyramidTest, TheFinestLevelIsSmoothedToBeCompared) {
  const Frame frame = frameOfAnEdge();
  FramePyramid pyramid;
  pyramid.build(frame, Parameters());
  const int middle = frame.image.cols / 2;
  // (1, 2, 1) / 4 across the edge.
  EXPECT_EQ(pyramid.gray(0).at<unsigned char>(60, middle - 2), 40);
  EXPECT_EQ(pyramid.gray(0).at<unsigned char>(60, middle - 1), 60);
  EXPECT_EQ(pyramid.gray(0).at<unsigned char>(60, middle), 100);
  EXPECT_EQ(pyramid.gray(0).at<unsigned char>(60, middle + 1), 120);
  EXPECT_EQ(cv::norm(pyramid.image(), frame.image, cv::NORM_INF), 0.0);
}

TEST(FramePyramidTest, ThePapersIntensitiesAreLeftAsTheyAre) {
  const Frame frame = frameOfAnEdge();
  Parameters parameters;
  parameters.alignment.photometric_model = PhotometricModel::kNone;
  FramePyramid pyramid;
  pyramid.build(frame, parameters);
  EXPECT_EQ(cv::norm(pyramid.gray(0), frame.image, cv::NORM_INF), 0.0);
}

TEST(FramePyramidTest, BesideAClippedPixelNothingIsSmoothed) {
  Frame frame = frameOfAnEdge();
  frame.image.at<unsigned char>(60, 30) = 250;
  Parameters parameters;
  for (const double saturation : {250.0, 251.0}) {
    parameters.alignment.saturation = saturation;
    FramePyramid pyramid;
    pyramid.build(frame, parameters);
    // A quarter of the pixel itself, three quarters of its neighbors; an eighth of it beside.
    EXPECT_EQ(pyramid.gray(0).at<unsigned char>(60, 30), saturation == 250.0 ? 250 : 93);
    EXPECT_EQ(pyramid.gray(0).at<unsigned char>(60, 31), saturation == 250.0 ? 40 : 66);
  }
}

}  // namespace
}  // namespace mivo
