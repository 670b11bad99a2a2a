// SPDX-License-Identifier: BSD-3-Clause
#include "synthetic/relighting.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/core.hpp>
#include <optional>

#include "mivo/core/error.h"
#include "synthetic/pixel_noise.h"

namespace mivo {
namespace {

constexpr double kTwoPi = 6.283185307179586;
// The spot light: how far and how fast it swings, how wide and bright it is.
constexpr double kSpotSeconds = 3.0;
constexpr double kSpotRadius = 0.16;   // of the image's width
constexpr double kSpotStrength = 6.0;  // times the light that is there anyway
constexpr double kSpotRest = 0.5;      // factor on the rest of the image
constexpr double kGradientSeconds = 4.0;
constexpr double kGradientOctaves = 1.3;  // brightness at the edges is 2^(+-this)
constexpr double kGammaSeconds = 1.5;
constexpr double kGammaRange = 1.8;
// A recording says nothing about its exposure: it is taken as this time at this gain.
const ExposureSetting kRecordedWith{0.015, 2.0};

ExposureControlOptions automatic(double target_gray) {
  ExposureControlOptions options;
  options.automatic = true;
  options.target_gray = std::clamp(target_gray, 20.0, 235.0);
  return options;
}

}  // namespace

const std::vector<std::string>& Relighting::names() {
  static const std::vector<std::string> names{"ramp",     "step",     "ramp_step", "oscillating",
                                              "spot",     "gradient", "gamma",     "auto_exposure",
                                              "darkness", "black",    "inversion"};
  return names;
}

Relighting::Relighting(const std::string& lighting, const SequenceTime& time, std::uint64_t seed)
    : name_(lighting),
      time_(time),
      seed_(seed),
      imager_(ImagerOptions{}),
      exposure_control_(automatic(ExposureControlOptions{}.target_gray), kRecordedWith) {
  if (std::find(names().begin(), names().end(), lighting) == names().end()) {
    std::string known;
    for (const std::string& name : names()) {
      known += (known.empty() ? "" : ", ") + name;
    }
    throw Error("unknown lighting '" + lighting + "': expected one of " + known);
  }
  if (time.frames < 1 || !(time.period > 0.0)) {
    throw Error("relighting: there must be frames, and time between them");
  }
}

double Relighting::globalFactor() const {
  const std::string curve_name = name_ == "auto_exposure" ? "oscillating" : name_;
  const std::optional<LightingCurve> curve = lightingCurve(curve_name);
  return curve ? illuminance(*curve, frame_ * time_.period, time_) / nominalIlluminance(*curve)
               : 1.0;
}

// Factor on the light of each pixel, CV_32FC1.
cv::Mat Relighting::factorImage(const cv::Size& size) const {
  cv::Mat factors(size, CV_32FC1, cv::Scalar(globalFactor()));
  const double t = frame_ * time_.period;
  const double phase = kTwoPi * uniformFrom(mixBits(seed_));
  if (name_ == "spot") {
    const double angle = kTwoPi * t / kSpotSeconds + phase;
    const double x0 = size.width * (0.5 + 0.45 * std::cos(angle));
    const double y0 = size.height * (0.5 + 0.35 * std::sin(1.7 * angle));
    const double radius = kSpotRadius * size.width;
    for (int y = 0; y < size.height; ++y) {
      for (int x = 0; x < size.width; ++x) {
        const double r2 = ((x - x0) * (x - x0) + (y - y0) * (y - y0)) / (radius * radius);
        factors.at<float>(y, x) =
            static_cast<float>(kSpotRest + kSpotStrength * std::exp(-0.5 * r2));
      }
    }
  } else if (name_ == "gradient") {
    const double angle = kTwoPi * t / kGradientSeconds + phase;
    const double slope = kGradientOctaves * std::sin(0.6 * angle);
    for (int y = 0; y < size.height; ++y) {
      for (int x = 0; x < size.width; ++x) {
        const double along = std::cos(angle) * (2.0 * x / size.width - 1.0) +
                             std::sin(angle) * (2.0 * y / size.height - 1.0);
        factors.at<float>(y, x) = static_cast<float>(std::exp2(slope * along));
      }
    }
  }
  return factors;
}

// Light from the recorded values, changed, through the sensor again.
cv::Mat Relighting::takeAgain(const cv::Mat& image) {
  const int channels = image.channels();
  const cv::Mat factors = factorImage(image.size());
  cv::Mat light(image.size(), CV_32FC(channels));
  const std::uint64_t dither_seed = hashOf(seed_, 0xd17e, static_cast<std::uint64_t>(frame_));
  // A value stands for all light that rounds to it: drawn evenly, or brightening would leave gaps.
  constexpr int kFine = 16;
  std::vector<float> linear(256 * kFine);
  for (std::size_t k = 0; k < linear.size(); ++k) {
    linear[k] = static_cast<float>(imager_.linear((static_cast<double>(k) + 0.5) / kFine - 0.5));
  }
  for (int y = 0; y < image.rows; ++y) {
    const auto* in = image.ptr<unsigned char>(y);
    const auto* factor = factors.ptr<float>(y);
    auto* out = light.ptr<float>(y);
    for (int x = 0; x < image.cols; ++x) {
      const std::uint64_t bits =
          hashOf(dither_seed, static_cast<std::uint64_t>(y), static_cast<std::uint64_t>(x));
      for (int c = 0; c < channels; ++c) {
        const std::size_t dither = (bits >> (8 * c)) % kFine;
        *out++ = factor[x] * linear[*in++ * kFine + dither];
      }
    }
  }
  const ExposureSetting setting =
      name_ == "auto_exposure" ? exposure_control_.current() : kRecordedWith;
  const cv::Mat taken =
      imager_.expose(light, setting.product() / kRecordedWith.product(), setting.gain,
                     hashOf(seed_, 0x7a4e, static_cast<std::uint64_t>(frame_)));
  if (name_ == "auto_exposure") {
    exposure_control_.advance(meanGray(taken), imager_);
  }
  return taken;
}

// Changes that are no light: a table from value to value.
cv::Mat Relighting::changeCurve(const cv::Mat& image) const {
  cv::Mat table(1, 256, CV_8UC1);
  const double t = frame_ * time_.period;
  const double gamma = std::pow(kGammaRange, std::sin(kTwoPi * t / kGammaSeconds));
  const bool inverted = name_ == "inversion" && 2 * frame_ >= time_.frames;
  for (int k = 0; k < 256; ++k) {
    const double value =
        name_ == "gamma" ? 255.0 * std::pow(k / 255.0, gamma) : (inverted ? 255 - k : k);
    table.at<unsigned char>(k) = cv::saturate_cast<unsigned char>(value);
  }
  cv::Mat changed;
  cv::LUT(image, table, changed);
  return changed;
}

cv::Mat Relighting::relight(const cv::Mat& image) {
  if (image.depth() != CV_8U ||
      (image.channels() != 1 && image.channels() != 3 && image.channels() != 4)) {
    throw Error("relighting: expected an 8-bit image with 1, 3 or 4 channels");
  }
  cv::Mat colors = image;
  cv::Mat alpha;
  if (image.channels() == 4) {
    std::vector<cv::Mat> channels;
    cv::split(image, channels);
    alpha = channels.back();
    channels.pop_back();
    cv::merge(channels, colors);
  }
  if (reference_gray_ < 0.0) {
    // The camera that recorded the first frame was content with its brightness.
    reference_gray_ = meanGray(colors);
    exposure_control_ = ExposureControl(automatic(reference_gray_), kRecordedWith);
  }
  cv::Mat relit =
      name_ == "gamma" || name_ == "inversion" ? changeCurve(colors) : takeAgain(colors);
  ++frame_;
  if (!alpha.empty()) {
    std::vector<cv::Mat> channels;
    cv::split(relit, channels);
    channels.push_back(alpha);
    cv::merge(channels, relit);
  }
  return relit;
}

}  // namespace mivo
