// SPDX-License-Identifier: BSD-3-Clause
#include "core/nearest_name.h"

#include <gtest/gtest.h>

namespace mivo {
namespace {

TEST(DidYouMeanTest, ANearNameIsProposed) {
  const std::vector<std::string> known = {"levels", "lost_frames", "mi_bins"};
  EXPECT_EQ(didYouMean("levles", known), "; did you mean 'levels'?");
  EXPECT_EQ(didYouMean("level", known), "; did you mean 'levels'?");
  EXPECT_EQ(didYouMean("lostframes", known), "; did you mean 'lost_frames'?");
  EXPECT_EQ(didYouMean("mi_bin", known, "<", ">"), "; did you mean <mi_bins>?");
}

TEST(DidYouMeanTest, AFarOneIsNot) {
  const std::vector<std::string> known = {"levels", "lost_frames", "mi_bins"};
  for (const char* name : {"no_such_parameter", "x", "", "frames_of_loss", "bins"}) {
    EXPECT_EQ(didYouMean(name, known), "") << name;
  }
  EXPECT_EQ(didYouMean("levels", {}), "");
}

}  // namespace
}  // namespace mivo
