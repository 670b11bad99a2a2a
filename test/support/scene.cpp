// SPDX-License-Identifier: BSD-3-Clause
#include "support/scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "support/random_pose.h"

namespace mivo::testing {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr int kWaves = 14;
constexpr double kShortest = 0.13;  // m
constexpr double kLongest = 1.3;

/// A sum of plane waves of 0.13 to 1.3 m on a rectangle, at least eight pixels long at 2 m, so that
/// a pixel's center stands for its area. The sum is bent so that the histogram is skewed.
class Texture {
 public:
  explicit Texture(std::uint64_t seed) {
    Random random(seed);
    for (int i = 0; i < kWaves; ++i) {
      const double length =
          kShortest * std::pow(kLongest / kShortest, static_cast<double>(i) / (kWaves - 1));
      const double angle = random.uniform(0.0, 2.0 * kPi);
      Wave& wave = waves_[static_cast<std::size_t>(i)];
      wave = {2.0 * kPi / length * std::cos(angle), 2.0 * kPi / length * std::sin(angle),
              random.uniform(0.0, 2.0 * kPi), std::sqrt(length)};
      sum_ += wave.amplitude;
    }
  }

  /// Brightness 0..1 at a place on the rectangle, meters.
  double operator()(double u, double v) const {
    double value = 0.0;
    for (const Wave& wave : waves_) {
      value += wave.amplitude * std::sin(wave.u * u + wave.v * v + wave.phase);
    }
    const double t = 1.0 / (1.0 + std::exp(-8.0 * value / sum_));
    return t * (0.4 + 0.6 * t);
  }

 private:
  struct Wave {
    double u;
    double v;
    double phase;
    double amplitude;
  };
  std::array<Wave, kWaves> waves_{};
  double sum_ = 0.0;
};

Rectangle facingCamera(const Eigen::Vector3d& center, double half_width, double half_height,
                       std::uint64_t texture) {
  return {center, Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY(), half_width, half_height,
          texture};
}

struct Hit {
  double depth = 0.0;
  double brightness = 0.0;
};

Hit castRay(const Scene& scene, const std::vector<Texture>& textures, const Eigen::Vector3d& origin,
            const Eigen::Vector3d& direction) {
  double nearest = std::numeric_limits<double>::infinity();
  std::size_t index = 0;
  Eigen::Vector2d place = Eigen::Vector2d::Zero();
  for (std::size_t i = 0; i < scene.size(); ++i) {
    const Rectangle& r = scene[i];
    const Eigen::Vector3d normal = r.u.cross(r.v);
    const double distance = normal.dot(r.center - origin) / normal.dot(direction);
    if (!(distance > 0.0 && distance < nearest)) continue;
    const Eigen::Vector3d offset = origin + distance * direction - r.center;
    const Eigen::Vector2d at(r.u.dot(offset), r.v.dot(offset));
    if (std::abs(at.x()) > r.half_width || std::abs(at.y()) > r.half_height) continue;
    nearest = distance;
    index = i;
    place = at;
  }
  if (!std::isfinite(nearest)) return {};
  return {nearest, textures[index](place.x(), place.y())};
}

unsigned char grayLevel(double value) {
  return static_cast<unsigned char>(std::lround(std::min(std::max(value, 0.0), 255.0)));
}

double lightOf(const Light& light, double brightness, double x, double y) {
  double value = light.gain * std::pow(brightness, light.gamma) + light.offset;
  if (light.spot != 0.0) {
    const double square = (Eigen::Vector2d(x, y) - light.spot_center).squaredNorm();
    value += light.spot * std::exp(-0.5 * square / (light.spot_radius * light.spot_radius));
  }
  return value;
}

/// The ray of a pixel; beyond the range of the lens the one at its edge, for a lens sees something
/// there, too.
Eigen::Vector3d rayOf(const Camera& camera, const Eigen::Vector2d& pixel, const LensRange& range) {
  if (const auto ray = camera.ray(pixel, range)) return *ray;
  const Eigen::Vector2d center(camera.cx, camera.cy);
  const Eigen::Array2d focal_lengths(camera.fx, camera.fy);
  const double radius = ((pixel - center).array() / focal_lengths).matrix().norm();
  return *camera.ray(center + 0.999 * range.distorted / radius * (pixel - center), range);
}

template <typename PoseOfRow>
Frame renderRows(const Scene& scene, const Camera& camera, const PoseOfRow& poseOfRow,
                 const Light& light, const Sensor& sensor) {
  std::vector<Texture> textures;
  for (const Rectangle& rectangle : scene) textures.emplace_back(rectangle.texture);
  Frame frame;
  frame.image.create(camera.height, camera.width, CV_8UC1);
  frame.depth =
      cv::Mat::zeros(camera.height, camera.width, sensor.integer_depth ? CV_16UC1 : CV_32FC1);
  const LensRange range = camera.lensRange();
  for (int y = 0; y < camera.height; ++y) {
    const Eigen::Isometry3d T_world_camera = poseOfRow(y);
    for (int x = 0; x < camera.width; ++x) {
      // The ray has depth 1, so the distance along it is the depth of what it hits.
      const Hit hit = castRay(scene, textures, T_world_camera.translation(),
                              T_world_camera.linear() * rayOf(camera, {x, y}, range));
      frame.image.at<unsigned char>(y, x) = grayLevel(255.0 * lightOf(light, hit.brightness, x, y));
      if (sensor.integer_depth) {
        frame.depth.at<unsigned short>(y, x) =
            static_cast<unsigned short>(std::lround(1000.0 * hit.depth));
      } else {
        frame.depth.at<float>(y, x) = static_cast<float>(hit.depth);
      }
    }
  }
  return frame;
}

}  // namespace

Scene wallScene() {
  return {facingCamera({0.0, 0.0, 2.0}, 4.0, 3.0, 11)};
}

Scene boardScene() {
  return {facingCamera({0.0, 0.0, 2.0}, 4.0, 3.0, 11),
          facingCamera({-0.15, 0.1, 1.5}, 0.35, 0.3, 12)};
}

Scene roomScene() {
  const Eigen::Vector3d x = Eigen::Vector3d::UnitX();
  const Eigen::Vector3d y = Eigen::Vector3d::UnitY();
  const Eigen::Vector3d z = Eigen::Vector3d::UnitZ();
  return {{{0.0, 0.0, 2.5}, x, y, 2.0, 1.5, 21},   {{0.0, 0.0, -2.5}, x, y, 2.0, 1.5, 22},
          {{-2.0, 0.0, 0.0}, z, y, 2.5, 1.5, 23},  {{2.0, 0.0, 0.0}, z, y, 2.5, 1.5, 24},
          {{0.0, -1.5, 0.0}, x, z, 2.0, 2.5, 25},  {{0.0, 1.5, 0.0}, x, z, 2.0, 2.5, 26},
          {{-0.6, 0.3, 1.7}, x, y, 0.35, 0.3, 27}, {{0.7, -0.2, 2.0}, x, y, 0.4, 0.5, 28}};
}

Frame render(const Scene& scene, const Camera& camera, const Eigen::Isometry3d& T_world_camera,
             const Light& light, const Sensor& sensor) {
  return renderRows(
      scene, camera, [&](int) { return T_world_camera; }, light, sensor);
}

Frame renderRolling(const Scene& scene, const Camera& camera,
                    const Eigen::Isometry3d& T_world_camera, const Vector6& twist) {
  const auto poseOfRow = [&](int row) {
    const double tau = static_cast<double>(row) / camera.height - 0.5;
    return T_world_camera * retract(tau * twist);
  };
  return renderRows(scene, camera, poseOfRow, {}, {});
}

Frame withNoise(const Frame& frame, double deviation, std::uint64_t seed) {
  Random random(seed);
  Frame noisy = frame;
  noisy.image = frame.image.clone();
  for (int y = 0; y < noisy.image.rows; ++y) {
    for (int x = 0; x < noisy.image.cols; ++x) {
      auto& pixel = noisy.image.at<unsigned char>(y, x);
      pixel = grayLevel(pixel + deviation * random.normal());
    }
  }
  return noisy;
}

Camera smallCamera() {
  Camera camera;
  camera.width = 160;
  camera.height = 120;
  camera.fx = 131.0;
  camera.fy = 130.0;
  camera.cx = 79.0;
  camera.cy = 60.5;
  return camera;
}

Camera distortedCamera() {
  Camera camera = smallCamera();
  camera.distortion = {0.2, -0.35, 0.001, -0.002, 0.1};
  return camera;
}

Camera fisheyeCamera() {
  Camera camera = smallCamera();
  camera.fx = camera.fy = 75.0;
  camera.distortion = {0.03, -0.01, 0.0, 0.0, 0.002, -0.0005, 0.0, 0.0, LensModel::kEquidistant};
  return camera;
}

}  // namespace mivo::testing
