// SPDX-License-Identifier: BSD-3-Clause
#include "support/numeric_derivative.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/analytic_image.h"

namespace mivo::testing {
namespace {

Eigen::Vector2d curved(const Eigen::Vector3d& x) {
  return {std::sin(x[0]) * x[1] + x[2] * x[2] * x[2], std::exp(0.5 * x[0] - x[2])};
}

Eigen::Matrix<double, 2, 3> curvedJacobian(const Eigen::Vector3d& x) {
  const double e = std::exp(0.5 * x[0] - x[2]);
  Eigen::Matrix<double, 2, 3> J;
  J << std::cos(x[0]) * x[1], std::sin(x[0]), 3.0 * x[2] * x[2], 0.5 * e, 0.0, -e;
  return J;
}

class NumericDerivativeTest : public ::testing::Test {
 protected:
  const Eigen::Vector3d x_{0.4, -1.3, 0.7};
  static constexpr double kStep = 1e-2;
  static constexpr double kFloor = 1e-9;
  Eigen::Matrix<double, 2, 3> numeric(double step) const {
    return numericJacobian<2, 3>(curved, x_, step);
  }
};

TEST_F(NumericDerivativeTest, TheRightJacobianPasses) {
  EXPECT_TRUE(convergesTo(
      curvedJacobian(x_), [&](double step) { return numeric(step); }, kStep, kFloor));
}

TEST_F(NumericDerivativeTest, EveryWrongEntryIsCaught) {
  for (int row = 0; row < 2; ++row) {
    for (int column = 0; column < 3; ++column) {
      Eigen::Matrix<double, 2, 3> wrong = curvedJacobian(x_);
      wrong(row, column) += 0.001;
      EXPECT_FALSE(convergesTo(
          wrong, [&](double step) { return numeric(step); }, kStep, kFloor))
          << row << ' ' << column;
    }
  }
  EXPECT_FALSE(convergesTo(
      Eigen::Matrix<double, 2, 3>(-curvedJacobian(x_)), [&](double step) { return numeric(step); },
      kStep, kFloor));
}

TEST_F(NumericDerivativeTest, TheHessianOfAPolynomialIsExact) {
  const auto polynomial = [](const Eigen::Vector2d& p) {
    return 3.0 * p.x() * p.x() - 2.0 * p.x() * p.y() + 0.5 * p.y() * p.y() + p.x();
  };
  Eigen::Matrix2d expected;
  expected << 6.0, -2.0, -2.0, 1.0;
  const Eigen::Matrix2d hessian = numericHessian<2>(polynomial, Eigen::Vector2d(1.0, 2.0), 1e-3);
  EXPECT_LT(relativeError(hessian, expected), 1e-8);
}

TEST(AnalyticImageTest, DerivativesAreThoseOfTheValue) {
  const Eigen::Vector2d place(31.7, 24.2);
  for (const AnalyticImage& image : {waves(), blobs(), negativeOfWaves(), rampImage(3.0, {2, 1})}) {
    const auto value = [&](const Eigen::Vector2d& p) { return image(p).value; };
    const auto gradient = [&](const Eigen::Vector2d& p) { return image(p).gradient; };
    EXPECT_TRUE(convergesTo(
        image(place).gradient, [&](double step) { return numericGradient<2>(value, place, step); },
        0.5, 1e-9));
    const Eigen::Matrix2d hessian = numericJacobian<2, 2>(gradient, place, 1e-4);
    EXPECT_LT((hessian - image(place).hessian).cwiseAbs().maxCoeff(), 1e-6);
  }
}

}  // namespace
}  // namespace mivo::testing
