// SPDX-License-Identifier: BSD-3-Clause
#include "core/alignment/newton_step.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <algorithm>
#include <limits>

#include "support/random_pose.h"

namespace mivo {
namespace {

using testing::Random;

constexpr double kMinCurvature = 1e-3;

Vector6 randomVector(Random& random) {
  Vector6 v;
  for (int i = 0; i < 6; ++i) v[i] = random.uniform(-1.0, 1.0);
  return v;
}

/// Symmetric, with the given eigenvalues in random directions.
Matrix6 symmetric(const Vector6& eigenvalues, Random& random) {
  Matrix6 any;
  for (int i = 0; i < 6; ++i) any.col(i) = randomVector(random);
  const Matrix6 Q = Eigen::HouseholderQR<Matrix6>(any).householderQ();
  return Q * eigenvalues.asDiagonal() * Q.transpose();
}

TEST(NewtonStepTest, ADefiniteModelIsSolvedExactly) {
  Random random(1);
  Vector6 curvature;
  curvature << 1.0, 2.0, 3.0, 5.0, 8.0, 13.0;
  const QuadraticModel model{0.0, randomVector(random), symmetric(curvature, random)};
  const NewtonStep result = newtonStep(model, 1.0, kMinCurvature);
  EXPECT_LT((model.hessian * result.step + model.gradient).norm(), 1e-12);
  EXPECT_NEAR(result.promised_gain, -model.gradient.dot(result.step), 1e-15);
  EXPECT_GT(result.promised_gain, 0.0);
  EXPECT_LT((result.guarded_hessian - model.hessian).norm(), 1e-12);
}

TEST(NewtonStepTest, AnIndefiniteModelStillGivesADescent) {
  Random random(2);
  for (int trial = 0; trial < 50; ++trial) {
    Vector6 curvature;
    for (int i = 0; i < 6; ++i) curvature[i] = random.uniform(-10.0, 10.0);
    const QuadraticModel model{0.0, randomVector(random), symmetric(curvature, random)};
    const NewtonStep result = newtonStep(model, 2.0, kMinCurvature);
    EXPECT_GT(result.promised_gain, 0.0);
    EXPECT_LT(model.gradient.dot(result.step), 0.0);
    const Eigen::SelfAdjointEigenSolver<Matrix6> solver(result.guarded_hessian);
    EXPECT_GT(solver.eigenvalues().minCoeff(), 0.0);
  }
}

TEST(NewtonStepTest, CurvaturesAreReplacedByTheirMagnitudeOrTheBound) {
  Random random(3);
  Vector6 curvature;
  curvature << -4.0, 10.0, 1e-5, -1e-7, 2.0, 0.0;
  Vector6 expected;
  expected << 4.0, 10.0, 0.01, 0.01, 2.0, 0.01;
  std::sort(expected.data(), expected.data() + 6);
  const QuadraticModel model{0.0, randomVector(random), symmetric(curvature, random)};
  const NewtonStep result = newtonStep(model, 1.0, kMinCurvature);
  const Eigen::SelfAdjointEigenSolver<Matrix6> solver(result.guarded_hessian);
  EXPECT_LT((solver.eigenvalues() - expected).norm(), 1e-12);
}

TEST(NewtonStepTest, TheStepDoesNotDependOnTheUnitOfTheCost) {
  Random random(4);
  Vector6 curvature;
  curvature << -4.0, 10.0, 1e-5, -1e-7, 2.0, 5.0;
  const QuadraticModel model{0.0, randomVector(random), symmetric(curvature, random)};
  const QuadraticModel larger{0.0, 1e5 * model.gradient, 1e5 * model.hessian};
  const Vector6 step = newtonStep(model, 1.5, kMinCurvature).step;
  EXPECT_LT((newtonStep(larger, 1.5, kMinCurvature).step - step).norm(), 1e-10 * step.norm());
}

// The same scene twice as large: translations and the median depth double, rotations stay.
TEST(NewtonStepTest, TheGuardDoesNotDependOnTheUnitOfLength) {
  Random random(5);
  Vector6 curvature;
  curvature << -4.0, 10.0, 1e-5, -1e-7, 2.0, 5.0;
  const QuadraticModel model{0.0, randomVector(random), symmetric(curvature, random)};
  Vector6 per_length;
  per_length << 0.5, 0.5, 0.5, 1.0, 1.0, 1.0;
  const QuadraticModel large{0.0, per_length.asDiagonal() * model.gradient,
                             per_length.asDiagonal() * model.hessian * per_length.asDiagonal()};
  const NewtonStep a = newtonStep(model, 1.5, kMinCurvature);
  const NewtonStep b = newtonStep(large, 3.0, kMinCurvature);
  EXPECT_LT((per_length.asDiagonal() * b.step - a.step).norm(), 1e-10 * a.step.norm());
  EXPECT_NEAR(a.promised_gain, b.promised_gain, 1e-10 * a.promised_gain);
}

TEST(NewtonStepTest, NothingToGoByGivesNoStep) {
  QuadraticModel flat;
  EXPECT_EQ(newtonStep(flat, 1.0, kMinCurvature).step, Vector6::Zero());
  EXPECT_EQ(newtonStep(flat, 1.0, kMinCurvature).promised_gain, 0.0);
  QuadraticModel broken{0.0, Vector6::Ones(), Matrix6::Identity()};
  broken.hessian(2, 3) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(newtonStep(broken, 1.0, kMinCurvature).step, Vector6::Zero());
  QuadraticModel infinite{0.0, Vector6::Ones(), Matrix6::Identity()};
  infinite.gradient[4] = std::numeric_limits<double>::infinity();
  EXPECT_EQ(newtonStep(infinite, 1.0, kMinCurvature).step, Vector6::Zero());
}

}  // namespace
}  // namespace mivo
