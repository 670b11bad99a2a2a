// SPDX-License-Identifier: BSD-3-Clause
#include "core/kernels/vector.h"

// In place of vector.cpp where mivo is built without Highway.

namespace mivo {
namespace kernels {

std::vector<Backend> vectorBackends() {
  return {};
}

}  // namespace kernels
}  // namespace mivo
