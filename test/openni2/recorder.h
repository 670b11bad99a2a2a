// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>

namespace mivo {

/// Records color and registered depth of the virtual camera without loss, until so many images of
/// both together have come. `on_start` is called once both streams run. Throws std::runtime_error.
/// The streams are stopped before the recorder, which can lock up otherwise; even so the caller
/// should have a watchdog.
void recordVirtualXtion(const std::string& path, int images, const std::function<void()>& on_start);

}  // namespace mivo
