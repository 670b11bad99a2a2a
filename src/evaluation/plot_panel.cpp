// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/plot_panel.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>

namespace mivo {
namespace {

const cv::Scalar kInk(40, 40, 40);
const cv::Scalar kGrid(225, 225, 225);
const cv::Scalar kPaper(255, 255, 255);
constexpr int kFont = cv::FONT_HERSHEY_SIMPLEX;
constexpr double kFontScale = 0.5;
constexpr int kLineHeight = 20;  // pixels
constexpr int kTicks = 6;
constexpr int kSubPixelBits = 4;  // OpenCV draws at fractions of a pixel

// Room around the axes for the texts, pixels.
constexpr int kLeft = 75;
constexpr int kRight = 15;
constexpr int kTop = 32;
constexpr int kBottom = 48;

struct Range {
  double minimum = std::numeric_limits<double>::infinity();
  double maximum = -std::numeric_limits<double>::infinity();

  void include(double value) {
    minimum = std::min(minimum, value);
    maximum = std::max(maximum, value);
  }
  double size() const { return maximum - minimum; }

  /// Grows to `size` about its centre.
  void growTo(double size) {
    const double centre = 0.5 * (minimum + maximum);
    minimum = centre - 0.5 * size;
    maximum = centre + 0.5 * size;
  }
};

/// The rectangle inside of the axes, and the numbers at its borders.
struct Axes {
  cv::Rect box;
  Range x;
  Range y;

  cv::Point2d at(double value_x, double value_y) const {
    return {box.x + (value_x - x.minimum) / x.size() * box.width,
            box.y + box.height - (value_y - y.minimum) / y.size() * box.height};
  }
};

int textWidth(const std::string& text) {
  return cv::getTextSize(text, kFont, kFontScale, 1, nullptr).width;
}

void write(cv::Mat& canvas, const std::string& text, int x, int y) {
  cv::putText(canvas, text, {x, y}, kFont, kFontScale, kInk, 1, cv::LINE_AA);
}

/// Upwards, for the y axis.
void writeVertically(cv::Mat& canvas, const std::string& text, int x, int centre_y) {
  cv::Mat strip(kLineHeight, textWidth(text) + 2, CV_8UC3, kPaper);
  write(strip, text, 1, kLineHeight - 6);
  cv::rotate(strip, strip, cv::ROTATE_90_COUNTERCLOCKWISE);
  const cv::Rect place = cv::Rect(x, centre_y - strip.rows / 2, strip.cols, strip.rows) &
                         cv::Rect({0, 0}, canvas.size());
  strip(cv::Rect({0, 0}, place.size())).copyTo(canvas(place));
}

Axes makeAxes(const cv::Rect& area, PanelScale scale, const std::vector<Curve>& curves,
              const std::vector<double>& x_included) {
  Axes axes;
  axes.box = cv::Rect(area.x + kLeft, area.y + kTop, area.width - kLeft - kRight,
                      area.height - kTop - kBottom);
  for (const Curve& curve : curves) {
    for (const double x : curve.x) axes.x.include(x);
    for (const double y : curve.y) axes.y.include(y);
  }
  for (const double x : x_included) axes.x.include(x);
  if (scale == PanelScale::kFree) axes.y.include(0.0);
  constexpr double kMargin = 1.08;    // so that no curve runs along the border
  constexpr double kSmallest = 1e-9;  // a path that does not move still gets axes
  if (!(axes.x.size() >= 0.0)) axes.x = {0.0, 1.0};
  if (!(axes.y.size() >= 0.0)) axes.y = {0.0, 1.0};
  if (scale == PanelScale::kFree) {
    axes.x.growTo(std::max(axes.x.size(), kSmallest));
    axes.y.maximum = axes.y.minimum + std::max(axes.y.size() * kMargin, kSmallest);
  } else {
    const double unit_per_pixel =
        std::max({axes.x.size() / axes.box.width, axes.y.size() / axes.box.height, kSmallest}) *
        kMargin;
    axes.x.growTo(unit_per_pixel * axes.box.width);
    axes.y.growTo(unit_per_pixel * axes.box.height);
  }
  return axes;
}

std::string tickText(double value) {
  return std::abs(value) < 1e-12 ? std::string("0") : fmt::format("{:.4g}", value);
}

void drawGrid(cv::Mat& canvas, const Axes& axes) {
  const cv::Rect& box = axes.box;
  for (const double tick : niceTicks(axes.x.minimum, axes.x.maximum, kTicks)) {
    const int x = static_cast<int>(std::lround(axes.at(tick, axes.y.minimum).x));
    cv::line(canvas, {x, box.y}, {x, box.y + box.height}, kGrid);
    const std::string text = tickText(tick);
    write(canvas, text, x - textWidth(text) / 2, box.y + box.height + kLineHeight - 3);
  }
  for (const double tick : niceTicks(axes.y.minimum, axes.y.maximum, kTicks)) {
    const int y = static_cast<int>(std::lround(axes.at(axes.x.minimum, tick).y));
    cv::line(canvas, {box.x, y}, {box.x + box.width, y}, kGrid);
    const std::string text = tickText(tick);
    write(canvas, text, box.x - textWidth(text) - 6, y + 5);
  }
  cv::rectangle(canvas, box, kInk);
}

void drawCurve(cv::Mat& canvas, const Axes& axes, const Curve& curve) {
  std::vector<cv::Point> points;
  const double steps = 1 << kSubPixelBits;
  for (std::size_t i = 0; i < curve.x.size(); ++i) {
    points.emplace_back(steps * axes.at(curve.x[i], curve.y[i]));
  }
  cv::polylines(canvas, points, false, curve.colour, curve.thickness, cv::LINE_AA, kSubPixelBits);
}

void drawLegend(cv::Mat& canvas, const Axes& axes, const std::vector<Curve>& curves) {
  constexpr int kSample = 28;  // pixels of line shown
  int width = 0;
  int entries = 0;
  for (const Curve& curve : curves) {
    if (curve.name.empty()) continue;
    width = std::max(width, textWidth(curve.name));
    ++entries;
  }
  if (entries == 0) return;
  const cv::Rect box(axes.box.x + axes.box.width - width - kSample - 26, axes.box.y + 8,
                     width + kSample + 18, entries * kLineHeight + 6);
  cv::rectangle(canvas, box, kPaper, cv::FILLED);
  cv::rectangle(canvas, box, kGrid);
  int y = box.y + kLineHeight - 3;
  for (const Curve& curve : curves) {
    if (curve.name.empty()) continue;
    cv::line(canvas, {box.x + 6, y - 5}, {box.x + 6 + kSample, y - 5}, curve.colour,
             curve.thickness, cv::LINE_AA);
    write(canvas, curve.name, box.x + kSample + 12, y);
    y += kLineHeight;
  }
}

}  // namespace

std::vector<double> niceTicks(double minimum, double maximum, int count) {
  std::vector<double> ticks;
  if (!(maximum > minimum) || count < 1) return ticks;
  const double rough = (maximum - minimum) / count;
  const double decade = std::pow(10.0, std::floor(std::log10(rough)));
  double step = 10.0 * decade;
  for (const double factor : {5.0, 2.0, 1.0}) {
    if (factor * decade >= rough) step = factor * decade;
  }
  const double first = std::ceil(minimum / step);
  const double last = std::floor(maximum / step);
  for (double i = first; i <= last; i += 1.0) ticks.push_back(i * step);
  return ticks;
}

void drawPanel(cv::Mat& canvas, const cv::Rect& area, const PanelText& text, PanelScale scale,
               const std::vector<Curve>& curves, const std::vector<double>& x_included) {
  const Axes axes = makeAxes(area, scale, curves, x_included);
  drawGrid(canvas, axes);
  for (const Curve& curve : curves) drawCurve(canvas, axes, curve);
  drawLegend(canvas, axes, curves);
  const cv::Rect& box = axes.box;
  write(canvas, text.title, box.x, box.y - 10);
  write(canvas, text.x, box.x + (box.width - textWidth(text.x)) / 2, box.y + box.height + 38);
  writeVertically(canvas, text.y, area.x + 2, box.y + box.height / 2);
}

}  // namespace mivo
