// SPDX-License-Identifier: BSD-3-Clause
#include "synthetic/ray_caster.h"

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <algorithm>
#include <limits>
#include <string>

#include "mivo/core/error.h"

namespace mivo {
namespace {

// Shadow rays stop just before their end, which lies on a lamp or a surface.
constexpr float kShadowEnd = 0.999F;

struct Grid {
  int columns = 1;
  int rows = 1;
};

// Flat pieces need one quadrilateral; 48 around make a circle round to 0.2 % of its radius. What
// fills the view is round to 10 micrometers, of pieces that are not too narrow to be hit exactly.
constexpr Grid kFurniture{48, 1};
constexpr Grid kTube{960, 64};
constexpr float kWidestFurniture = 0.5F;  // m, radius

Grid gridOf(const Patch& patch) {
  switch (patch.shape) {
    case Shape::kParallelogram:
      return {1, 1};
    case Shape::kFrustum:
      return std::max(patch.first_radius, patch.second_radius) < kWidestFurniture ? kFurniture
                                                                                  : kTube;
    case Shape::kSphere:
      return {48, 24};
  }
  return {};
}

void check(RTCDevice device) {
  const RTCError error = rtcGetDeviceError(device);
  if (error != RTC_ERROR_NONE) {
    throw Error("ray caster: Embree reports error " + std::to_string(static_cast<int>(error)));
  }
}

void addPatch(RTCDevice device, RTCScene scene, const Patch& patch, const Grid& grid) {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_QUAD);
  const auto columns = static_cast<unsigned>(grid.columns);
  const auto rows = static_cast<unsigned>(grid.rows);
  auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0,
                                                               RTC_FORMAT_FLOAT3, 3 * sizeof(float),
                                                               (columns + 1U) * (rows + 1U)));
  auto* quads = static_cast<unsigned*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT4, 4 * sizeof(unsigned), columns * rows));
  check(device);
  for (unsigned row = 0; row <= rows; ++row) {
    for (unsigned column = 0; column <= columns; ++column) {
      const Eigen::Vector3f p =
          patch.position(static_cast<float>(column) / static_cast<float>(columns),
                         static_cast<float>(row) / static_cast<float>(rows));
      for (int i = 0; i < 3; ++i) {
        *vertices++ = p[i];
      }
    }
  }
  for (unsigned row = 0; row < rows; ++row) {
    for (unsigned column = 0; column < columns; ++column) {
      const unsigned first = row * (columns + 1U) + column;
      *quads++ = first;
      *quads++ = first + 1U;
      *quads++ = first + columns + 2U;
      *quads++ = first + columns + 1U;
    }
  }
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene, geometry);  // numbers count up from 0: those of the patches
  rtcReleaseGeometry(geometry);
  check(device);
}

// What a query is told besides its rays: that they go about the same way.
#if RTC_VERSION_MAJOR >= 4
void intersect(const int* valid, RTCScene scene, RTCRayHit8& rays) {
  RTCIntersectArguments arguments;
  rtcInitIntersectArguments(&arguments);
  arguments.flags = RTC_RAY_QUERY_FLAG_COHERENT;
  rtcIntersect8(valid, scene, &rays, &arguments);
}

void findBlocked(const int* valid, RTCScene scene, RTCRay8& rays) {
  RTCOccludedArguments arguments;
  rtcInitOccludedArguments(&arguments);
  arguments.flags = RTC_RAY_QUERY_FLAG_COHERENT;
  rtcOccluded8(valid, scene, &rays, &arguments);
}
#else
RTCIntersectContext makeContext() {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  return context;
}

void intersect(const int* valid, RTCScene scene, RTCRayHit8& rays) {
  RTCIntersectContext context = makeContext();
  rtcIntersect8(valid, scene, &context, &rays);
}

void findBlocked(const int* valid, RTCScene scene, RTCRay8& rays) {
  RTCIntersectContext context = makeContext();
  rtcOccluded8(valid, scene, &context, &rays);
}
#endif

void fillRays(RTCRay8& rays, const RayPacket& packet, float end, int* valid) {
  for (int i = 0; i < kPacketSize; ++i) {
    const auto k = static_cast<std::size_t>(i);
    valid[i] = i < packet.count ? -1 : 0;
    rays.org_x[i] = packet.origin_x[k];
    rays.org_y[i] = packet.origin_y[k];
    rays.org_z[i] = packet.origin_z[k];
    rays.dir_x[i] = packet.direction_x[k];
    rays.dir_y[i] = packet.direction_y[k];
    rays.dir_z[i] = packet.direction_z[k];
    rays.tnear[i] = 0.0F;
    rays.tfar[i] = end;
    rays.time[i] = 0.0F;
    rays.mask[i] = ~0U;
    rays.id[i] = static_cast<unsigned>(i);
    rays.flags[i] = 0U;
  }
}

}  // namespace

void RayPacket::setOrigin(int lane, const Eigen::Vector3f& origin) {
  const auto k = static_cast<std::size_t>(lane);
  origin_x[k] = origin.x();
  origin_y[k] = origin.y();
  origin_z[k] = origin.z();
}

void RayPacket::setDirection(int lane, const Eigen::Vector3f& direction) {
  const auto k = static_cast<std::size_t>(lane);
  direction_x[k] = direction.x();
  direction_y[k] = direction.y();
  direction_z[k] = direction.z();
}

class RayCaster::Implementation {
 public:
  explicit Implementation(const Scene& scene) {
    // Embree's own threads would only build the small tree; one keeps the result the same
    // everywhere.
    device_ = rtcNewDevice("threads=1");
    if (device_ == nullptr) {
      throw Error("ray caster: Embree cannot be initialized on this machine");
    }
    scene_ = rtcNewScene(device_);
    rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
    for (const Patch& patch : scene.patches) {
      grids_.push_back(gridOf(patch));
      addPatch(device_, scene_, patch, grids_.back());
    }
    rtcCommitScene(scene_);
    check(device_);
  }
  ~Implementation() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }
  Implementation(const Implementation&) = delete;
  Implementation& operator=(const Implementation&) = delete;

  void trace(RayPacket& packet) const {
    alignas(32) RTCRayHit8 rays;
    alignas(32) int valid[kPacketSize];
    fillRays(rays.ray, packet, std::numeric_limits<float>::infinity(), valid);
    for (int i = 0; i < kPacketSize; ++i) {
      rays.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
      rays.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
    }
    intersect(valid, scene_, rays);
    for (int i = 0; i < kPacketSize; ++i) {
      const auto k = static_cast<std::size_t>(i);
      if (i >= packet.count || rays.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID) {
        packet.patch[k] = -1;
        continue;
      }
      packet.patch[k] = static_cast<int>(rays.hit.geomID[i]);
      packet.distance[k] = rays.ray.tfar[i];
      const Grid& grid = grids_[rays.hit.geomID[i]];
      const int cell = static_cast<int>(rays.hit.primID[i]);
      packet.u[k] = (static_cast<float>(cell % grid.columns) + rays.hit.u[i]) /
                    static_cast<float>(grid.columns);
      packet.v[k] =
          (static_cast<float>(cell / grid.columns) + rays.hit.v[i]) / static_cast<float>(grid.rows);
    }
  }

  std::array<bool, kPacketSize> isBlocked(const RayPacket& packet) const {
    alignas(32) RTCRay8 rays;
    alignas(32) int valid[kPacketSize];
    fillRays(rays, packet, kShadowEnd, valid);
    findBlocked(valid, scene_, rays);
    std::array<bool, kPacketSize> blocked{};
    for (int i = 0; i < packet.count; ++i) {
      blocked[static_cast<std::size_t>(i)] = rays.tfar[i] < 0.0F;  // Embree sets -inf
    }
    return blocked;
  }

 private:
  RTCDevice device_ = nullptr;
  RTCScene scene_ = nullptr;
  std::vector<Grid> grids_;
};

RayCaster::RayCaster(const Scene& scene)
    : implementation_(std::make_unique<Implementation>(scene)) {}
RayCaster::~RayCaster() = default;
void RayCaster::trace(RayPacket& packet) const {
  implementation_->trace(packet);
}
std::array<bool, kPacketSize> RayCaster::isBlocked(const RayPacket& packet) const {
  return implementation_->isBlocked(packet);
}

}  // namespace mivo
