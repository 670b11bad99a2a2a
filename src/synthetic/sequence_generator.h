// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <string>

#include "mivo/core/camera.h"
#include "synthetic/camera_path.h"
#include "synthetic/depth_sensor.h"
#include "synthetic/exposure_control.h"
#include "synthetic/imager.h"
#include "synthetic/renderer.h"
#include "synthetic/scene_lighting.h"

namespace mivo {

/// Camera of an Xtion at 640 x 480, scaled to a width and height.
Camera xtionCamera(int width = 640, int height = 480);

struct SensorOptions {
  ImagerOptions imager;
  ExposureControlOptions exposure_control;
  double exposure_time = 0.010;  ///< s, of the first frame, and of all without automatic exposure
  double gain = 0.0;             ///< 0: metered once, so that the first frame's mean is the target
  bool motion_blur = true;
  double lens_blur = 0.0;  ///< standard deviation of the lens' point image, pixels; 0: none
  int samples = 4;         ///< rays per pixel at least; more where motion would leave gaps
  double readout = 0.0;    ///< s, rolling shutter; 0: global
  DepthSensorOptions depth;
  Eigen::Vector2d depth_offset =
      Eigen::Vector2d::Zero();     ///< pixels, faulty registration (Renderer::renderSurface)
  double depth_time_offset = 0.0;  ///< s, by which a row of depth is read later than that of color
  double stereo_baseline = 0.0;    ///< m to the right camera; 0: there is none

  /// Switches noise, motion blur, quantization and holes off. The blur of the lens stays.
  void makeIdeal();
};

struct GeneratorOptions {
  std::string scene = "room";
  std::string trajectory = "figure_of_eight";
  std::string lighting = "constant";
  int frames = 150;
  double rate = 30.0;  ///< frames per second
  double pace = 1.0;   ///< how fast the path is traveled, 1: as camera_path.h says
  std::uint64_t seed = 1;
  /// Before and after these frames a scene of one surface is textured: the view goes blind at once.
  /// None: it is as it is in all of them.
  int blind_from = 0;
  int blind_frames = 0;
  Camera camera = xtionCamera();
  SensorOptions sensor;
};

struct SyntheticFrame {
  double stamp = 0.0;  ///< s, middle of the exposure of the middle row
  Eigen::Isometry3d T_world_camera = Eigen::Isometry3d::Identity();  ///< at that time, exact
  cv::Mat color;                                                     ///< CV_8UC3, blue, green, red
  cv::Mat right;        ///< of the right camera, empty without one
  cv::Mat depth;        ///< CV_16UC1 in the depth sensor's units
  cv::Mat exact_depth;  ///< CV_32FC1, meters, without noise and holes
  ExposureSetting exposure;
  double lux = 0.0;  ///< of the ceiling lamps and the ambient light at the scene's reference point
};

/// Films a scene: frame after frame, each with its exact pose.
class SequenceGenerator {
 public:
  /// Throws Error for an unknown name or an option out of range.
  explicit SequenceGenerator(const GeneratorOptions& options);

  const GeneratorOptions& options() const { return options_; }
  const Renderer& renderer() const { return renderer_; }
  const CameraPath& path() const { return path_; }

  bool atEnd() const { return next_ >= options_.frames; }
  SyntheticFrame next();

 private:
  const Renderer& rendererOf(int frame) const;
  Shutter shutterAt(double t, const ExposureSetting& setting) const;
  ExposureSetting firstSetting() const;
  cv::Mat film(const Renderer& renderer, const PoseAtTime& pose, const Shutter& shutter,
               const ExposureSetting& setting, std::uint64_t seed) const;

  GeneratorOptions options_;
  Renderer renderer_;
  std::unique_ptr<Renderer> textured_;  // for the frames that are not blind, if some are
  CameraPath path_;
  SceneLighting lighting_;
  Imager imager_;
  DepthSensor depth_sensor_;
  ExposureControl exposure_control_;
  int next_ = 0;
};

}  // namespace mivo
