// SPDX-License-Identifier: BSD-3-Clause
#include "synthetic/scene.h"

#include <algorithm>
#include <cmath>

#include "mivo/core/error.h"
#include "synthetic/scene_builder.h"
#include "synthetic/scenes.h"

namespace mivo {
namespace {

struct NamedScene {
  const char* name;
  Scene (*make)(std::uint64_t seed);
};

constexpr NamedScene kScenes[] = {
    // Furnished.
    {"room", makeRoom},
    {"office", makeOffice},
    {"corridor", makeCorridor},
    {"wall", makeWall},
    {"bare", makeBare},
    // Of few edges and even colors.
    {"hallway", makeHallway},
    {"ceiling", makeCeiling},
    {"panels", makePanels},
    {"hall", makeHall},
    {"whiteboard", makeWhiteboard},
    // One surface that leaves directions open.
    {"stripes", makeStripes},
    {"blank", makeBlank},
    {"tube", makeTube},
    {"rings", makeRings},
    {"floor", makeStripedFloor},
    {"blank_floor", makeBlankFloor},
    {"stripes_after_texture", makeStripesAfterTexture},
    {"blank_after_texture", makeBlankAfterTexture},
};

// Unit vector that u points to, and its derivative's direction, around the axis of a round patch.
// Seen from outside and upright u runs to the right: counter-clockwise seen from above.
struct Around {
  Eigen::Vector3f radial;
  Eigen::Vector3f tangent;
};

Around around(const Eigen::Vector3f& axis_up, const Eigen::Vector3f& start, float u) {
  const Eigen::Vector3f side = axis_up.cross(start);
  const float angle = 2.0F * kPi * u;
  return {std::cos(angle) * start + std::sin(angle) * side,
          std::cos(angle) * side - std::sin(angle) * start};
}

}  // namespace

Eigen::Vector3f Patch::position(float u, float v) const {
  switch (shape) {
    case Shape::kParallelogram:
      return origin + u * edge_u + v * edge_v;
    case Shape::kFrustum: {
      const float radius = first_radius + v * (second_radius - first_radius);
      return origin + v * edge_v + radius * around(-edge_v.normalized(), edge_u, u).radial;
    }
    case Shape::kSphere: {
      const Eigen::Vector3f up = Eigen::Vector3f::UnitZ();
      return origin + first_radius * (std::sin(kPi * v) * around(up, edge_u, u).radial +
                                      std::cos(kPi * v) * up);
    }
  }
  return origin;
}

Eigen::Vector3f Patch::normal(float u, float v) const {
  switch (shape) {
    case Shape::kParallelogram:
      return edge_v.cross(edge_u).normalized();
    case Shape::kFrustum: {
      const Around a = around(-edge_v.normalized(), edge_u, u);
      const Eigen::Vector3f along = edge_v + (second_radius - first_radius) * a.radial;
      return along.cross(a.tangent).normalized();
    }
    case Shape::kSphere:
      return (position(u, v) - origin).normalized();
  }
  return Eigen::Vector3f::UnitZ();
}

Eigen::Vector2f Patch::size() const {
  switch (shape) {
    case Shape::kParallelogram:
      return {edge_u.norm(), edge_v.norm()};
    case Shape::kFrustum:
      return {2.0F * kPi * std::max(first_radius, second_radius),
              std::hypot(edge_v.norm(), second_radius - first_radius)};
    case Shape::kSphere:
      return {2.0F * kPi * first_radius, kPi * first_radius};
  }
  return Eigen::Vector2f::Ones();
}

const std::vector<std::string>& sceneNames() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const NamedScene& scene : kScenes) all.emplace_back(scene.name);
    return all;
  }();
  return names;
}

Scene makeScene(const std::string& name, std::uint64_t seed) {
  for (const NamedScene& known : kScenes) {
    if (name == known.name) {
      Scene scene = known.make(seed);
      scene.name = name;
      return scene;
    }
  }
  std::string expected;
  for (const std::string& known : sceneNames()) expected += (expected.empty() ? "" : ", ") + known;
  throw Error("unknown scene '" + name + "': expected one of " + expected);
}

}  // namespace mivo
