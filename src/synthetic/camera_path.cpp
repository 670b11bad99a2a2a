// SPDX-License-Identifier: BSD-3-Clause
#include "synthetic/camera_path.h"

#include <algorithm>
#include <cmath>

#include "mivo/core/error.h"
#include "synthetic/pixel_noise.h"

namespace mivo {
namespace {

constexpr double kTwoPi = 6.283185307179586;
constexpr double kDegree = kTwoPi / 360.0;
constexpr double kReachUsed = 0.8;   // the rest is for the tremor and for safety
constexpr double kRollReach = 0.12;  // rad
// Peak speeds of the three axes: together they stay below the limits that the header states.
const Eigen::Vector3d kTranslationSpeed(0.16, 0.29, 0.12);  // m/s along x, y, z
const Eigen::Vector3d kRotationSpeed(30.0 * kDegree, 15.0 * kDegree,
                                     8.0 * kDegree);  // yaw, pitch, roll
const Eigen::Vector3d kEightRotationSpeed(29.0 * kDegree, 14.0 * kDegree, 7.0 * kDegree);
constexpr double kEightSpeed = 0.37;  // m/s, where it is fastest
constexpr double kSwaySpeed = 0.04;   // m/s, of a camera that only turns
constexpr double kFastFactor = 4.0;
constexpr double kSlideSlowest = 0.15;  // m/s
constexpr double kSlideFastest = 0.35;
constexpr double kSlideTurnRate = 20.0 * kDegree;  // rad/s
constexpr double kSlideAcceleration = 0.25;        // m/s^2, of each of its swings along an axis
constexpr double kSlideTurnAcceleration = 0.6;     // rad/s^2
// A hand's tremor: three frequencies per axis, the faster the smaller.
constexpr std::array<double, 3> kTremorHertz{1.7, 3.9, 7.3};
constexpr double kTremorSpeed = 0.008;             // m/s, peak of each
constexpr double kTremorTurnRate = 0.6 * kDegree;  // rad/s, peak of each

}  // namespace

double CameraPath::Swing::at(double t) const {
  return amplitude * std::sin(rate * t + phase);
}

const std::vector<std::string>& CameraPath::names() {
  static const std::vector<std::string> names{"static",          "translation",   "rotation",
                                              "figure_of_eight", "fast_rotation", "slide"};
  return names;
}

CameraPath::CameraPath(const std::string& name, const Viewpoint& viewpoint, std::uint64_t seed,
                       double pace)
    : viewpoint_(viewpoint), seed_(seed), pace_(pace) {
  if (name == "static") {
    return;
  }
  if (name == "translation") {
    translate(kTranslationSpeed);
  } else if (name == "rotation" || name == "fast_rotation") {
    rotate((name == "rotation" ? 1.0 : kFastFactor) * kRotationSpeed);
    translate(Eigen::Vector3d::Constant(kSwaySpeed));
    for (Swing& swing : position_) {
      swing.amplitude *= 0.15;  // sways by centimeters
      swing.rate /= 0.15;
    }
  } else if (name == "figure_of_eight") {
    followEight();
  } else if (name == "slide") {
    slide();
    return;
  } else {
    throw Error(
        "unknown trajectory '" + name +
        "': expected static, translation, rotation, figure_of_eight, fast_rotation or slide");
  }
  addTremor();
}

double CameraPath::uniform(double low, double high) {
  return low + (high - low) * uniformFrom(hashOf(seed_, 0x9a7b, draws_++));
}

Eigen::Vector3d CameraPath::randomDirection() {
  const double z = uniform(-1.0, 1.0);
  const double azimuth = randomPhase();
  const double across = std::sqrt(1.0 - z * z);
  return {across * std::cos(azimuth), across * std::sin(azimuth), z};
}

void CameraPath::translate(const Eigen::Vector3d& peak_speed) {
  for (int i = 0; i < 3; ++i) {
    const double amplitude = kReachUsed * viewpoint_.reach[i];
    position_[static_cast<std::size_t>(i)] = {amplitude, peak_speed[i] / amplitude, randomPhase()};
  }
}

void CameraPath::rotate(const Eigen::Vector3d& peak_speed) {
  const Eigen::Vector3d amplitude(kReachUsed * viewpoint_.yaw_reach,
                                  kReachUsed * viewpoint_.pitch_reach, kReachUsed * kRollReach);
  for (int i = 0; i < 3; ++i) {
    angles_[static_cast<std::size_t>(i)] = {amplitude[i], peak_speed[i] / amplitude[i],
                                            randomPhase()};
  }
}

void CameraPath::followEight() {
  rotate(kEightRotationSpeed);
  const double across = kReachUsed * viewpoint_.reach.y();
  const double up = kReachUsed * viewpoint_.reach.z();
  // Both speeds peak where the eight crosses itself.
  const double rate = kEightSpeed / std::hypot(across, 2.0 * up);
  const double phase = randomPhase();
  position_[1] = {across, rate, phase};
  position_[2] = {up, 2.0 * rate, 2.0 * phase};
  position_[0] = {0.15 * viewpoint_.reach.x(), 1.3 * rate, randomPhase()};
}

void CameraPath::slide() {
  // Where there is room to go.
  const Eigen::Vector3d direction = randomDirection().cwiseProduct(viewpoint_.reach).normalized();
  const Eigen::Vector3d velocity = uniform(kSlideSlowest, kSlideFastest) * direction;
  const Eigen::Vector3d rotation_axis = randomDirection();
  const Eigen::Vector3d turn_rate = uniform(0.0, kSlideTurnRate) * rotation_axis;
  const Eigen::Vector3d angle_reach(viewpoint_.yaw_reach, viewpoint_.pitch_reach, kRollReach);
  for (int i = 0; i < 3; ++i) {
    const auto axis = static_cast<std::size_t>(i);
    // A long swing starts in its middle: nearly straight on where the reach is large.
    const double amplitude = kReachUsed * viewpoint_.reach[i];
    const double most = std::sqrt(kSlideAcceleration * amplitude);
    position_[axis] = {amplitude, std::clamp(velocity[i], -most, most) / amplitude, 0.0};
    const double angle = kReachUsed * angle_reach[i];
    const double most_turn = std::sqrt(kSlideTurnAcceleration * angle);
    angles_[axis] = {angle, std::clamp(turn_rate[i], -most_turn, most_turn) / angle, 0.0};
    // And a short one, for changes of speed.
    const double rate = kTwoPi / uniform(3.0, 6.0);
    const double short_reach = std::min(kSlideAcceleration / (rate * rate), 0.15 * amplitude);
    position_tremor_[0][axis] = {uniform(0.0, short_reach), rate, 0.0};
  }
}

void CameraPath::addTremor() {
  for (std::size_t k = 0; k < kTremorHertz.size(); ++k) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double rate = kTwoPi * kTremorHertz[k] * (1.0 + 0.1 * static_cast<double>(axis));
      position_tremor_[k][axis] = {kTremorSpeed / rate, rate, randomPhase()};
      angle_tremor_[k][axis] = {kTremorTurnRate / rate, rate, randomPhase()};
    }
  }
}

Eigen::Isometry3d CameraPath::poseAt(double seconds) const {
  const double t = pace_ * seconds;
  Eigen::Vector3d position = viewpoint_.center;
  Eigen::Vector3d angles(0.0, viewpoint_.pitch, viewpoint_.roll);
  for (int i = 0; i < 3; ++i) {
    const auto axis = static_cast<std::size_t>(i);
    position[i] += position_[axis].at(t);
    angles[i] += angles_[axis].at(t);
    for (std::size_t k = 0; k < kTremorHertz.size(); ++k) {
      position[i] += position_tremor_[k][axis].at(t);
      angles[i] += angle_tremor_[k][axis].at(t);
    }
  }
  Eigen::Matrix3d R_world_rest;  // optical axes of a camera that looks along +x, upright
  R_world_rest << 0.0, 0.0, 1.0, -1.0, 0.0, 0.0, 0.0, -1.0, 0.0;
  Eigen::Isometry3d T_world_camera = Eigen::Isometry3d::Identity();
  T_world_camera.linear() =
      (Eigen::AngleAxisd(angles[0], Eigen::Vector3d::UnitZ()) *
       Eigen::AngleAxisd(-angles[1], Eigen::Vector3d::UnitY()))
          .toRotationMatrix() *
      R_world_rest * Eigen::AngleAxisd(angles[2], Eigen::Vector3d::UnitZ()).toRotationMatrix();
  T_world_camera.translation() = position;
  return T_world_camera;
}

}  // namespace mivo
