// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "mivo/core/camera.h"
#include "mivo/core/frame.h"
#include "mivo/core/se3.h"

namespace mivo::testing {

/// A rectangle with a smooth texture, in the world's coordinates, meters.
struct Rectangle {
  Eigen::Vector3d center;
  Eigen::Vector3d u;  ///< unit vector along the width
  Eigen::Vector3d v;  ///< unit vector along the height, orthogonal to u
  double half_width;
  double half_height;
  std::uint64_t texture;  ///< seed of the texture
};

/// Textured rectangles, whose images are rendered exactly by one ray per pixel.
using Scene = std::vector<Rectangle>;

/// A wall 2 m in front of the camera at the origin, larger than any view of it here.
Scene wallScene();

/// The same wall with a board half a meter in front of it: depth edges, and parallax to distinguish
/// rotation from translation.
Scene boardScene();

/// A room of 4 x 3 x 5 m around the camera, with two boards in it.
Scene roomScene();

/// What turns the texture's brightness t, 0..1, into gray levels at a pixel:
/// 255 (gain t^gamma + offset + spot exp(-|pixel - center|^2 / (2 radius^2))), clamped.
struct Light {
  double gain = 0.9;
  double offset = 0.03;
  double gamma = 1.0;
  double spot = 0.0;
  Eigen::Vector2d spot_center = Eigen::Vector2d::Zero();  ///< pixels
  double spot_radius = 1.0;                               ///< pixels
};

struct Sensor {
  double noise = 0.0;          ///< standard deviation, gray levels
  std::uint64_t seed = 1;      ///< of the noise
  bool integer_depth = false;  ///< CV_16UC1 in millimeters, otherwise CV_32FC1 in meters
};

/// The frame that a camera with the given pose records: stamp 0, gray rounded to 8 bits, depth
/// exact (0 where no rectangle is hit).
Frame render(const Scene& scene, const Camera& camera, const Eigen::Isometry3d& T_world_camera,
             const Light& light = {}, const Sensor& sensor = {});

/// The same with a rolling shutter: while the rows are read, the camera moves from
/// T retract(-twist / 2) to T retract(twist / 2), T being its pose at the middle row.
Frame renderRolling(const Scene& scene, const Camera& camera,
                    const Eigen::Isometry3d& T_world_camera, const Vector6& twist);

/// A frame with normal noise of this standard deviation (gray levels) on its image.
Frame withNoise(const Frame& frame, double deviation, std::uint64_t seed);

/// A small camera without distortion: 160 x 120 pixels, 63 degrees wide.
Camera smallCamera();

/// The same with the distortion of a usual lens.
Camera distortedCamera();

/// The same with an equidistant lens, 120 degrees wide.
Camera fisheyeCamera();

}  // namespace mivo::testing
