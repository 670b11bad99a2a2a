// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "evaluation/evaluation_plot.h"
#include "evaluation/plot_panel.h"

namespace mivo {
namespace {

const cv::Scalar kRed(0, 0, 255);

/// Bounding box of the pixels of about this colour: thin lines are blended with the paper.
cv::Rect boxOf(const cv::Mat& canvas, const cv::Scalar& colour) {
  cv::Mat mask;
  const cv::Scalar tolerance = cv::Scalar::all(40);
  cv::inRange(canvas, colour - tolerance, colour + tolerance, mask);
  std::vector<cv::Point> pixels;
  cv::findNonZero(mask, pixels);
  return pixels.empty() ? cv::Rect() : cv::boundingRect(pixels);
}

Curve curveOf(std::vector<double> x, std::vector<double> y) {
  Curve curve;
  curve.x = std::move(x);
  curve.y = std::move(y);
  curve.colour = kRed;
  curve.thickness = 3;
  return curve;
}

TEST(PlotTest, TicksAreRoundNumbersInside) {
  EXPECT_EQ(niceTicks(0.0, 10.0, 5), (std::vector<double>{0, 2, 4, 6, 8, 10}));
  const std::vector<double> ticks = niceTicks(-0.013, 0.027, 4);
  ASSERT_EQ(ticks.size(), 4U);
  EXPECT_NEAR(ticks[0], -0.01, 1e-15);
  EXPECT_NEAR(ticks[3], 0.02, 1e-15);
  EXPECT_TRUE(niceTicks(1.0, 1.0, 5).empty());
}

TEST(PlotTest, PathKeepsItsShape) {
  cv::Mat canvas(400, 800, CV_8UC3, cv::Scalar::all(255));
  const Curve square = curveOf({0, 2, 2, 0, 0}, {5, 5, 7, 7, 5});
  drawPanel(canvas, {0, 0, 800, 400}, {"t", "x", "y"}, PanelScale::kEqualAxes, {square});
  const cv::Rect box = boxOf(canvas, kRed);
  EXPECT_GT(box.height, 200);
  EXPECT_NEAR(box.width, box.height, 2);
}

TEST(PlotTest, LargerValueIsHigherAndLaterOnTheRight) {
  for (const double end : {0.0, 2.0}) {
    cv::Mat canvas(400, 400, CV_8UC3, cv::Scalar::all(255));
    drawPanel(canvas, {0, 0, 400, 400}, {"t", "x", "y"}, PanelScale::kFree,
              {curveOf({0, 1}, {2, 2}), curveOf({1, 1.0001}, {end, end})});
    const cv::Rect box = boxOf(canvas, kRed);
    EXPECT_GT(box.x + box.width, 300);
    if (end == 0.0) {
      EXPECT_GT(box.y + box.height, 300);
    } else {
      EXPECT_LT(box.y + box.height, 100);
    }
  }
}

TEST(PlotTest, AxisCoversWhatItHasToInclude) {
  cv::Mat canvas(400, 800, CV_8UC3, cv::Scalar::all(255));
  drawPanel(canvas, {0, 0, 800, 400}, {"t", "x", "y"}, PanelScale::kFree, {curveOf({0, 1}, {1, 1})},
            {0.0, 4.0});
  // A quarter of an axis that is a little shorter than the panel.
  EXPECT_NEAR(boxOf(canvas, kRed).width, (800 - 90) / 4, 6);
}

TEST(PlotTest, NothingToDrawIsNoTrouble) {
  cv::Mat canvas(300, 300, CV_8UC3, cv::Scalar::all(255));
  for (const PanelScale scale : {PanelScale::kFree, PanelScale::kEqualAxes}) {
    drawPanel(canvas, {0, 0, 300, 300}, {"t", "x", "y"}, scale, {});
    drawPanel(canvas, {0, 0, 300, 300}, {"t", "x", "y"}, scale, {curveOf({1, 1}, {2, 2})});
  }
  EXPECT_FALSE(boxOf(canvas, kRed).empty());
}

TEST(PlotTest, EvaluationHasItsPicture) {
  Trajectory trajectory;
  for (int i = 0; i < 40; ++i) {
    StampedPose pose;
    pose.stamp = 0.1 * i;
    pose.pose.translation() << 0.1 * i, 0.01 * i * i, 0.0;
    trajectory.push_back(pose);
  }
  const cv::Mat picture =
      drawEvaluation(trajectory, trajectory, evaluate(trajectory, trajectory, {}));
  EXPECT_EQ(picture.type(), CV_8UC3);
  const cv::Scalar estimate(120, 40, 20);
  const cv::Scalar truth(170, 190, 200);
  const int half = picture.cols / 2;
  for (const cv::Rect& part : {cv::Rect(0, 0, half, picture.rows / 2),
                               cv::Rect(0, picture.rows / 2, half, picture.rows / 2)}) {
    EXPECT_GT(boxOf(picture(part), estimate).width, half / 4);
    EXPECT_GT(boxOf(picture(part), truth).width, half / 4);
  }
  EXPECT_GT(boxOf(picture(cv::Rect(half, 0, half, picture.rows)), estimate).width, half / 2);
}

}  // namespace
}  // namespace mivo
