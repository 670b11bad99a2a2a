// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace mivo {

/// A frame or a topic without the slash that old recordings and some writers of bags begin it with,
/// and others do not: it means the same. tf2 accepts frames without one only.
inline std::string withoutSlash(const std::string& name) {
  return !name.empty() && name.front() == '/' ? name.substr(1) : name;
}

}  // namespace mivo
