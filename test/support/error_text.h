// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "mivo/core/error.h"

namespace mivo {

/// What the Error thrown by `action` says; "nothing thrown" when none was.
template <typename Action>
std::string errorText(const Action& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return "nothing thrown";
}

}  // namespace mivo
