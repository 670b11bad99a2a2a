// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stdexcept>

namespace mivo {

/// Thrown at start-up and by input and output: one line that says what is wrong, where, and what to
/// do. Nothing is thrown while a frame is tracked; there TrackingResult carries the reason.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace mivo
