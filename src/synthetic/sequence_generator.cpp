// SPDX-License-Identifier: BSD-3-Clause
#include "synthetic/sequence_generator.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "mivo/core/error.h"
#include "mivo/core/se3.h"
#include "synthetic/pixel_noise.h"

namespace mivo {
namespace {

constexpr double kFirstStamp = 1.0;  // s; 0 would look like a stamp that was never set
// Signal that one lux times reflectance gives in one second, in units of saturation. In 61 lux, an
// exposure of 10 ms at gain 1 then gives an indoor image of ordinary brightness.
constexpr double kSensitivity = 2.2;
constexpr double kMostLensBlur = 20.0;  // pixels
constexpr int kMostSamples = 48;
constexpr double kFastestPace = 20.0;
constexpr double kMostDepthTime = 0.1;  // s, between color and depth, as the odometry allows
constexpr double kNearDepth = 1.0;      // m, at which the extent of motion blur is estimated

// Which of the many random numbers of a sequence.
enum Stream : std::uint64_t { kLightMap = 1, kPath, kColor, kRight, kDepth, kTexture };

const GeneratorOptions& checked(const GeneratorOptions& options) {
  const SensorOptions& sensor = options.sensor;
  if (options.frames < 1 || !(options.rate > 0.0) || !std::isfinite(options.rate)) {
    throw Error("generator: the number of frames and the rate must be positive");
  }
  if (options.blind_from < 0 || options.blind_frames < 0) {
    throw Error("generator: the blind frames must not be negative");
  }
  if (!(options.pace > 0.0 && options.pace <= kFastestPace)) {
    throw Error("generator: the pace must be above 0 and at most 20");
  }
  if (options.camera.width < 16 || options.camera.height < 16) {
    throw Error("generator: the images must be at least 16 x 16 pixels");
  }
  if (!(sensor.exposure_time > 0.0) || sensor.exposure_time > 1.0 / options.rate ||
      !(sensor.gain >= 0.0) || sensor.samples < 1 || sensor.samples > kMostSamples ||
      !(sensor.readout >= 0.0) || sensor.readout > 1.0 / options.rate ||
      !(sensor.stereo_baseline >= 0.0) || !(sensor.lens_blur >= 0.0) ||
      sensor.lens_blur > kMostLensBlur || !(std::abs(sensor.depth_time_offset) <= kMostDepthTime)) {
    throw Error(
        "generator: exposure and read-out time must be within a frame's period, samples within "
        "1..48, gain and stereo baseline not negative, lens blur within 0..20 pixels, the time "
        "offset "
        "of depth within 0.1 s");
  }
  return options;
}

}  // namespace

Camera xtionCamera(int width, int height) {
  Camera camera;
  camera.width = width;
  camera.height = height;
  const double scale = width / 640.0;
  camera.fx = camera.fy = 525.0 * scale;
  camera.cx = 0.5 * (width - 1);
  camera.cy = 0.5 * (height - 1);
  return camera;
}

void SensorOptions::makeIdeal() {
  imager.noise = false;
  motion_blur = false;
  depth.noise = 0.0;
  depth.disparity_step = 0.0;
  depth.holes = false;
}

SequenceGenerator::SequenceGenerator(const GeneratorOptions& options)
    : options_(checked(options)),
      renderer_(makeScene(options.scene, options.seed), options.camera,
                hashOf(options.seed, kLightMap)),
      path_(options.trajectory, renderer_.scene().viewpoint, hashOf(options.seed, kPath),
            options.pace),
      lighting_(options.lighting, {options.frames, 1.0 / options.rate}, renderer_.scene()),
      imager_(options.sensor.imager),
      depth_sensor_(options.sensor.depth, options.camera),
      exposure_control_(options.sensor.exposure_control, {options.sensor.exposure_time, 1.0}) {
  if (options_.blind_frames > 0) {
    textured_ =
        std::make_unique<Renderer>(withTexture(renderer_.scene(), hashOf(options_.seed, kTexture)),
                                   options_.camera, hashOf(options_.seed, kLightMap));
  }
  exposure_control_ = ExposureControl(options_.sensor.exposure_control, firstSetting());
}

const Renderer& SequenceGenerator::rendererOf(int frame) const {
  const bool blind =
      frame >= options_.blind_from && frame - options_.blind_from < options_.blind_frames;
  return textured_ && !blind ? *textured_ : renderer_;
}

// A look at the first view, as a camera that has been on for a while would have had.
ExposureSetting SequenceGenerator::firstSetting() const {
  ExposureSetting setting{options_.sensor.exposure_time, 1.0};
  if (options_.sensor.gain > 0.0) {
    setting.gain = options_.sensor.gain;
    return setting;
  }
  Shutter shutter;
  const cv::Mat light =
      renderer_.renderColor([this](double t) { return path_.poseAt(t); },
                            [this](double t) { return lighting_.at(t); }, shutter);
  // Clipped pixels make the mean too small; a few rounds settle that.
  Imager noiseless([this] {
    ImagerOptions options = options_.sensor.imager;
    options.noise = false;
    return options;
  }());
  for (int round = 0; round < 6; ++round) {
    const cv::Mat image =
        noiseless.expose(light, kSensitivity * setting.product(), setting.gain, 0);
    const double wanted =
        exposure_control_.wantedProduct(setting.product(), meanGray(image), noiseless);
    if (options_.sensor.exposure_control.automatic) {
      setting = exposure_control_.split(wanted);
    } else {
      setting.gain = wanted / setting.time;
    }
  }
  return setting;
}

Shutter SequenceGenerator::shutterAt(double t, const ExposureSetting& setting) const {
  const SensorOptions& sensor = options_.sensor;
  Shutter shutter;
  shutter.mid_time = t;
  shutter.readout = sensor.readout;
  shutter.samples = sensor.samples;
  if (sensor.motion_blur) {
    shutter.exposure = setting.time;
    // One sample per pixel of motion at least, or the blur would be a row of sharp images.
    const Vector6 motion = localCoordinates(path_.poseAt(t - 0.5 * setting.time).inverse() *
                                            path_.poseAt(t + 0.5 * setting.time));
    const double pixels =
        options_.camera.fx * (motion.head<3>().norm() / kNearDepth + motion.tail<3>().norm());
    shutter.samples = std::clamp(static_cast<int>(std::ceil(pixels)), sensor.samples, kMostSamples);
  }
  return shutter;
}

cv::Mat SequenceGenerator::film(const Renderer& renderer, const PoseAtTime& pose,
                                const Shutter& shutter, const ExposureSetting& setting,
                                std::uint64_t seed) const {
  cv::Mat light = renderer.renderColor(
      pose, [this](double t) { return lighting_.at(t); }, shutter);
  const double blur = options_.sensor.lens_blur;
  if (blur > 0.0) cv::GaussianBlur(light, light, cv::Size(), blur, blur, cv::BORDER_REPLICATE);
  return imager_.expose(light, kSensitivity * setting.product(), setting.gain, seed);
}

SyntheticFrame SequenceGenerator::next() {
  const double t = next_ / options_.rate;
  const auto index = static_cast<std::uint64_t>(next_);
  SyntheticFrame frame;
  frame.stamp = kFirstStamp + t;
  frame.T_world_camera = path_.poseAt(t);
  frame.exposure = exposure_control_.current();
  frame.lux = lighting_.at(t).total();
  const Shutter shutter = shutterAt(t, frame.exposure);
  const PoseAtTime pose = [this](double time) { return path_.poseAt(time); };
  const Renderer& renderer = rendererOf(next_);
  frame.color = film(renderer, pose, shutter, frame.exposure, hashOf(options_.seed, kColor, index));
  if (options_.sensor.stereo_baseline > 0.0) {
    const Eigen::Translation3d right(options_.sensor.stereo_baseline, 0.0, 0.0);
    frame.right = film(
        renderer, [&](double time) { return Eigen::Isometry3d(path_.poseAt(time) * right); },
        shutter, frame.exposure, hashOf(options_.seed, kRight, index));
  }
  Shutter depth_shutter = shutter;
  depth_shutter.mid_time += options_.sensor.depth_time_offset;
  const SurfaceImage surface = renderer.renderSurface(
      pose, [this](double time) { return lighting_.at(time); }, depth_shutter,
      options_.sensor.depth_offset.cast<float>());
  frame.exact_depth = surface.depth;
  frame.depth = depth_sensor_.sense(surface, hashOf(options_.seed, kDepth, index));
  exposure_control_.advance(meanGray(frame.color), imager_);
  ++next_;
  return frame;
}

}  // namespace mivo
