// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <functional>
#include <opencv2/core/mat.hpp>
#include <vector>

// Smooth images in closed form, with exact gradient and Hessian: derivatives of a raster would be
// limited by its interpolation.

namespace mivo::testing {

/// Value and derivatives with respect to the pixel.
struct ImageJet {
  double value = 0.0;
  Eigen::Vector2d gradient = Eigen::Vector2d::Zero();
  Eigen::Matrix2d hessian = Eigen::Matrix2d::Zero();
};

using AnalyticImage = std::function<ImageJet(const Eigen::Vector2d&)>;

/// Applies a function of one variable: (f, f', f'') at the value.
template <typename Curve>
ImageJet composed(const ImageJet& inner, const Curve& curve) {
  const Eigen::Vector3d f = curve(inner.value);
  return {f[0], f[1] * inner.gradient,
          f[1] * inner.hessian + f[2] * inner.gradient * inner.gradient.transpose()};
}

/// constant + slope . pixel.
inline AnalyticImage rampImage(double constant, const Eigen::Vector2d& slope) {
  return [=](const Eigen::Vector2d& p) {
    return ImageJet{constant + slope.dot(p), slope, Eigen::Matrix2d::Zero()};
  };
}

/// A plane wave: amplitude sin(frequency . pixel + phase).
struct Wave {
  double amplitude;
  Eigen::Vector2d frequency;
  double phase;
};

inline AnalyticImage waveImage(double mean, std::vector<Wave> waves) {
  return [=](const Eigen::Vector2d& p) {
    ImageJet jet;
    jet.value = mean;
    for (const Wave& wave : waves) {
      const double angle = wave.frequency.dot(p) + wave.phase;
      jet.value += wave.amplitude * std::sin(angle);
      jet.gradient += wave.amplitude * std::cos(angle) * wave.frequency;
      jet.hessian -= wave.amplitude * std::sin(angle) * wave.frequency * wave.frequency.transpose();
    }
    return jet;
  };
}

/// A bright (or dark) round spot: amplitude exp(-|pixel - center|^2 / (2 radius^2)).
struct Blob {
  double amplitude;
  Eigen::Vector2d center;
  double radius;
};

inline AnalyticImage blobImage(double background, std::vector<Blob> blobs) {
  return [=](const Eigen::Vector2d& p) {
    ImageJet jet;
    jet.value = background;
    for (const Blob& blob : blobs) {
      const double inverse = 1.0 / (blob.radius * blob.radius);
      const Eigen::Vector2d offset = p - blob.center;
      const double value = blob.amplitude * std::exp(-0.5 * inverse * offset.squaredNorm());
      jet.value += value;
      jet.gradient -= value * inverse * offset;
      jet.hessian +=
          value * inverse * (inverse * offset * offset.transpose() - Eigen::Matrix2d::Identity());
    }
    return jet;
  };
}

/// Waves of several directions around a middle gray: a symmetric histogram, for an image of about
/// 100 x 80 pixels.
inline AnalyticImage waves() {
  return waveImage(
      128.0, {{40.0, {0.19, 0.05}, 0.3}, {30.0, {-0.07, 0.16}, 1.1}, {15.0, {0.11, -0.21}, 2.0}});
}

/// A dark ground with a few bright spots: a histogram skewed to the dark end.
inline AnalyticImage blobs() {
  return blobImage(35.0, {{150.0, {27.0, 20.0}, 9.0},
                          {90.0, {66.0, 33.0}, 13.0},
                          {120.0, {40.0, 61.0}, 7.0},
                          {60.0, {85.0, 66.0}, 10.0},
                          {100.0, {90.0, 10.0}, 12.0}});
}

/// The waves seen by another sensor: a steep, falling, curved response.
inline AnalyticImage negativeOfWaves() {
  const AnalyticImage base = waves();
  return [base](const Eigen::Vector2d& p) {
    return composed(base(p), [](double value) {
      const double u = value / 255.0;
      return Eigen::Vector3d(230.0 * std::exp(-2.0 * u), -460.0 / 255.0 * std::exp(-2.0 * u),
                             920.0 / (255.0 * 255.0) * std::exp(-2.0 * u));
    });
  };
}

/// The waves seen by a sensor of another response, rising and curved, with spots of light on them.
inline AnalyticImage litWaves() {
  const AnalyticImage base = waves();
  const AnalyticImage light = blobs();
  return [base, light](const Eigen::Vector2d& p) {
    const ImageJet a = composed(base(p), [](double value) {
      return Eigen::Vector3d(value * value / 255.0, 2.0 * value / 255.0, 2.0 / 255.0);
    });
    const ImageJet b = light(p);
    return ImageJet{a.value + 0.2 * b.value, a.gradient + 0.2 * b.gradient,
                    a.hessian + 0.2 * b.hessian};
  };
}

/// constant + gradient . offset + offset . H offset / 2 around a center.
inline AnalyticImage quadraticImage(double constant, const Eigen::Vector2d& center,
                                    const Eigen::Vector2d& gradient,
                                    const Eigen::Matrix2d& hessian) {
  return [=](const Eigen::Vector2d& p) {
    const Eigen::Vector2d offset = p - center;
    return ImageJet{constant + gradient.dot(offset) + 0.5 * offset.dot(hessian * offset),
                    gradient + hessian * offset, hessian};
  };
}

/// The image on the pixel raster, CV_32FC1; pixel (x, y) shows the place (stride x, stride y).
inline cv::Mat rasterized(const AnalyticImage& image, int width, int height, double stride = 1.0) {
  cv::Mat result(height, width, CV_32FC1);
  for (int y = 0; y < height; ++y) {
    auto* row = result.ptr<float>(y);
    for (int x = 0; x < width; ++x) {
      row[x] = static_cast<float>(image({stride * x, stride * y}).value);
    }
  }
  return result;
}

}  // namespace mivo::testing
