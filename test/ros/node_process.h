// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sys/types.h>

#include <string>

namespace mivo {

/// Process of a node that runs on this machine. Throws std::runtime_error.
pid_t processOf(const std::string& node);

}  // namespace mivo
