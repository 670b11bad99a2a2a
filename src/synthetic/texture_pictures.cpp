// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <string>

#include "synthetic/pixel_noise.h"
#include "synthetic/spectral_noise.h"
#include "synthetic/texture_patterns.h"

namespace mivo {
namespace {

// Draws with 8-bit sRGB colors, as a printer would; turned into reflectances at the end. Random
// values have a name each: compilers differ in the order in which they evaluate arguments.
class Canvas {
 public:
  Canvas(int width, int height, std::uint64_t seed, const cv::Scalar& background)
      : image(height, width, CV_8UC3, background), seed_(seed) {}

  double uniform(double low, double high) {
    return low + (high - low) * uniformFrom(hashOf(seed_, 0xcafe, counter_++));
  }
  int integer(int low, int high) {
    return low + static_cast<int>(uniform(0.0, static_cast<double>(high - low) + 0.999));
  }
  cv::Scalar color(double low = 20, double high = 235) {
    const double red = uniform(low, high);
    const double green = uniform(low, high);
    const double blue = uniform(low, high);
    return {blue, green, red};
  }
  cv::Point point() { return {integer(0, image.cols - 1), integer(0, image.rows - 1)}; }

  std::string word() {
    static const char* const kSyllables[] = {"ka", "lo", "mi", "ren", "ta",  "vo", "su", "per",
                                             "ne", "di", "ol", "ba",  "gri", "en", "ho", "tu"};
    std::string text;
    for (int n = integer(1, 4); n > 0; --n) {
      text += kSyllables[integer(0, 15)];
    }
    return text;
  }

  /// One line of words between two columns; `size` is the height of a capital in texels.
  void textLine(int left, int right, int baseline, double size, const cv::Scalar& ink) {
    const double scale = size / 21.0;  // the Hershey font's capitals are 21 units high
    int x = left;
    while (true) {
      const std::string text = word();
      const int width = cv::getTextSize(text, cv::FONT_HERSHEY_SIMPLEX, scale, 1, nullptr).width;
      if (x + width > right) {
        return;
      }
      cv::putText(image, text, {x, baseline}, cv::FONT_HERSHEY_SIMPLEX, scale, ink,
                  std::max(1, static_cast<int>(size / 8)), cv::LINE_AA);
      x += width + static_cast<int>(0.7 * size);
    }
  }

  /// Paper, ink and pigment are never even: `roughness` modulates the brightness at all scales.
  Texture finish(double roughness, float highlight) const {
    const int size = std::max(image.cols, image.rows);
    const cv::Mat noise = spectralNoise(size, {0.8, 1.0, 2.0}, seed_ + 5);
    std::array<float, 256> linear{};
    for (std::size_t k = 0; k < linear.size(); ++k) {
      linear[k] = std::pow(static_cast<float>(k) / 255.0F, 2.2F);
    }
    cv::Mat texels(image.rows, image.cols, CV_32FC4);
    for (int y = 0; y < image.rows; ++y) {
      for (int x = 0; x < image.cols; ++x) {
        const auto& bgr = image.at<cv::Vec3b>(y, x);
        const auto brightness = static_cast<float>(1.0 + roughness * noise.at<float>(y, x));
        cv::Vec4f value(0.0F, 0.0F, 0.0F, highlight);
        for (int c = 0; c < 3; ++c) {
          value[c] = std::clamp(0.015F + 0.86F * linear[bgr[c]] * brightness, 0.01F, 0.92F);
        }
        texels.at<cv::Vec4f>(y, x) = value;
      }
    }
    return Texture(texels, 0.001);
  }

  cv::Mat image;

 private:
  std::uint64_t seed_;
  std::uint64_t counter_ = 0;
};

void blend(cv::Mat& image, const cv::Mat& drawn, double opacity) {
  cv::addWeighted(drawn, opacity, image, 1.0 - opacity, 0.0, image);
}

}  // namespace

Texture paintingTexture(std::uint64_t seed) {
  Canvas canvas(512, 512, seed, cv::Scalar(0, 0, 0));
  // A landscape of clouds in two colors, shapes over it, a frame and a title.
  const cv::Mat cloud = spectralNoise(512, {1.6, 1.6, 1.0}, seed + 1);
  const cv::Scalar low = canvas.color(20, 140);
  const cv::Scalar high = canvas.color(120, 250);
  for (int y = 0; y < 512; ++y) {
    for (int x = 0; x < 512; ++x) {
      const double mix =
          std::clamp(0.5 + 0.3 * cloud.at<float>(y, x) + 0.3 * (256 - y) / 512.0, 0.0, 1.0);
      for (int c = 0; c < 3; ++c) {
        canvas.image.at<cv::Vec3b>(y, x)[c] =
            cv::saturate_cast<uchar>(mix * high[c] + (1 - mix) * low[c]);
      }
    }
  }
  const int shapes = canvas.integer(14, 30);
  for (int i = 0; i < shapes; ++i) {
    cv::Mat drawn = canvas.image.clone();
    // Sizes as in nature: many small, few large.
    const int size = static_cast<int>(20.0 / std::sqrt(canvas.uniform(0.008, 1.0)));
    const cv::Scalar color = canvas.color();
    switch (canvas.integer(0, 3)) {
      case 0: {
        const int thickness = canvas.uniform(0, 1) < 0.6 ? -1 : 4;
        const double turn = canvas.uniform(0, 180);
        const cv::Size axes(size, static_cast<int>(size * canvas.uniform(0.3, 1.0)) + 1);
        cv::ellipse(drawn, canvas.point(), axes, turn, 0, 360, color, thickness, cv::LINE_AA);
        break;
      }
      case 1: {
        const cv::Point center = canvas.point();
        std::vector<cv::Point> corners;
        for (int k = 0, n = canvas.integer(3, 6); k < n; ++k) {
          const double angle = 2.0 * CV_PI * (k + canvas.uniform(-0.3, 0.3)) / n;
          corners.emplace_back(center.x + static_cast<int>(size * std::cos(angle)),
                               center.y + static_cast<int>(size * std::sin(angle)));
        }
        cv::fillPoly(drawn, std::vector<std::vector<cv::Point>>{corners}, color, cv::LINE_AA);
        break;
      }
      case 2: {
        const int thickness = canvas.integer(1, 9);
        const cv::Point end = canvas.point();
        cv::line(drawn, canvas.point(), end, color, thickness, cv::LINE_AA);
        break;
      }
      default: {
        const cv::Point start = canvas.point();
        cv::putText(drawn, canvas.word(), start, cv::FONT_HERSHEY_DUPLEX, size / 40.0 + 0.4, color,
                    2 + size / 30, cv::LINE_AA);
      }
    }
    blend(canvas.image, drawn, canvas.uniform(0.55, 1.0));
  }
  const cv::Scalar ink = canvas.color(0, 255);
  canvas.textLine(60, 460, 470, canvas.uniform(14, 34), ink);
  cv::rectangle(canvas.image, {0, 0}, {511, 511}, canvas.color(10, 240), 18);
  return canvas.finish(0.05, 0.15F);
}

Texture rugTexture(std::uint64_t seed) {
  Canvas canvas(512, 512, seed, cv::Scalar(0, 0, 0));
  canvas.image.setTo(canvas.color(30, 120));
  for (int border = 0; border < 6; ++border) {
    const int inset = 12 + border * 16 + canvas.integer(0, 6);
    const int thickness = canvas.integer(2, 10);
    cv::rectangle(canvas.image, {inset, inset}, {511 - inset, 511 - inset}, canvas.color(20, 220),
                  thickness);
  }
  // Ornaments, mirrored as on a woven rug but each with its own faults.
  for (int i = 0; i < 60; ++i) {
    const int size = canvas.integer(4, 26);
    const int center_y = canvas.integer(110, 256);
    const int center_x = canvas.integer(110, 256);
    const cv::Scalar color = canvas.color(20, 230);
    for (int mirror = 0; mirror < 4; ++mirror) {
      const cv::Point c(mirror & 1 ? 511 - center_x : center_x,
                        mirror & 2 ? 511 - center_y : center_y);
      const cv::Scalar tone = color + cv::Scalar::all(canvas.uniform(-25, 25));
      cv::ellipse(canvas.image, c, {size, size / 2 + 1}, canvas.uniform(-8, 8) + 45.0 * (i % 4), 0,
                  360, tone, i % 3 == 0 ? 2 : -1, cv::LINE_AA);
    }
  }
  return canvas.finish(0.22, 0.0F);
}

Texture printedPageTexture(std::uint64_t seed) {
  Canvas canvas(512, 512, seed, cv::Scalar(225, 232, 235));
  const cv::Scalar ink = canvas.color(10, 90);
  canvas.textLine(40, 480, 70, canvas.uniform(24, 38), ink);
  const int figure_left = canvas.integer(40, 260);
  const int figure_top = canvas.integer(110, 330);
  for (int y = 105; y < 490; y += canvas.integer(15, 19)) {
    const bool beside = y > figure_top - 12 && y < figure_top + 152;
    const int left = beside && figure_left < 150 ? figure_left + 215 : 40;
    const int right = beside && figure_left >= 150 ? figure_left - 8 : 478;
    if (canvas.uniform(0, 1) > 0.08) {
      canvas.textLine(left, right, y, 9.5, ink);
    }
  }
  const cv::Rect figure(figure_left, figure_top, 205, 130);
  cv::rectangle(canvas.image, figure, canvas.color(120, 240), -1);
  cv::Point last(figure.x, figure.y + 65);
  for (int x = 10; x <= 205; x += 13) {
    const cv::Point next(figure.x + x, figure.y + canvas.integer(8, 120));
    cv::line(canvas.image, last, next, canvas.color(10, 120), 3, cv::LINE_AA);
    last = next;
  }
  cv::rectangle(canvas.image, figure, ink, 2);
  return canvas.finish(0.03, 0.0F);
}

Texture bookRowTexture(std::uint64_t seed) {
  Canvas canvas(1024, 256, seed, cv::Scalar(18, 20, 22));
  int x = 3;
  while (x < 1000) {
    const int width = canvas.integer(16, 52);
    const int top = canvas.integer(4, 70);
    const cv::Scalar cover = canvas.color(25, 215);
    const cv::Scalar print = cover[1] > 120 ? canvas.color(0, 60) : canvas.color(170, 250);
    const cv::Rect back(x, top, std::min(width, 1021 - x), 256 - top);
    cv::rectangle(canvas.image, back, cover, -1);
    for (int band = canvas.integer(0, 3); band > 0; --band) {
      const int y = canvas.integer(top + 8, 240);
      const cv::Scalar color = canvas.color(30, 230);
      cv::rectangle(canvas.image, {back.x, y, back.width, canvas.integer(2, 14)}, color, -1);
    }
    // The title runs upwards: written on a strip, which is then turned.
    if (back.width > 14 && back.height > 60) {
      cv::Mat strip(back.width, back.height, CV_8UC3);
      cv::rotate(canvas.image(back), strip, cv::ROTATE_90_CLOCKWISE);
      const double size = 0.42 * back.width;
      const std::string last_word = canvas.word();
      const std::string title = canvas.word() + " " + last_word;
      cv::putText(strip, title, {12, back.width / 2 + static_cast<int>(size / 2)},
                  cv::FONT_HERSHEY_SIMPLEX, size / 21.0, print, 1, cv::LINE_AA);
      cv::Mat turned;
      cv::rotate(strip, turned, cv::ROTATE_90_COUNTERCLOCKWISE);
      turned.copyTo(canvas.image(back));
    }
    cv::line(canvas.image, {back.x, top}, {back.x, 255}, cover * 0.5, 2);
    x += width + (canvas.uniform(0, 1) < 0.08 ? canvas.integer(10, 40) : 1);
  }
  return canvas.finish(0.07, 0.1F);
}

Texture screenTexture(std::uint64_t seed) {
  Canvas canvas(512, 512, seed, cv::Scalar(60, 45, 35));
  for (int window = 0; window < 4; ++window) {
    const int height = canvas.integer(150, 270);
    const int width = canvas.integer(180, 270);
    const int top = canvas.integer(8, 230);
    const int left = canvas.integer(8, 230);
    const cv::Rect frame(left, top, width, height);
    const bool dark = canvas.uniform(0, 1) < 0.6;
    cv::rectangle(canvas.image, frame, dark ? cv::Scalar(38, 32, 30) : cv::Scalar(190, 190, 185),
                  -1);
    cv::rectangle(canvas.image, {frame.x, frame.y, frame.width, 18}, canvas.color(80, 180), -1);
    for (int y = frame.y + 36; y < frame.y + frame.height - 4; y += 16) {
      const int indent = 8 + 14 * canvas.integer(0, 3);
      const cv::Scalar ink = dark ? canvas.color(120, 230) : canvas.color(10, 100);
      const int end = canvas.integer(frame.width / 2, frame.width - 4);
      canvas.textLine(frame.x + indent, frame.x + end, y, 9, ink);
    }
  }
  cv::rectangle(canvas.image, {0, 0}, {511, 511}, cv::Scalar(18, 18, 18), 20);
  return canvas.finish(0.02, 1.0F);
}

Texture keyboardTexture(std::uint64_t seed) {
  Canvas canvas(512, 256, seed, cv::Scalar(30, 30, 30));
  for (int row = 0; row < 5; ++row) {
    for (int x = 12 + 9 * (row % 3); x < 480; x += 34) {
      const cv::Rect key(x, 14 + row * 47, 29, 40);
      cv::rectangle(canvas.image, key, cv::Scalar::all(canvas.uniform(60, 85)), -1);
      cv::putText(canvas.image, std::string(1, static_cast<char>('A' + canvas.integer(0, 25))),
                  {x + 7, key.y + 24}, cv::FONT_HERSHEY_SIMPLEX, 0.6, cv::Scalar(210, 215, 215), 1,
                  cv::LINE_AA);
    }
  }
  return canvas.finish(0.06, 0.2F);
}

}  // namespace mivo
