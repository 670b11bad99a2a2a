// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace mivo {

/// Makes a damaged recording playable: rosbag plays sound bags only. When one of the bags is cut
/// off or damaged, the messages that are whole are copied into a new bag. Returns what is damaged,
/// as Recording::damage() has it; empty: nothing is, and nothing was written. Throws Error when
/// nothing can be read, or the copy cannot be written.
std::string copyWhenDamaged(const std::vector<std::string>& bags, const std::string& copy);

}  // namespace mivo
