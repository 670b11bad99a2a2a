// SPDX-License-Identifier: BSD-3-Clause
#include "synthetic/renderer.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <utility>

#include "mivo/core/error.h"
#include "synthetic/pixel_noise.h"
#include "synthetic/scene_builder.h"

namespace mivo {
namespace {

constexpr float kBounceShare = 0.35F;   // of a lamp's light at the reference point comes from walls
constexpr float kMovingBounce = 0.10F;  // the same of the moving lamp, of its lux at 1 m
constexpr float kBulbRadius = 0.045F;   // m
constexpr int kMovingShadowRays = 4;
constexpr float kFootprint = 0.75F;  // of a pixel's extent: what one sample averages over

// Where the k-th of several samples lies within the pixel: a sequence that covers the area evenly
// for any number of samples and does not follow the order of their times.
std::vector<Eigen::Vector2f> sampleOffsets(int count) {
  std::vector<Eigen::Vector2f> offsets;
  Eigen::Vector2f mean = Eigen::Vector2f::Zero();
  for (int k = 0; k < count; ++k) {
    const double x = 0.7548776662466927 * k;
    const double y = 0.5698402909980532 * k;
    offsets.emplace_back(static_cast<float>(x - std::floor(x)),
                         static_cast<float>(y - std::floor(y)));
    mean += offsets.back() / static_cast<float>(count);
  }
  for (Eigen::Vector2f& offset : offsets) {
    offset -= mean;
  }
  return offsets;
}

double sampleTime(const Shutter& shutter, int sample) {
  return ((sample + 0.5) / shutter.samples - 0.5) * shutter.exposure;
}

float raised(float base, int doublings) {
  for (int k = 0; k < doublings; ++k) {
    base *= base;
  }
  return base;
}

}  // namespace

struct Renderer::View {
  Eigen::Matrix3f R_world_camera;
  Eigen::Vector3f origin;
  Eigen::Array4f lamp_x, lamp_y, lamp_z;  // of the four lamps
  Eigen::Array4f intensity;               // candela
  float bounce;                           // lux
  float even;                             // lux on what is lit evenly
  float moving_lux;
  Eigen::Vector3f moving;

  // t of the moving lamp's bulb along a ray, or infinity.
  float bulbDistance(const Eigen::Vector3f& ray) const {
    if (moving_lux <= 0.0F) {
      return std::numeric_limits<float>::infinity();
    }
    const Eigen::Vector3f to_center = moving - origin;
    const float a = ray.squaredNorm();
    const float b = to_center.dot(ray);
    const float c = to_center.squaredNorm() - kBulbRadius * kBulbRadius;
    const float discriminant = b * b - a * c;
    return discriminant > 0.0F && b > 0.0F ? (b - std::sqrt(discriminant)) / a
                                           : std::numeric_limits<float>::infinity();
  }
};

struct Renderer::Hit {
  int patch;
  float u;
  float v;
  float depth;
  Eigen::Vector3f ray;  // in the world, 1 m along the optical axis
};

Renderer::Renderer(Scene scene, const Camera& camera, std::uint64_t seed)
    : scene_(std::move(scene)),
      camera_(camera),
      caster_(scene_),
      light_map_(scene_, caster_, seed) {
  camera_.validate();
  prepareSurfaces();
  prepareRays();
  for (int k = 0; k < kNumLamps; ++k) {
    const Eigen::Vector3f to_lamp =
        scene_.lamps[static_cast<std::size_t>(k)].center - scene_.reference_point;
    const float d2 = to_lamp.squaredNorm();
    intensity_per_lux_[static_cast<std::size_t>(k)] =
        (1.0F - kBounceShare) * d2 * d2 / (to_lamp.z() * to_lamp.z());
  }
}

void Renderer::prepareSurfaces() {
  for (const Patch& patch : scene_.patches) {
    const Material& material = scene_.materials[static_cast<std::size_t>(patch.material)];
    const Texture& texture = scene_.textures[static_cast<std::size_t>(material.texture)];
    Surface surface{};
    surface.texture = &texture;
    surface.flat = patch.shape == Shape::kParallelogram;
    surface.normal = patch.normal(0.5F, 0.5F);
    surface.stretched = material.stretched;
    surface.size = patch.size();
    surface.texture_origin = patch.texture_origin;
    // Of a stretched picture: the geometric mean of both directions.
    surface.texels_per_meter =
        material.stretched ? std::sqrt(static_cast<float>(texture.width()) / surface.size.x() *
                                       static_cast<float>(texture.height()) / surface.size.y())
                           : 1.0F / texture.metersPerTexel();
    surface.specular = material.specular;
    surface.gloss_doublings = material.gloss_doublings;
    surface.luminous_lamp = material.luminous_lamp;
    surface.absorbs_infrared = material.absorbs_infrared;
    surface.evenly_lit = material.evenly_lit;
    surfaces_.push_back(surface);
  }
}

void Renderer::prepareRays() {
  rays_.create(camera_.height, camera_.width, CV_32FC2);
  const LensRange range = camera_.lensRange();
  for (int y = 0; y < camera_.height; ++y) {
    for (int x = 0; x < camera_.width; ++x) {
      const std::optional<Eigen::Vector3d> ray = camera_.ray(Eigen::Vector2d(x, y), range);
      if (!ray) {
        throw Error("camera: the distortion folds back inside of the image, at the pixel " +
                    std::to_string(x) + ", " + std::to_string(y) +
                    ": nothing can be rendered there; take a lens that covers the image");
      }
      rays_.at<cv::Vec2f>(y, x) =
          cv::Vec2f(static_cast<float>(ray->x()), static_cast<float>(ray->y()));
    }
  }
}

// Between pixel centers the ray is interpolated linearly: exact without distortion, and good to
// 1e-5 pixels with any lens that is still a camera's.
Eigen::Vector3f Renderer::direction(float x, int y, const Eigen::Vector2f& offset) const {
  const int x0 = std::clamp(static_cast<int>(x), 1, camera_.width - 2);
  const int y0 = std::clamp(y, 1, camera_.height - 2);
  const auto* row = rays_.ptr<cv::Vec2f>(y0);
  const cv::Vec2f along_x = 0.5F * (row[x0 + 1] - row[x0 - 1]);
  const cv::Vec2f along_y =
      0.5F * (rays_.ptr<cv::Vec2f>(y0 + 1)[x0] - rays_.ptr<cv::Vec2f>(y0 - 1)[x0]);
  const cv::Vec2f ray = row[x0] + (x + offset.x() - static_cast<float>(x0)) * along_x +
                        (static_cast<float>(y - y0) + offset.y()) * along_y;
  return {ray[0], ray[1], 1.0F};
}

Renderer::View Renderer::makeView(const PoseAtTime& pose, const LightAtTime& light,
                                  double time) const {
  const Eigen::Isometry3d T_world_camera = pose(time);
  const LightState state = light(time);
  View view;
  view.R_world_camera = T_world_camera.linear().cast<float>();
  view.origin = T_world_camera.translation().cast<float>();
  view.bounce = state.ambient_lux + kMovingBounce * state.moving_lux;
  for (int k = 0; k < kNumLamps; ++k) {
    const auto i = static_cast<std::size_t>(k);
    view.lamp_x[k] = scene_.lamps[i].center.x();
    view.lamp_y[k] = scene_.lamps[i].center.y();
    view.lamp_z[k] = scene_.lamps[i].center.z();
    view.intensity[k] = intensity_per_lux_[i] * state.lamp_lux[i];
    view.bounce += kBounceShare * state.lamp_lux[i];
  }
  view.even = state.total();
  view.moving_lux = state.moving_lux;
  view.moving = state.moving_position;
  return view;
}

void Renderer::traceBlock(const View& view, int x0, int y, const Eigen::Vector2f& offset,
                          RayPacket& packet) const {
  packet.count = std::min(kPacketSize, camera_.width - x0);
  for (int i = 0; i < packet.count; ++i) {
    packet.setOrigin(i, view.origin);
    packet.setDirection(i, view.R_world_camera * direction(static_cast<float>(x0 + i), y, offset));
  }
  caster_.trace(packet);
}

Eigen::Array4f Renderer::reflectance(const Surface& surface, const Hit& hit, float cosine) const {
  const Texture& texture = *surface.texture;
  // A pixel's extent on the surface grows with 1 / cosine in one direction only.
  const float footprint = kFootprint * hit.depth / static_cast<float>(camera_.fx) *
                          surface.texels_per_meter / std::sqrt(std::max(cosine, 0.05F));
  if (surface.stretched) {
    const auto width = static_cast<float>(texture.width());
    const auto height = static_cast<float>(texture.height());
    return texture.sample(std::clamp(hit.u * width - 0.5F, 0.0F, width - 1.0F),
                          std::clamp(hit.v * height - 0.5F, 0.0F, height - 1.0F), footprint);
  }
  const Eigen::Vector2f meters(hit.u * surface.size.x() + surface.texture_origin.x(),
                               hit.v * surface.size.y() + surface.texture_origin.y());
  return texture.sample(meters.x() * surface.texels_per_meter,
                        meters.y() * surface.texels_per_meter, footprint);
}

Eigen::Array3f Renderer::shade(const View& view, const Hit& hit, float moving_visibility) const {
  const Surface& surface = surfaces_[static_cast<std::size_t>(hit.patch)];
  const Patch& patch = scene_.patches[static_cast<std::size_t>(hit.patch)];
  const Eigen::Vector3f normal = surface.flat ? surface.normal : patch.normal(hit.u, hit.v);
  const Eigen::Vector3f point = view.origin + hit.depth * hit.ray;
  const Eigen::Vector3f to_viewer = -hit.ray.normalized();
  const float cosine = std::abs(normal.dot(to_viewer));
  if (surface.luminous_lamp >= 0) {
    const Lamp& lamp = scene_.lamps[static_cast<std::size_t>(surface.luminous_lamp)];
    const float area = 4.0F * lamp.half_x * lamp.half_y;
    return Eigen::Array3f::Constant(kPi * view.intensity[surface.luminous_lamp] / area);
  }
  const Eigen::Array4f texel = reflectance(surface, hit, cosine);
  if (surface.evenly_lit) {
    return texel.head<3>() * view.even;
  }
  const LightMap::Node node = light_map_.at(hit.patch, hit.u, hit.v);

  // Towards the four lamps: luminaires and surfaces both follow the cosine, so no root is needed.
  const Eigen::Array4f x = view.lamp_x - point.x();
  const Eigen::Array4f y = view.lamp_y - point.y();
  const Eigen::Array4f z = view.lamp_z - point.z();
  const Eigen::Array4f d2 = x * x + y * y + z * z;
  const Eigen::Array4f slope = (normal.x() * x + normal.y() * y + normal.z() * z).max(0.0F);
  const Eigen::Array4f direct = view.intensity * node.visibility * slope * z.max(0.0F) / (d2 * d2);
  float lux = direct.sum() + view.bounce * node.openness[0];
  float highlight = 0.0F;
  const float gloss = surface.specular * texel[3];
  const auto glint = [&](const Eigen::Vector3f& to_lamp_unit) {
    const float aligned = std::max(normal.dot((to_lamp_unit + to_viewer).normalized()), 0.0F);
    const float exponent = static_cast<float>(1 << surface.gloss_doublings);
    return (exponent + 8.0F) / 8.0F * raised(aligned, surface.gloss_doublings);
  };
  if (gloss > 0.0F) {
    for (int k = 0; k < kNumLamps; ++k) {
      if (direct[k] > 0.0F) {
        highlight += direct[k] * glint(Eigen::Vector3f(x[k], y[k], z[k]) / std::sqrt(d2[k]));
      }
    }
  }
  if (view.moving_lux > 0.0F && moving_visibility > 0.0F) {
    const Eigen::Vector3f to_lamp = view.moving - point;
    // Not nearer than the bulb's surface, where the point-shaped lamp would be infinitely bright.
    const float distance = std::max(to_lamp.norm(), kBulbRadius);
    const float moving = moving_visibility * view.moving_lux * std::max(normal.dot(to_lamp), 0.0F) /
                         (distance * distance * distance);
    lux += moving;
    if (gloss > 0.0F) {
      highlight += moving * glint(to_lamp / distance);
    }
  }
  return texel.head<3>() * (lux * node.openness[1]) + gloss * highlight;
}

std::array<float, kPacketSize> Renderer::movingVisibility(const View& view, const RayPacket& packet,
                                                          std::uint64_t noise_seed) const {
  RayPacket shadow;
  shadow.count = packet.count;
  std::array<float, kPacketSize> visibility{};
  for (int ray = 0; ray < kMovingShadowRays; ++ray) {
    for (int i = 0; i < packet.count; ++i) {
      const auto k = static_cast<std::size_t>(i);
      const float distance = packet.patch[k] >= 0 ? packet.distance[k] : 0.0F;
      const Eigen::Vector3f point =
          view.origin +
          distance * (1.0F - 1e-4F) *
              Eigen::Vector3f(packet.direction_x[k], packet.direction_y[k], packet.direction_z[k]);
      const std::uint64_t bits = hashOf(noise_seed, static_cast<std::uint64_t>(ray), k);
      const Eigen::Vector3f jitter(gaussianFrom(bits), gaussianFrom(bits >> 16),
                                   gaussianFrom(bits >> 32));
      shadow.setOrigin(i, point);
      shadow.setDirection(i, view.moving + 0.5F * kBulbRadius * jitter - point);
    }
    const auto blocked = caster_.isBlocked(shadow);
    for (std::size_t k = 0; k < kPacketSize; ++k) {
      visibility[k] += blocked[k] ? 0.0F : 1.0F / kMovingShadowRays;
    }
  }
  return visibility;
}

void Renderer::renderRow(const View& view, int y, const Eigen::Vector2f& offset,
                         std::uint64_t noise_seed, cv::Vec3f* row) const {
  RayPacket packet;
  std::array<float, kPacketSize> visibility{};
  for (int x0 = 0; x0 < camera_.width; x0 += kPacketSize) {
    traceBlock(view, x0, y, offset, packet);
    if (view.moving_lux > 0.0F) {
      visibility =
          movingVisibility(view, packet, hashOf(noise_seed, static_cast<std::uint64_t>(x0)));
    }
    for (int i = 0; i < packet.count; ++i) {
      const auto k = static_cast<std::size_t>(i);
      const Eigen::Vector3f ray(packet.direction_x[k], packet.direction_y[k],
                                packet.direction_z[k]);
      const float bulb = view.bulbDistance(ray);
      Eigen::Array3f value = Eigen::Array3f::Zero();
      if (packet.patch[k] < 0 || bulb < packet.distance[k]) {
        if (bulb < std::numeric_limits<float>::infinity()) {
          value.setConstant(view.moving_lux / (kBulbRadius * kBulbRadius));
        }
      } else {
        value = shade(view, {packet.patch[k], packet.u[k], packet.v[k], packet.distance[k], ray},
                      visibility[k]);
      }
      row[x0 + i] += cv::Vec3f(value[0], value[1], value[2]);
    }
  }
}

cv::Mat Renderer::renderColor(const PoseAtTime& pose, const LightAtTime& light,
                              const Shutter& shutter) const {
  const std::vector<Eigen::Vector2f> offsets = sampleOffsets(shutter.samples);
  std::vector<View> views;
  if (shutter.readout == 0.0) {
    for (int s = 0; s < shutter.samples; ++s) {
      views.push_back(makeView(pose, light, shutter.mid_time + sampleTime(shutter, s)));
    }
  }
  const auto frame_bits = static_cast<std::uint64_t>(std::llround(shutter.mid_time * 1e6));
  cv::Mat image(camera_.height, camera_.width, CV_32FC3);
  cv::parallel_for_(cv::Range(0, camera_.height), [&](const cv::Range& range) {
    for (int y = range.start; y < range.end; ++y) {
      auto* row = image.ptr<cv::Vec3f>(y);
      std::fill(row, row + camera_.width, cv::Vec3f(0.0F, 0.0F, 0.0F));
      for (int s = 0; s < shutter.samples; ++s) {
        const auto k = static_cast<std::size_t>(s);
        const std::uint64_t noise_seed = hashOf(frame_bits, static_cast<std::uint64_t>(y), k);
        if (shutter.readout == 0.0) {
          renderRow(views[k], y, offsets[k], noise_seed, row);
        } else {
          const double time = shutter.rowTime(y, camera_.height) + sampleTime(shutter, s);
          renderRow(makeView(pose, light, time), y, offsets[k], noise_seed, row);
        }
      }
      for (int x = 0; x < camera_.width; ++x) {
        row[x] *= 1.0F / static_cast<float>(shutter.samples);
      }
    }
  });
  return image;
}

SurfaceImage Renderer::renderSurface(const PoseAtTime& pose, const LightAtTime& light,
                                     const Shutter& shutter, const Eigen::Vector2f& offset) const {
  SurfaceImage image{cv::Mat(camera_.height, camera_.width, CV_32FC1),
                     cv::Mat(camera_.height, camera_.width, CV_32FC1)};
  const View global = makeView(pose, light, shutter.mid_time);
  cv::parallel_for_(cv::Range(0, camera_.height), [&](const cv::Range& range) {
    RayPacket packet;
    for (int y = range.start; y < range.end; ++y) {
      const View view = shutter.readout == 0.0
                            ? global
                            : makeView(pose, light, shutter.rowTime(y, camera_.height));
      auto* depth = image.depth.ptr<float>(y);
      auto* cosine = image.cosine.ptr<float>(y);
      for (int x0 = 0; x0 < camera_.width; x0 += kPacketSize) {
        traceBlock(view, x0, y, offset, packet);
        for (int i = 0; i < packet.count; ++i) {
          const auto k = static_cast<std::size_t>(i);
          const Eigen::Vector3f ray(packet.direction_x[k], packet.direction_y[k],
                                    packet.direction_z[k]);
          const float bulb = view.bulbDistance(ray);
          depth[x0 + i] = 0.0F;
          cosine[x0 + i] = 0.0F;
          if (packet.patch[k] >= 0 && packet.distance[k] < bulb) {
            const Surface& surface = surfaces_[static_cast<std::size_t>(packet.patch[k])];
            const Eigen::Vector3f normal =
                surface.flat ? surface.normal
                             : scene_.patches[static_cast<std::size_t>(packet.patch[k])].normal(
                                   packet.u[k], packet.v[k]);
            depth[x0 + i] = packet.distance[k];
            cosine[x0 + i] = surface.absorbs_infrared || surface.luminous_lamp >= 0
                                 ? 0.0F
                                 : std::abs(normal.dot(ray)) / ray.norm();
          } else if (std::isfinite(bulb)) {
            depth[x0 + i] = bulb;  // it shines in the infrared too: no reading, cosine 0
          }
        }
      }
    }
  });
  return image;
}

float Renderer::illuminanceAt(const Eigen::Vector3f& point, const Eigen::Vector3f& normal,
                              const LightState& light) const {
  float lux = light.ambient_lux + kMovingBounce * light.moving_lux;
  for (std::size_t k = 0; k < kNumLamps; ++k) {
    const Eigen::Vector3f to_lamp = scene_.lamps[k].center - point;
    const float d2 = to_lamp.squaredNorm();
    const float intensity = intensity_per_lux_[k] * light.lamp_lux[k];
    lux += kBounceShare * light.lamp_lux[k] + intensity * std::max(normal.dot(to_lamp), 0.0F) *
                                                  std::max(to_lamp.z(), 0.0F) / (d2 * d2);
  }
  if (light.moving_lux > 0.0F) {
    const Eigen::Vector3f to_lamp = light.moving_position - point;
    const float distance = to_lamp.norm();
    lux +=
        light.moving_lux * std::max(normal.dot(to_lamp), 0.0F) / (distance * distance * distance);
  }
  return lux;
}

}  // namespace mivo
