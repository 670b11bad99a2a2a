// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <vector>

namespace mivo {

/// One curve of a diagram.
struct Curve {
  std::string name;  ///< for the legend; empty: not listed
  std::vector<double> x;
  std::vector<double> y;  ///< as many as x
  cv::Scalar colour;  ///< blue, green, red, 0..255; differ in brightness, to be told apart in grey
  int thickness = 1;  ///< pixels
};

/// Titles of a diagram, with units.
struct PanelText {
  std::string title;
  std::string x;
  std::string y;
};

enum class PanelScale {
  kFree,      ///< each axis as its data need it, the y axis from 0 on
  kEqualAxes  ///< a metre is as long on both axes: for paths
};

/// Draws axes, grid, curves and legend into a rectangle of a CV_8UC3 image. The x axis covers the
/// values of `x_included`, too, so that panels below each other can share one.
void drawPanel(cv::Mat& canvas, const cv::Rect& area, const PanelText& text, PanelScale scale,
               const std::vector<Curve>& curves, const std::vector<double>& x_included = {});

/// Round numbers (1, 2 or 5 times a power of ten apart) within [minimum, maximum], about `count`.
std::vector<double> niceTicks(double minimum, double maximum, int count);

}  // namespace mivo
