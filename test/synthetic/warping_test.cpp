// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/core.hpp>
#include <vector>

#include "mivo/core/se3.h"
#include "support/projection.h"
#include "synthetic/sequence_generator.h"

// The images, the depth and the poses of a sequence must agree: a frame warped into another one by
// the true pose and depth leaves nothing but noise, and no other pose fits better.

namespace mivo {
namespace {

GeneratorOptions options(bool ideal) {
  GeneratorOptions result;
  result.scene = "room";
  result.trajectory = "figure_of_eight";
  result.frames = 11;
  result.camera = xtionCamera(320, 240);
  result.sensor.samples = 16;
  if (ideal) result.sensor.makeIdeal();
  return result;
}

std::vector<SyntheticFrame> film(const GeneratorOptions& options) {
  SequenceGenerator generator(options);
  std::vector<SyntheticFrame> frames;
  while (!generator.atEnd()) frames.push_back(generator.next());
  return frames;
}

const std::vector<SyntheticFrame>& idealFrames() {
  static const std::vector<SyntheticFrame> frames = film(options(true));
  return frames;
}

struct Bilinear {
  int x;
  int y;
  std::array<float, 4> weights;  // of (x, y), (x + 1, y), (x, y + 1), (x + 1, y + 1)

  explicit Bilinear(const Eigen::Vector2d& pixel)
      : x(static_cast<int>(std::floor(pixel.x()))), y(static_cast<int>(std::floor(pixel.y()))) {
    const auto ax = static_cast<float>(pixel.x() - x);
    const auto ay = static_cast<float>(pixel.y() - y);
    weights = {(1 - ax) * (1 - ay), ax * (1 - ay), (1 - ax) * ay, ax * ay};
  }
  template <typename Value>
  float sum(const Value& value) const {
    return weights[0] * value(x, y) + weights[1] * value(x + 1, y) + weights[2] * value(x, y + 1) +
           weights[3] * value(x + 1, y + 1);
  }
};

struct Match {
  int x;
  int y;
  Bilinear live;
  Eigen::Vector3d point;  // in the live camera
};

// Whether the surrounding pixels are on one plane: inverse depth is then linear in the image. A
// depth step of a few centimeters mixes two surfaces in a pixel, whose parallax a warp cannot
// represent.
bool isPlane(const cv::Mat& depth, int x, int y) {
  constexpr int kRadius = 3;
  const float inverse = 1.0F / depth.at<float>(y, x);
  for (int dy = 0; dy <= kRadius; ++dy) {
    for (int dx = -kRadius; dx <= kRadius; ++dx) {
      const float mean =
          0.5F / depth.at<float>(y + dy, x + dx) + 0.5F / depth.at<float>(y - dy, x - dx);
      if (std::abs(mean - inverse) > 0.0015F * inverse) return false;
    }
  }
  return true;
}

// Pixels of one frame that the other one sees, away from the edges of objects.
std::vector<Match> match(const SyntheticFrame& reference, const SyntheticFrame& live,
                         const Camera& camera) {
  const Eigen::Isometry3d T_live_ref = live.T_world_camera.inverse() * reference.T_world_camera;
  std::vector<Match> matches;
  for (int y = 4; y < camera.height - 4; y += 2) {
    for (int x = 4; x < camera.width - 4; x += 2) {
      if (!isPlane(reference.exact_depth, x, y)) continue;
      const Eigen::Vector3d point =
          T_live_ref * (reference.exact_depth.at<float>(y, x) * *camera.ray(Eigen::Vector2d(x, y)));
      const auto pixel = testing::project(camera, point);
      if (!pixel || pixel->x() < 5 || pixel->y() < 5 || pixel->x() > camera.width - 6 ||
          pixel->y() > camera.height - 6) {
        continue;
      }
      const Bilinear at(*pixel);
      if (!isPlane(live.exact_depth, at.x, at.y)) continue;
      const float seen = at.sum([&](int u, int v) { return live.exact_depth.at<float>(v, u); });
      if (std::abs(seen - point.z()) > 0.01 * point.z()) continue;  // hidden by something nearer
      matches.push_back({x, y, at, point});
    }
  }
  return matches;
}

float green(const cv::Mat& image, int x, int y) {
  return image.at<cv::Vec3b>(y, x)[1];
}

float residual(const SyntheticFrame& reference, const SyntheticFrame& live, const Match& m) {
  return m.live.sum([&](int x, int y) { return green(live.color, x, y); }) -
         green(reference.color, m.x, m.y);
}

// One Gauss-Newton step of the live pose: T_live_ref should become retract(step) * T_live_ref.
Vector6 gaussNewtonStep(const SyntheticFrame& reference, const SyntheticFrame& live,
                        const Camera& camera) {
  Matrix6 H = Matrix6::Zero();
  Vector6 b = Vector6::Zero();
  for (const Match& m : match(reference, live, camera)) {
    const float r = residual(reference, live, m);
    if (std::abs(r) > 20.0F) continue;  // highlights move with the viewer
    const float gx = 0.5F * m.live.sum([&](int x, int y) {
      return green(live.color, x + 1, y) - green(live.color, x - 1, y);
    });
    const float gy = 0.5F * m.live.sum([&](int x, int y) {
      return green(live.color, x, y + 1) - green(live.color, x, y - 1);
    });
    const double z = m.point.z();
    const Eigen::Vector3d by_point(
        gx * camera.fx / z, gy * camera.fy / z,
        -(gx * camera.fx * m.point.x() + gy * camera.fy * m.point.y()) / (z * z));
    Vector6 J;
    J << by_point, m.point.cross(by_point);
    H += J * J.transpose();
    b -= J * r;
  }
  return H.ldlt().solve(b);
}

// The distance from the stated pose to the one that fits the images best.
Vector6 preferredCorrection(const SyntheticFrame& reference, SyntheticFrame live,
                            const Camera& camera) {
  const Eigen::Isometry3d T_world_stated = live.T_world_camera;
  constexpr int kSteps = 8;  // each halves the error at least
  for (int k = 0; k < kSteps; ++k) {
    live.T_world_camera =
        live.T_world_camera * retract(gaussNewtonStep(reference, live, camera)).inverse();
  }
  return localCoordinates(live.T_world_camera.inverse() * T_world_stated);
}

TEST(Warping, IdealSensorLeavesOnlyTheErrorOfInterpolation) {
  const Camera camera = options(true).camera;
  for (const std::size_t live : {std::size_t{1}, std::size_t{5}, std::size_t{10}}) {
    const SyntheticFrame& a = idealFrames()[0];
    const SyntheticFrame& b = idealFrames()[live];
    const std::vector<Match> matches = match(a, b, camera);
    ASSERT_GT(matches.size(), 4000U);
    std::vector<float> magnitudes;
    std::vector<float> unwarped;
    for (const Match& m : matches) {
      magnitudes.push_back(std::abs(residual(a, b, m)));
      unwarped.push_back(std::abs(green(b.color, m.x, m.y) - green(a.color, m.x, m.y)));
    }
    const auto median = static_cast<std::ptrdiff_t>(matches.size() / 2);
    std::nth_element(magnitudes.begin(), magnitudes.begin() + median, magnitudes.end());
    std::nth_element(unwarped.begin(), unwarped.begin() + median, unwarped.end());
    // Two roundings to 8 bits and a bilinear interpolation of a textured image.
    EXPECT_LT(magnitudes[matches.size() / 2], 2.0F) << live;
    EXPECT_GT(unwarped[matches.size() / 2], 2.0F * magnitudes[matches.size() / 2]) << live;
  }
}

TEST(Warping, NoOtherPoseFitsBetterThanTheTruth) {
  const Camera camera = options(true).camera;
  for (const std::size_t live : {std::size_t{2}, std::size_t{6}, std::size_t{10}}) {
    const Vector6 d = preferredCorrection(idealFrames()[0], idealFrames()[live], camera);
    // A tenth of a pixel is 0.4 mrad, or 0.8 mm at 2 m.
    EXPECT_LT(d.head<3>().norm(), 7e-4) << live << ": " << d.transpose();
    EXPECT_LT(d.tail<3>().norm(), 2.5e-4) << live << ": " << d.transpose();
  }
}

TEST(Warping, AWrongPoseIsNoticed) {
  std::vector<SyntheticFrame> frames{idealFrames()[0], idealFrames()[5]};
  const Vector6 wrong = (Vector6() << 0.002, -0.001, 0.001, 0.0005, 0.001, -0.0005).finished();
  frames[1].T_world_camera = frames[1].T_world_camera * retract(wrong);
  const Vector6 d = preferredCorrection(frames[0], frames[1], options(true).camera);
  // T_live_ref = retract(wrong)^-1 * truth: the correction undoes it.
  EXPECT_LT((d - wrong).head<3>().norm(), 0.3 * wrong.head<3>().norm()) << d.transpose();
  EXPECT_LT((d - wrong).tail<3>().norm(), 0.3 * wrong.tail<3>().norm()) << d.transpose();
}

// The same sequence with and without noise: what the noise adds to each residual has the variance
// that the sensor model predicts for the pixels involved.
TEST(Warping, NoiseHasTheVarianceOfTheSensorModel) {
  GeneratorOptions noisy = options(true);
  noisy.frames = 2;
  noisy.sensor.imager.noise = true;
  noisy.sensor.gain = 2.0;
  GeneratorOptions clean = noisy;
  clean.sensor.imager.noise = false;
  const std::vector<SyntheticFrame> with = film(noisy);
  const std::vector<SyntheticFrame> without = film(clean);
  const ImagerOptions& model = noisy.sensor.imager;
  const Imager imager(model);
  // Gray levels squared, of one pixel: the sensor's noise through the slope of the encoding, and
  // the difference of two roundings.
  const auto variance = [&](float value) {
    const double light = imager.linear(value);
    const double unit = noisy.sensor.gain / model.full_well;
    const double noise = std::sqrt(light / unit + model.read_noise * model.read_noise) * unit;
    const double slope = (imager.encode(light + 1e-4) - imager.encode(light - 1e-4)) / 2e-4;
    return noise * noise * slope * slope + 2.0 / 12.0;
  };
  double sum = 0.0;
  int count = 0;
  for (const Match& m : match(without[0], without[1], noisy.camera)) {
    const float value = green(without[0].color, m.x, m.y);
    if (value < 40.0F || value > 215.0F)
      continue;  // clipping, and where the encoding is not linear
    double predicted = variance(value);
    const std::array<std::array<int, 2>, 4> corners{{{0, 0}, {1, 0}, {0, 1}, {1, 1}}};
    for (std::size_t k = 0; k < 4; ++k) {
      const float corner =
          green(without[1].color, m.live.x + corners[k][0], m.live.y + corners[k][1]);
      predicted += m.live.weights[k] * m.live.weights[k] * variance(corner);
    }
    const double added = residual(with[0], with[1], m) - residual(without[0], without[1], m);
    sum += added * added / predicted;
    ++count;
  }
  ASSERT_GT(count, 3000);
  // The mean of n squared normals scatters by sqrt(2 / n): 2.6 % at 3000.
  EXPECT_NEAR(sum / count, 1.0, 0.1);
}

TEST(Warping, FullSensorStillAgreesWithTheTruth) {
  GeneratorOptions full = options(false);
  full.frames = 6;
  const std::vector<SyntheticFrame> frames = film(full);
  for (const std::size_t live : {std::size_t{2}, std::size_t{5}}) {
    const Vector6 d = preferredCorrection(frames[0], frames[live], full.camera);
    EXPECT_LT(d.head<3>().norm(), 2e-3) << d.transpose();
    EXPECT_LT(d.tail<3>().norm(), 1e-3) << d.transpose();
  }
}

// A lens is rendered with the camera model that readers of the sequence use.
TEST(Warping, LensDistortionAgreesToo) {
  GeneratorOptions distorted = options(true);
  distorted.camera.distortion = {0.2624, -0.9531, -0.0054, 0.0026, 1.1633};
  distorted.frames = 6;
  const std::vector<SyntheticFrame> frames = film(distorted);
  std::vector<float> magnitudes;
  for (const Match& m : match(frames[0], frames[5], distorted.camera)) {
    magnitudes.push_back(std::abs(residual(frames[0], frames[5], m)));
  }
  ASSERT_GT(magnitudes.size(), 4000U);
  std::nth_element(magnitudes.begin(),
                   magnitudes.begin() + static_cast<std::ptrdiff_t>(magnitudes.size() / 2),
                   magnitudes.end());
  EXPECT_LT(magnitudes[magnitudes.size() / 2], 2.0F);
}

}  // namespace
}  // namespace mivo
