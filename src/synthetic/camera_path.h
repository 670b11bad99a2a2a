// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "synthetic/scene.h"

namespace mivo {

/// How a hand moves a camera in a scene: a closed form of time, so that the pose at any moment of
/// an exposure is exact. Never leaves the viewpoint's reach.
///
///   static           does not move at all
///   translation      drifts to and fro at up to 0.4 m/s, looking one way
///   rotation         turns at up to 40 deg/s, nearly in place
///   figure_of_eight  both, along a lying eight across the view
///   fast_rotation    the rotation, four times as fast
///   slide            on and on in a direction of the seed at 0.15 to 0.35 m/s, turning at up to
///                    20 deg/s, speeding up and slowing down; starts at the viewpoint's center
///
/// All but `static` and `slide` have the small tremor of a hand. A pace other than 1 makes all of
/// it faster or slower.
class CameraPath {
 public:
  /// The seed shifts phases and the tremor. Throws Error for an unknown name, listing the known
  /// ones.
  CameraPath(const std::string& name, const Viewpoint& viewpoint, std::uint64_t seed,
             double pace = 1.0);

  /// T_world_camera of the optical frame.
  Eigen::Isometry3d poseAt(double seconds) const;

  static const std::vector<std::string>& names();

 private:
  struct Swing {
    double amplitude = 0.0;  // m or rad
    double rate = 0.0;       // rad/s of the phase
    double phase = 0.0;

    double at(double t) const;
  };
  using Swings = std::array<Swing, 3>;

  void addTremor();
  void translate(const Eigen::Vector3d& peak_speed);
  void rotate(const Eigen::Vector3d& peak_speed);
  void followEight();
  void slide();
  double uniform(double low, double high);
  double randomPhase() { return uniform(0.0, 2.0 * M_PI); }
  Eigen::Vector3d randomDirection();

  Viewpoint viewpoint_;
  std::uint64_t seed_;
  double pace_;
  std::uint64_t draws_ = 0;
  Swings position_;  // x, y, z of the scene
  Swings angles_;    // yaw to the left, pitch upwards, roll
  std::array<Swings, 3> position_tremor_;
  std::array<Swings, 3> angle_tremor_;
};

}  // namespace mivo
