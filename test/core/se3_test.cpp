// SPDX-License-Identifier: BSD-3-Clause
#include "mivo/core/se3.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/numeric_derivative.h"
#include "support/random_pose.h"

namespace mivo {
namespace {

using testing::Random;

constexpr double kPi = 3.14159265358979323846;

// Awkward lengths: zero, around the switch to the series, and up to half a turn.
const double kAngles[] = {0.0,  1e-12, 1e-9, 1e-6,       0.99e-4,    1.01e-4,
                          1e-3, 0.3,   2.0,  kPi - 1e-4, kPi - 1e-9, kPi};

double distanceFromOrthonormal(const Eigen::Matrix3d& R) {
  return (R.transpose() * R - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
}

/// exp(W) as its power series: slow and plain.
template <int N>
Eigen::Matrix<double, N, N> exponentialSeries(const Eigen::Matrix<double, N, N>& W) {
  Eigen::Matrix<double, N, N> sum = Eigen::Matrix<double, N, N>::Identity();
  Eigen::Matrix<double, N, N> power = sum;
  for (int i = 1; i < 40; ++i) {
    power = power * W / i;
    sum += power;
  }
  return sum;
}

TEST(Se3Test, SkewIsTheCrossProduct) {
  const Eigen::Vector3d a(1.0, -2.0, 0.5);
  const Eigen::Vector3d b(0.3, 0.7, -1.1);
  EXPECT_EQ(skew(a) * b, a.cross(b));
}

TEST(Se3Test, RotationIsTheExponentialOfItsVector) {
  Random random(1);
  for (const double angle : kAngles) {
    const Eigen::Vector3d w = angle * random.direction();
    EXPECT_LT((expSo3(w) - exponentialSeries<3>(skew(w))).cwiseAbs().maxCoeff(), 1e-14) << angle;
    EXPECT_LT(distanceFromOrthonormal(expSo3(w)), 1e-15) << angle;
  }
}

TEST(Se3Test, LogarithmUndoesTheExponential) {
  Random random(2);
  for (const double angle : kAngles) {
    for (int i = 0; i < 20; ++i) {
      const Eigen::Vector3d w = angle * random.direction();
      const Eigen::Vector3d back = logSo3(expSo3(w));
      EXPECT_LE(back.norm(), kPi + 1e-12);
      // At half a turn w and -w are the same rotation.
      const double error =
          std::min((back - w).norm(), angle > kPi - 1e-6 ? (back + w).norm() : 9.0);
      EXPECT_LT(error, 1e-14 + 2e-15 * angle + (angle > 3.0 ? 1e-8 : 0.0)) << angle;
    }
  }
}

TEST(Se3Test, LogarithmIsAtMostHalfATurn) {
  const Eigen::Vector3d axis = Eigen::Vector3d(1.0, 2.0, -1.0).normalized();
  EXPECT_LT((logSo3(expSo3((kPi + 0.5) * axis)) + (kPi - 0.5) * axis).norm(), 1e-12);
  EXPECT_LT((logSo3(expSo3(2.0 * kPi * axis))).norm(), 1e-12);
}

TEST(Se3Test, RetractMovesAPointByItsDefinition) {
  Random random(3);
  const Vector6 d = random.increment(0.4, 0.8);
  const Eigen::Vector3d X(0.3, -0.6, 2.0);
  EXPECT_LT((retract(d) * X - (expSo3(d.tail<3>()) * X + d.head<3>())).norm(), 1e-15);
  EXPECT_LT((localCoordinates(retract(d)) - d).norm(), 1e-14);
}

TEST(Se3Test, TheScrewIsTheExponentialOfItsTwist) {
  Random random(4);
  for (const double angle : kAngles) {
    if (angle > 3.0) continue;  // the series needs more terms there
    const Vector6 twist = random.increment(0.7, angle);
    Eigen::Matrix4d generator = Eigen::Matrix4d::Zero();
    generator.topLeftCorner<3, 3>() = skew(twist.tail<3>());
    generator.topRightCorner<3, 1>() = twist.head<3>();
    EXPECT_LT((expSe3(twist).matrix() - exponentialSeries<4>(generator)).cwiseAbs().maxCoeff(),
              1e-11)
        << angle;
  }
}

TEST(Se3Test, TwistUndoesTheScrew) {
  Random random(5);
  for (const double angle : kAngles) {
    if (angle > kPi - 1e-6) continue;  // there the axis has two signs
    const Vector6 twist = random.increment(0.7, angle);
    EXPECT_LT((logSe3(expSe3(twist)) - twist).norm(), 1e-10) << angle;
  }
}

TEST(Se3Test, ScrewAndRetractAgreeToFirstOrder) {
  Random random(6);
  const Vector6 d = random.increment(1.0, 1.0);
  const auto difference = [&](double length) {
    return (expSe3(length * d).matrix() - retract(length * d).matrix()).norm();
  };
  EXPECT_LT(difference(1e-3), 1e-6);
  EXPECT_NEAR(difference(1e-3) / difference(5e-4), 4.0, 0.05);  // and differ in the second
}

TEST(Se3Test, AdjointMovesATwistToAnotherFrame) {
  Random random(7);
  const Eigen::Isometry3d T_a_b = random.pose(1.5, 2.0);
  const Vector6 twist_b = random.increment(0.5, 0.7);
  const Eigen::Isometry3d moved = T_a_b * expSe3(twist_b) * T_a_b.inverse();
  EXPECT_LT((logSe3(moved) - adjoint(T_a_b) * twist_b).norm(), 1e-12);
}

TEST(Se3Test, AdjointsMultiplyAsTheirMotions) {
  Random random(8);
  const Eigen::Isometry3d a = random.pose(1.0, 1.0);
  const Eigen::Isometry3d b = random.pose(2.0, 3.0);
  EXPECT_LT((adjoint(a * b) - adjoint(a) * adjoint(b)).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_LT((adjoint(a.inverse()) * adjoint(a) - Matrix6::Identity()).cwiseAbs().maxCoeff(), 1e-12);
}

// The motion model forms T_k T_(k-1)^-1 T_k with each frame. With the transpose as the inverse,
// rounding errors grow threefold each time; renormalized, they do not grow.
TEST(Se3Test, OrthonormalizedMotionsDoNotDecay) {
  Random random(9);
  const auto largestError = [&](bool renormalize) {
    Eigen::Isometry3d before = Eigen::Isometry3d::Identity();
    Eigen::Isometry3d now = Eigen::Isometry3d::Identity();
    now.linear() = expSo3({0.01, 0.02, -0.03});
    for (int frame = 0; frame < 60; ++frame) {
      Eigen::Isometry3d next = now * before.inverse() * now;
      if (renormalize) next = orthonormalized(next);
      before = now;
      now = next;
    }
    return distanceFromOrthonormal(now.linear());
  };
  EXPECT_LT(largestError(true), 1e-14);
  EXPECT_GT(largestError(false), 1e-3);
}

TEST(Se3Test, OrthonormalizingChangesAGoodMotionByRoundingOnly) {
  Random random(10);
  for (const double angle : {0.0, 1.0, kPi}) {
    const Eigen::Isometry3d T = random.pose(3.0, angle);
    EXPECT_LT((orthonormalized(T).matrix() - T.matrix()).cwiseAbs().maxCoeff(), 1e-14);
  }
}

}  // namespace
}  // namespace mivo
