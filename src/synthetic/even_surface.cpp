// SPDX-License-Identifier: BSD-3-Clause
#include "synthetic/even_surface.h"

#include <utility>

#include "mivo/core/error.h"
#include "synthetic/pixel_noise.h"

namespace mivo {

int evenMaterial(SceneBuilder& builder, Texture texture) {
  Material properties;
  properties.clean = true;
  properties.evenly_lit = true;
  return builder.material(std::move(texture), properties);
}

int evenPaint(SceneBuilder& builder) {
  return evenMaterial(builder, plainTexture({0.5F, 0.54F, 0.56F}));
}

Scene withTexture(Scene scene, std::uint64_t seed) {
  bool any = false;
  for (const Material& material : scene.materials) {
    if (!material.evenly_lit || material.stretched) continue;
    scene.textures[static_cast<std::size_t>(material.texture)] =
        plasterTexture({0.5F, 0.54F, 0.56F}, 0.3, seed);
    any = true;
  }
  if (!any) {
    throw Error("scene '" + scene.name + "' has no surface that could show another texture");
  }
  return scene;
}

void hideLamps(Scene& scene) {
  constexpr float kAway = -100.0F;  // m, behind the camera
  for (Lamp& lamp : scene.lamps) lamp.center = {kAway, 0.0F, 3.0F};
  scene.reference_point = {kAway, 0.0F, 0.0F};
  scene.moving_lamp_center = {kAway, 0.0F, 1.0F};
}

double rollOfSeed(std::uint64_t seed) {
  switch (seed % 3) {
    case 0:
      return 0.0;
    case 1:
      return 0.5 * kPi;
    default:
      return kPi * uniformFrom(hashOf(seed, 0x8011));
  }
}

}  // namespace mivo
