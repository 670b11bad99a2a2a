// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <memory>
#include <string>

#include "synthetic/scene.h"

namespace mivo {

/// The scene of this name with seed 1. Its textures take most of a second: each is made once.
inline const Scene& sharedScene(const std::string& name) {
  static std::map<std::string, std::unique_ptr<Scene>> scenes;
  std::unique_ptr<Scene>& scene = scenes[name];
  if (!scene) scene = std::make_unique<Scene>(makeScene(name, 1));
  return *scene;
}

}  // namespace mivo
