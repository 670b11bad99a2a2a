// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "mivo/core/error.h"

/// Expects that the expression throws mivo::Error with `part` in its text.
#define EXPECT_ERROR(expression, part)                                                    \
  do {                                                                                    \
    try {                                                                                 \
      static_cast<void>(expression);                                                      \
      ADD_FAILURE() << "no error: " #expression;                                          \
    } catch (const mivo::Error& error) {                                                  \
      EXPECT_NE(std::string::npos, std::string(error.what()).find(part)) << error.what(); \
    }                                                                                     \
  } while (false)
