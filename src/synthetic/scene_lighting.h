// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

#include "synthetic/lighting_curve.h"
#include "synthetic/scene.h"

namespace mivo {

/// The light in a scene at one moment.
struct LightState {
  /// What each ceiling lamp adds to the illuminance at the scene's reference point, lux.
  std::array<float, kNumLamps> lamp_lux{};
  float ambient_lux = 0.0F;  ///< light from everywhere (a window, the neighboring room)
  float moving_lux = 0.0F;   ///< of the moving lamp, at 1 m; 0: there is none
  Eigen::Vector3f moving_position = Eigen::Vector3f::Zero();

  /// At the reference point, without the moving lamp.
  float total() const;
};

/// The named lightings of the generator: the curves of lighting_curve.h on all lamps together, and
///   left_right   all light comes from the left lamps, then from the right ones, changing every 2 s
///   moving_lamp  dim ceiling lamps (12 lux), and a bright lamp swinging through the view
class SceneLighting {
 public:
  /// Throws Error for an unknown name, listing the known ones.
  SceneLighting(const std::string& name, const SequenceTime& time, const Scene& scene);

  LightState at(double t) const;

  static const std::vector<std::string>& names();

 private:
  LightState leftRight(double t) const;
  LightState movingLamp(double t) const;

  std::string name_;
  SequenceTime time_;
  Eigen::Vector3f moving_center_;
  Eigen::Vector3f moving_reach_;
};

}  // namespace mivo
