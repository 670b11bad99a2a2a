// SPDX-License-Identifier: BSD-3-Clause
// main() of the test programs: tells ctest when tests were skipped. GoogleTest itself passes then.
#include <gtest/gtest.h>

namespace {

constexpr int kSkipped = 77;  // SKIP_RETURN_CODE in mivo_compiler.cmake

}  // namespace

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  const int result = RUN_ALL_TESTS();
  if (result != 0) return result;  // a failure takes precedence over skipped tests
  return testing::UnitTest::GetInstance()->skipped_test_count() > 0 ? kSkipped : 0;
}
