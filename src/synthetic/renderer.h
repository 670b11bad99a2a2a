// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <functional>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "mivo/core/camera.h"
#include "synthetic/light_map.h"
#include "synthetic/ray_caster.h"
#include "synthetic/scene.h"
#include "synthetic/scene_lighting.h"

namespace mivo {

/// When the pixels of an image see the scene. Row y is exposed for `exposure` seconds around
/// mid_time + ((y + 0.5) / height - 0.5) * readout: the stamp of a frame is the middle of it.
struct Shutter {
  double mid_time = 0.0;  ///< s
  double exposure = 0.0;  ///< s; 0: no motion blur
  double readout = 0.0;   ///< s from the first to the last row; 0: global shutter
  int samples = 1;        ///< rays per pixel, spread over its area and over the exposure

  double rowTime(int row, int height) const {
    return mid_time + ((row + 0.5) / height - 0.5) * readout;
  }
};

using PoseAtTime = std::function<Eigen::Isometry3d(double)>;  ///< T_world_camera, optical frame
using LightAtTime = std::function<LightState(double)>;

/// Data of a pixel for the depth sensor.
struct SurfaceImage {
  cv::Mat depth;  ///< CV_32FC1, meters along the optical axis; 0: nothing there
  cv::Mat
      cosine;  ///< CV_32FC1, of the angle between ray and surface normal; 0: infrared is absorbed
};

/// Draws a scene. Const functions give the same image for any number of threads.
class Renderer {
 public:
  Renderer(Scene scene, const Camera& camera, std::uint64_t seed);

  const Scene& scene() const { return scene_; }
  const Camera& camera() const { return camera_; }

  /// Light that reaches each pixel: CV_32FC3 (blue, green, red), in lux times reflectance, mean
  /// over the shutter's samples.
  cv::Mat renderColor(const PoseAtTime& pose, const LightAtTime& light,
                      const Shutter& shutter) const;

  /// The surfaces in the middle of the exposure, one ray per pixel. Pixel p sees what lies at
  /// p + offset of an exactly registered depth image.
  SurfaceImage renderSurface(const PoseAtTime& pose, const LightAtTime& light,
                             const Shutter& shutter, const Eigen::Vector2f& offset) const;

  /// Direct and reflected light on a surface at `point` with outward `normal`, lux, where nothing
  /// stands in between.
  float illuminanceAt(const Eigen::Vector3f& point, const Eigen::Vector3f& normal,
                      const LightState& light) const;

 private:
  // A patch with all that shading asks for.
  struct Surface {
    const Texture* texture;
    Eigen::Vector3f normal;  // of a flat patch
    bool flat;
    bool stretched;
    Eigen::Vector2f size;
    Eigen::Vector2f texture_origin;
    float texels_per_meter;
    float specular;
    int gloss_doublings;
    int luminous_lamp;
    bool absorbs_infrared;
    bool evenly_lit;
  };
  struct View;
  struct Hit;

  void prepareSurfaces();
  void prepareRays();
  Eigen::Vector3f direction(float x, int y, const Eigen::Vector2f& offset) const;
  View makeView(const PoseAtTime& pose, const LightAtTime& light, double time) const;
  void traceBlock(const View& view, int x0, int y, const Eigen::Vector2f& offset,
                  RayPacket& packet) const;
  void renderRow(const View& view, int y, const Eigen::Vector2f& offset, std::uint64_t noise_seed,
                 cv::Vec3f* row) const;
  Eigen::Array3f shade(const View& view, const Hit& hit, float moving_visibility) const;
  Eigen::Array4f reflectance(const Surface& surface, const Hit& hit, float cosine) const;
  std::array<float, kPacketSize> movingVisibility(const View& view, const RayPacket& packet,
                                                  std::uint64_t noise_seed) const;

  Scene scene_;
  Camera camera_;
  RayCaster caster_;
  LightMap light_map_;
  std::vector<Surface> surfaces_;
  std::array<float, kNumLamps> intensity_per_lux_{};  // candela for 1 lux at the reference point
  cv::Mat rays_;                                      // CV_32FC2: x/z, y/z of each pixel's center
};

}  // namespace mivo
