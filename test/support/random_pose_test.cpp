// SPDX-License-Identifier: BSD-3-Clause
#include "support/random_pose.h"

#include <gtest/gtest.h>

namespace mivo::testing {
namespace {

TEST(RandomTest, NumbersAreTheSameWithEveryCompiler) {
  Random random(1);
  const Vector6 increment = random.increment(1.0, 1.0);
  const Vector6 expected = (Vector6() << 0.161586222847, -0.984536256539, -0.067662782591,
                            0.128885868657, -0.941878224534, 0.310248034658)
                               .finished();
  EXPECT_LT((increment - expected).norm(), 1e-9) << increment.transpose();
  EXPECT_NEAR(random.uniform(2.0, 3.0), 2.789651969506, 1e-9);
  EXPECT_NEAR(random.normal(), -1.149182653937, 1e-9);
}

TEST(RandomTest, IncrementsHaveTheLengthsAskedFor) {
  const Vector6 increment = Random(2).increment(0.3, 0.2);
  EXPECT_NEAR(increment.head<3>().norm(), 0.3, 1e-12);
  EXPECT_NEAR(increment.tail<3>().norm(), 0.2, 1e-12);
}

}  // namespace
}  // namespace mivo::testing
