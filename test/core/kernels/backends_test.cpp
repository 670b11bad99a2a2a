// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "core/kernels/kernels.h"
#include "support/error_text.h"

namespace mivo {
namespace {

TEST(BackendsTest, TheFastestIsUsedUnlessAnotherIsChosen) {
  const std::vector<kernels::Backend> all = kernels::backends();
  ASSERT_FALSE(all.empty());
  EXPECT_EQ(all.front().name, "scalar");
  EXPECT_EQ(kernels::activeName(), all.back().name);
  for (const kernels::Backend& backend : all) {
    kernels::select(backend.name);
    EXPECT_EQ(&kernels::active(), backend.kernels);
    EXPECT_EQ(kernels::activeName(), backend.name);
  }
  kernels::select("auto");
  EXPECT_EQ(kernels::activeName(), all.back().name);
}

TEST(BackendsTest, AnUnknownOneIsRefusedWithTheNamesThereAre) {
  const std::string text = errorText([] { kernels::select("abacus"); });
  EXPECT_NE(text.find("abacus"), std::string::npos);
  EXPECT_NE(text.find("auto, scalar"), std::string::npos);
}

}  // namespace
}  // namespace mivo
