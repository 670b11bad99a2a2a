// SPDX-License-Identifier: BSD-3-Clause
#include <atomic>

#include "core/kernels/scalar.h"
#include "core/kernels/vector.h"
#include "mivo/core/error.h"

namespace mivo {
namespace kernels {
namespace {

std::atomic<const Kernels*>& chosen() {
  static std::atomic<const Kernels*> kernels{backends().back().kernels};
  return kernels;
}

}  // namespace

const Kernels& scalar() {
  static const Kernels kernels = {
      reference::warpPoints,
      reference::sampleIntensity,
      reference::sampleNormalized,
      reference::residuals,
      reference::robustCost,
      reference::robustWeights,
      reference::accumulateLeastSquares,
      reference::accumulateScores,
      reference::sumPairs,
      reference::geometricResiduals,
      reference::binPositions,
      reference::jointHistogram,
      reference::logarithms,
      reference::miDerivatives,
      reference::reduce,
      reference::smooth,
      reference::contrastMap,
      reference::normalizeImage,
      reference::gradientRow,
      reference::maximaRow,
      reference::depthRow,
      reference::reduceDepthRow,
      reference::keepSmooth,
      reference::keyframePoints,
  };
  return kernels;
}

std::vector<Backend> backends() {
  std::vector<Backend> all = {{"scalar", &scalar()}};
  for (const Backend& backend : vectorBackends()) all.push_back(backend);
  return all;
}

const Kernels& active() {
  return *chosen().load(std::memory_order_relaxed);
}

std::string activeName() {
  for (const Backend& backend : backends()) {
    if (backend.kernels == &active()) return backend.name;
  }
  return "unknown";
}

void select(const std::string& name) {
  std::string names = "auto";
  for (const Backend& backend : backends()) {
    names += ", " + backend.name;
    if (backend.name == name) {
      chosen() = backend.kernels;
      return;
    }
  }
  if (name != "auto") throw Error("kernels \"" + name + "\": this processor has " + names);
  chosen() = backends().back().kernels;
}

}  // namespace kernels
}  // namespace mivo
