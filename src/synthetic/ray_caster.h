// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <memory>

#include "synthetic/scene.h"

namespace mivo {

constexpr int kPacketSize = 8;

/// Eight rays origin + t direction, t > 0, traced together; rays at and after `count` are ignored.
struct RayPacket {
  using Lane = std::array<float, kPacketSize>;
  int count = kPacketSize;
  alignas(32) Lane origin_x, origin_y, origin_z;
  alignas(32) Lane direction_x, direction_y, direction_z;  ///< of any length
  // Results of `trace`.
  alignas(32) Lane distance;           ///< t of the first surface
  alignas(32) Lane u, v;               ///< parameters of the patch there
  std::array<int, kPacketSize> patch;  ///< -1: nothing was hit

  void setOrigin(int lane, const Eigen::Vector3f& origin);
  void setDirection(int lane, const Eigen::Vector3f& direction);
};

/// The scene's surfaces, arranged for fast intersection (Embree). Const functions may be called
/// from several threads.
class RayCaster {
 public:
  explicit RayCaster(const Scene& scene);
  ~RayCaster();
  RayCaster(const RayCaster&) = delete;
  RayCaster& operator=(const RayCaster&) = delete;

  /// First surface along each ray.
  void trace(RayPacket& packet) const;

  /// Whether anything lies between origin and origin + direction, for each ray.
  std::array<bool, kPacketSize> isBlocked(const RayPacket& packet) const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace mivo
