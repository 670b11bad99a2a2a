// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/kernels/kernels.h"

namespace mivo {
namespace kernels {

/// The vector kernels that this processor supports, the fastest last. Empty if mivo was built
/// without them.
std::vector<Backend> vectorBackends();

}  // namespace kernels
}  // namespace mivo
