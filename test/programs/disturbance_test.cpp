// SPDX-License-Identifier: BSD-3-Clause
#include "programs/disturbance.h"

#include <gtest/gtest.h>

#include <cmath>

#include "mivo/core/se3.h"

namespace mivo {
namespace {

TEST(DisturbanceTest, HasTheNormsAskedFor) {
  Disturbance disturbance(0.3, 0.2, 1);
  for (int i = 0; i < 100; ++i) {
    const Vector6 d = localCoordinates(disturbance.next());
    EXPECT_NEAR(d.head<3>().norm(), 0.3, 1e-12);
    EXPECT_NEAR(d.tail<3>().norm(), 0.2, 1e-12);
  }
}

TEST(DisturbanceTest, SeedDecides) {
  Disturbance a(1.0, 1.0, 5);
  Disturbance b(1.0, 1.0, 5);
  Disturbance c(1.0, 1.0, 6);
  for (int i = 0; i < 10; ++i) {
    const Eigen::Matrix4d first = a.next().matrix();
    EXPECT_EQ(first, b.next().matrix());
    EXPECT_NE(first, c.next().matrix());
  }
}

TEST(DisturbanceTest, SequenceIsTheSameOnEveryPlatform) {
  // The standard fixes the 10000th draw of a default-seeded mt19937_64: 9981545732273789042. Each
  // displacement takes four draws; the last of number 2500 is the longitude of the rotation.
  Disturbance disturbance(1.0, 1.0, 5489);
  Eigen::Isometry3d last;
  for (int i = 0; i < 2500; ++i) last = disturbance.next();
  const Eigen::Vector3d w = localCoordinates(last).tail<3>();
  const double longitude = 2.0 * M_PI * std::ldexp(double(9981545732273789042ULL >> 11), -53);
  EXPECT_NEAR(std::remainder(std::atan2(w.y(), w.x()) - longitude, 2.0 * M_PI), 0.0, 1e-9);
}

TEST(DisturbanceTest, DirectionsAreUniform) {
  constexpr int kCount = 4000;
  Disturbance disturbance(1.0, 1.0, 3);
  Eigen::Matrix3d second_moment = Eigen::Matrix3d::Zero();
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (int i = 0; i < kCount; ++i) {
    const Eigen::Vector3d v = localCoordinates(disturbance.next()).head<3>();
    second_moment += v * v.transpose() / kCount;
    mean += v / kCount;
  }
  // Standard deviations: 1 / sqrt(3 n) of a mean, at most sqrt(4 / 45 / n) of a moment.
  const double five_sigma = 5.0 / std::sqrt(3.0 * kCount);
  EXPECT_LT(mean.cwiseAbs().maxCoeff(), five_sigma);
  EXPECT_LT((second_moment - Eigen::Matrix3d::Identity() / 3.0).cwiseAbs().maxCoeff(), five_sigma);
}

}  // namespace
}  // namespace mivo
