// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stdexcept>

namespace mivo {

/// Thrown at startup and by input and output: one line that says what is wrong, where, and what to
/// do. Tracking a frame never throws; TrackingResult has the reason instead.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace mivo
