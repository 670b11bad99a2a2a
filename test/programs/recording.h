// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "programs/program_fixture.h"

namespace mivo {

/// Runs the programs on real recordings. Skipped without MIVO_DATA.
class RecordingTest : public ProgramTest {
 protected:
  void SetUp() override {
    const char* data = std::getenv("MIVO_DATA");
    if (data == nullptr || *data == '\0') {
      GTEST_SKIP() << "no recordings: set MIVO_DATA to the folder that holds them "
                      "(tum_fr1_rpy_first240, sun3d_xtion_fragA)";
    }
    data_ = data;
  }

  /// Folder of a recording. Fails if MIVO_DATA is set and lacks it.
  std::string recording(const std::string& name) const {
    const std::string path = data_ + "/" + name;
    EXPECT_TRUE(std::filesystem::is_directory(path)) << path << " is not in MIVO_DATA";
    return path;
  }

 private:
  std::string data_;
};

}  // namespace mivo
