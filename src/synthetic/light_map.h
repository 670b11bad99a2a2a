// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "synthetic/ray_caster.h"
#include "synthetic/scene.h"

namespace mivo {

/// Data that depend on the position in the scene only, computed once: which part of each lamp a
/// surface sees (soft shadows), how open it lies to the light of the room, and its stains.
class LightMap {
 public:
  struct Node {
    Eigen::Array4f visibility;  ///< of the four lamps, 0..1
    Eigen::Array4f openness;    ///< [0]: part of the hemisphere that is open, 0..1; [1]: stain,
                                ///< factor on the reflectance; the rest is unused
  };

  /// Casts the shadow rays, on all threads of cv::parallel_for_.
  LightMap(const Scene& scene, const RayCaster& caster, std::uint64_t seed);

  /// Bilinear between nodes 3 cm apart (400 along the longest pieces at most).
  Node at(int patch, float u, float v) const;

 private:
  struct Layer {
    int columns;
    int rows;
    std::size_t first;
  };
  Node compute(const Scene& scene, const RayCaster& caster, const Patch& patch, float u, float v,
               std::uint64_t seed) const;
  void smooth();

  std::vector<Layer> layers_;
  std::vector<Node> nodes_;
};

}  // namespace mivo
