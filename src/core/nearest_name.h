// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace mivo {

/// "; did you mean 'levels'?" for a name that nobody knows, when a known one is near: a third of
/// its letters inserted, left out or replaced at most. Otherwise an empty text.
/// @param before  what is put before the name that is proposed, and behind it
std::string didYouMean(const std::string& name, const std::vector<std::string>& known,
                       const std::string& before = "'", const std::string& after = "'");

}  // namespace mivo
