// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "synthetic/texture.h"

namespace mivo {

/// Frame of a scene: meters, z up, floor at z = 0; the camera looks along +x at rest, +y is its
/// left.
struct Material {
  int texture = 0;
  float specular = 0.0F;          ///< strength of the highlight, times the texture's; 0: matt
  int gloss_doublings = 5;        ///< exponent of the highlight is 2^this
  int luminous_lamp = -1;         ///< the surface is the luminaire of this lamp; -1: no
  bool absorbs_infrared = false;  ///< the depth sensor gets nothing back
  bool clean = false;             ///< no stains: really without structure if its texture is
  bool stretched = false;         ///< the texture is a picture over the whole surface, not repeated
  /// Even light, matte: shading does not depend on the position on the surface.
  bool evenly_lit = false;
};

enum class Shape {
  kParallelogram,  ///< origin + u edge_u + v edge_v; outside is edge_v x edge_u
  kFrustum,  ///< around `edge_v` from `origin`: cylinder, cone, disc (edge_v tiny, one radius 0)
  kSphere    ///< around `origin`; v = 0 at its top
};

/// A piece of surface with parameters u, v in 0..1. Seen from outside, upright, u runs to the right
/// and v downwards, so that pictures are neither mirrored nor upside down.
struct Patch {
  Shape shape = Shape::kParallelogram;
  Eigen::Vector3f origin = Eigen::Vector3f::Zero();
  Eigen::Vector3f edge_u =
      Eigen::Vector3f::UnitX();  ///< frustum, sphere: direction of u = 0, a unit vector
  Eigen::Vector3f edge_v = Eigen::Vector3f::UnitY();
  float first_radius = 0.0F;   ///< frustum: at v = 0; sphere: its radius
  float second_radius = 0.0F;  ///< frustum: at v = 1
  int material = 0;
  Eigen::Vector2f texture_origin = Eigen::Vector2f::Zero();  ///< m, of a repeated texture

  Eigen::Vector3f position(float u, float v) const;
  Eigen::Vector3f normal(float u, float v) const;  ///< outward, unit length
  /// Lengths in meters along u and v.
  Eigen::Vector2f size() const;
};

constexpr int kNumLamps = 4;

/// Ceiling luminaire: a horizontal rectangle that shines downwards with a cosine.
struct Lamp {
  Eigen::Vector3f center = Eigen::Vector3f::Zero();
  float half_x = 0.3F;  ///< m
  float half_y = 0.15F;
};

/// Where the camera may go, and where the scene is to be looked at.
struct Viewpoint {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  Eigen::Vector3d reach =
      Eigen::Vector3d::Zero();  ///< free half extents along x, y, z around the center
  double yaw_reach = 0.5;       ///< rad, to both sides of +x; farther, nothing is worth looking at
  double pitch_reach = 0.2;     ///< rad, around `pitch`
  double pitch = 0.0;           ///< rad, upwards
  double roll = 0.0;  ///< rad about the optical axis, clockwise seen from behind the camera
};

struct Scene {
  std::string name;
  std::vector<Texture> textures;
  std::vector<Material> materials;
  std::vector<Patch> patches;
  /// Left front, left back, right front, right back, seen by the camera at rest.
  std::array<Lamp, kNumLamps> lamps;
  /// Where the illuminance of a lighting is stated, on a horizontal plane: the room's center.
  Eigen::Vector3f reference_point = Eigen::Vector3f::Zero();
  Viewpoint viewpoint;
  /// The moving lamp swings around this point, in front of the camera.
  Eigen::Vector3f moving_lamp_center = Eigen::Vector3f::Zero();
  Eigen::Vector3f moving_lamp_reach = Eigen::Vector3f::Zero();
};

/// One of sceneNames(). Throws Error for another name, listing these.
Scene makeScene(const std::string& name, std::uint64_t seed);
const std::vector<std::string>& sceneNames();

/// The scene with plaster of much structure on all that is lit evenly. Throws Error if nothing is.
Scene withTexture(Scene scene, std::uint64_t seed);

}  // namespace mivo
