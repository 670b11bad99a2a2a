// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstdint>

#include "synthetic/scene.h"
#include "synthetic/texture_patterns.h"

namespace mivo {

constexpr float kPi = 3.14159265F;

/// A material with a highlight of this strength and of exponent 2^doublings.
Material glossy(float specular, int doublings);

/// Puts patches and furniture into a scene. Coordinates are those of the frame set by `place`, so
/// that a piece of furniture is written down once and stands anywhere, turned by any angle.
class SceneBuilder {
 public:
  explicit SceneBuilder(std::uint64_t seed) : seed_(seed) {}

  /// Adds a material; the result is passed to the functions below.
  int material(Texture texture, const Material& properties = {});
  /// Without structure: one even color (blue, green, red reflectance), and stainless.
  int plain(const Reflectance& color, float specular, int doublings);
  int picture(Texture texture, float specular = 0.0F, bool absorbs_infrared = false);

  /// Following coordinates are relative to this point (on the floor, or anywhere), turned about z.
  void place(float x, float y, float z, float yaw);

  float uniform(float low, float high);
  std::uint64_t nextSeed() { return seed_ + 1000 * ++seeds_; }

  /// Upright rectangle facing direction `facing` (rad about z; 0: towards +x), size in meters.
  void uprightPanel(const Eigen::Vector3f& center, float facing, float width, float height,
                    int material);
  /// Horizontal rectangle facing up or down.
  void levelPanel(const Eigen::Vector3f& center, float size_x, float size_y, bool up, int material);
  /// Box on its bottom center, with another material on top if given; no bottom face.
  void box(const Eigen::Vector3f& bottom, const Eigen::Vector3f& size, int material, int top = -1);
  /// Vertical cylinder or cone on its bottom center, closed at the top.
  void cylinder(const Eigen::Vector3f& bottom, float bottom_radius, float top_radius, float height,
                int material);
  void sphere(const Eigen::Vector3f& center, float radius, int material);

  /// Shell of floor, ceiling and walls facing inwards: front (+x), left (+y), back, right.
  void shell(const Eigen::Vector3f& low, const Eigen::Vector3f& high, int floor, int ceiling,
             const std::array<int, 4>& walls);
  /// The four ceiling lamps with their luminaires, below a ceiling at this height.
  void lamps(const Eigen::Vector2f& center, float spacing_x, float spacing_y, float ceiling);

  // Furniture, standing at the placed point, its front towards -x (towards the camera at rest).
  void table(float width, float depth, float height, int top, int legs);
  void chair(int seat, int legs);
  void sofa(float width, int fabric, int cushion);
  void bookshelf(float width, float height, int boards, const std::vector<int>& books);
  void monitor(int screen, int body);

  Scene scene;

 private:
  void add(Patch patch);

  std::uint64_t seed_;
  std::uint64_t seeds_ = 0;
  std::uint64_t draws_ = 0;
  Eigen::Isometry3f T_scene_local_ = Eigen::Isometry3f::Identity();
};

}  // namespace mivo
