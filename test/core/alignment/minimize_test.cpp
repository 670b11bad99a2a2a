// SPDX-License-Identifier: BSD-3-Clause
#include "core/alignment/minimize.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <limits>

#include "support/random_pose.h"

namespace mivo {
namespace {

/// A cost in closed form, f(|t - goal|) + g(angle about z), that records its evaluations.
/// Increments warp the keyframe: T retract(v, w)^-1 changes the translation by -v if w is zero.
class ToyTerm : public CostTerm {
 public:
  double evaluate(const Eigen::Isometry3d& T_live_ref) override {
    T_ = T_live_ref;
    costs_.push_back(cost());
    poses_.push_back(T_live_ref);
    return cost();
  }

  QuadraticModel linearize(int iteration) override {
    iterations_.push_back(iteration);
    linearized_.push_back(T_);
    return model();
  }

  virtual double cost() const = 0;
  virtual QuadraticModel model() const = 0;

  Eigen::Isometry3d T_ = Eigen::Isometry3d::Identity();
  std::vector<double> costs_;
  std::vector<Eigen::Isometry3d> poses_;
  std::vector<Eigen::Isometry3d> linearized_;
  std::vector<int> iterations_;
};

/// 1 + (t - goal)ᵀ A (t - goal) / 2 + turn angle² / 2; exact as long as there is no rotation.
class TranslationTerm : public ToyTerm {
 public:
  TranslationTerm(const Eigen::Matrix3d& A, const Eigen::Vector3d& goal) : A_(A), goal_(goal) {}
  double cost() const override {
    const Eigen::Vector3d e = T_.translation() - goal_;
    return 1.0 + 0.5 * e.dot(A_ * e) + 0.5 * logSo3(T_.linear()).squaredNorm();
  }
  QuadraticModel model() const override {
    QuadraticModel model;
    model.cost = cost();
    model.gradient.head<3>() = -A_ * (T_.translation() - goal_);
    model.gradient.tail<3>() = -logSo3(T_.linear());
    model.hessian.topLeftCorner<3, 3>() = A_;
    model.hessian.bottomRightCorner<3, 3>().setIdentity();
    return model;
  }

 private:
  Eigen::Matrix3d A_;
  Eigen::Vector3d goal_;
};

/// Depends on x only: f(x) with given first and second derivatives.
class LineTerm : public ToyTerm {
 public:
  using Function = double (*)(double);
  LineTerm(Function f, Function df, Function d2f) : f_(f), df_(df), d2f_(d2f) {}
  double cost() const override { return f_(T_.translation().x()); }
  QuadraticModel model() const override {
    QuadraticModel model;
    model.cost = cost();
    model.hessian = 1e-6 * Matrix6::Identity();
    model.gradient[0] = -df_(T_.translation().x());
    model.hessian(0, 0) = d2f_(T_.translation().x());
    return model;
  }

 private:
  Function f_;
  Function df_;
  Function d2f_;
};

Eigen::Isometry3d at(double x) {
  return Eigen::Isometry3d(Eigen::Translation3d(x, 0.0, 0.0));
}

/// One meter moves the points by 100 pixels, and so does one radian.
const Matrix6 kPixelMotion = 1e4 * Matrix6::Identity();

Parameters freeParameters() {
  Parameters parameters;
  parameters.alignment.max_step_pixels = 100.0;
  parameters.alignment.min_step_pixels = 1e-4;
  parameters.alignment.min_cost_change = 0.0;
  parameters.alignment.max_iterations = 50;
  return parameters;
}

TEST(MinimizeTest, AQuadraticCostIsSolvedInOneStep) {
  Eigen::Matrix3d A;
  A << 4.0, 1.0, 0.5, 1.0, 3.0, 0.2, 0.5, 0.2, 2.0;
  const Eigen::Vector3d goal(0.3, -0.2, 0.1);
  TranslationTerm term(A, goal);
  Parameters parameters = freeParameters();
  parameters.alignment.min_cost_change = 1e-12;
  const Minimum minimum = minimize({&term}, at(0.0), 1.0, kPixelMotion, parameters);
  EXPECT_LT((minimum.T_live_ref.translation() - goal).norm(), 1e-12);
  EXPECT_EQ(minimum.iterations, 1);
  EXPECT_NEAR(minimum.cost, 1.0, 1e-12);
  EXPECT_LT((minimum.hessian.topLeftCorner<3, 3>() - A).norm(), 1e-12);
}

TEST(MinimizeTest, TermsAreAddedUp) {
  TranslationTerm a(2.0 * Eigen::Matrix3d::Identity(), {0.3, 0.0, 0.0});
  TranslationTerm b(1.0 * Eigen::Matrix3d::Identity(), {0.0, 0.3, 0.0});
  const Minimum minimum = minimize({&a, &b}, at(0.0), 1.0, kPixelMotion, freeParameters());
  EXPECT_LT((minimum.T_live_ref.translation() - Eigen::Vector3d(0.2, 0.1, 0.0)).norm(), 1e-12);
  EXPECT_NEAR(minimum.cost, a.cost() + b.cost(), 1e-15);
}

TEST(MinimizeTest, RotationsAreSolvedToo) {
  TranslationTerm term(Eigen::Matrix3d::Identity(), Eigen::Vector3d::Zero());
  const Eigen::Isometry3d start = retract((Vector6() << 0, 0, 0, 0.1, -0.2, 0.15).finished());
  const Minimum minimum = minimize({&term}, start, 1.0, kPixelMotion, freeParameters());
  EXPECT_LT((minimum.T_live_ref.matrix() - Eigen::Matrix4d::Identity()).norm(), 1e-9);
}

TEST(MinimizeTest, TheTermsAreLeftAtThePoseThatIsReturned) {
  Parameters parameters = freeParameters();
  LineTerm wells([](double x) { return std::cos(8.0 * x); },
                 [](double x) { return -8.0 * std::sin(8.0 * x); },
                 [](double x) { return -64.0 * std::cos(8.0 * x); });
  for (const int max_iterations : {1, 2, 3, 10}) {
    parameters.alignment.max_iterations = max_iterations;
    const Minimum minimum = minimize({&wells}, at(0.1), 1.0, kPixelMotion, parameters);
    EXPECT_EQ(wells.T_.matrix(), minimum.T_live_ref.matrix());
    EXPECT_EQ(minimum.cost, wells.cost());
    EXPECT_LE(minimum.iterations, max_iterations);
  }
}

// Starts near a maximum, where the curvature is negative: the guard makes it positive.
TEST(MinimizeTest, TheCostNeverRisesAndTheStepLeavesAMaximum) {
  LineTerm wells([](double x) { return 2.0 + std::cos(8.0 * x); },
                 [](double x) { return -8.0 * std::sin(8.0 * x); },
                 [](double x) { return -64.0 * std::cos(8.0 * x); });
  const Minimum minimum = minimize({&wells}, at(0.05), 1.0, kPixelMotion, freeParameters());
  EXPECT_NEAR(minimum.cost, 1.0, 1e-9);
  double before = std::numeric_limits<double>::infinity();
  for (const Eigen::Isometry3d& T : wells.linearized_) {
    const double cost = 2.0 + std::cos(8.0 * T.translation().x());
    EXPECT_LT(cost, before);
    before = cost;
  }
  EXPECT_EQ(static_cast<int>(wells.costs_.size()), minimum.evaluations);
  for (std::size_t i = 0; i < wells.iterations_.size(); ++i) {
    EXPECT_EQ(wells.iterations_[i], static_cast<int>(i));
  }
}

// sqrt(1 + x^2) from far out: a full Newton step goes to -x^3, further away.
TEST(MinimizeTest, AStepThatOvershootsIsHalved) {
  LineTerm valley([](double x) { return std::sqrt(1.0 + x * x); },
                  [](double x) { return x / std::sqrt(1.0 + x * x); },
                  [](double x) { return std::pow(1.0 + x * x, -1.5); });
  Parameters parameters = freeParameters();
  const Matrix6 small_motion = Matrix6::Identity();
  parameters.alignment.min_step_pixels = 1e-4;
  const Minimum minimum = minimize({&valley}, at(2.0), 1.0, small_motion, parameters);
  EXPECT_NEAR(minimum.T_live_ref.translation().x(), 0.0, 1e-3);
  EXPECT_GT(minimum.evaluations, minimum.iterations + 1);
}

TEST(MinimizeTest, ATermThatNeverImprovesStopsAtOnceWhereItStarted) {
  // Its derivatives predict a descent that does not exist.
  LineTerm liar([](double x) { return 5.0 + std::abs(x - 0.2); }, [](double) { return 1.0; },
                [](double) { return 100.0; });
  Parameters parameters = freeParameters();
  parameters.alignment.line_search_halvings = 6;
  const Minimum minimum = minimize({&liar}, at(0.2), 1.0, kPixelMotion, parameters);
  EXPECT_EQ(minimum.T_live_ref.translation().x(), 0.2);
  EXPECT_EQ(minimum.cost, 5.0);
  EXPECT_EQ(minimum.iterations, 0);
  EXPECT_EQ(liar.linearized_.size(), 1U);
  EXPECT_LE(liar.costs_.size(), 1U + 7U + 1U);
}

TEST(MinimizeTest, NoStepIsLongerThanTheLimit) {
  TranslationTerm term(Eigen::Matrix3d::Identity(), {1.0, 0.0, 0.0});
  Parameters parameters = freeParameters();
  parameters.alignment.max_step_pixels = 5.0;  // 5 cm
  const Minimum minimum = minimize({&term}, at(0.0), 1.0, kPixelMotion, parameters);
  ASSERT_GT(term.linearized_.size(), 10U);
  for (std::size_t i = 1; i < term.linearized_.size(); ++i) {
    const double step =
        (term.linearized_[i].translation() - term.linearized_[i - 1].translation()).norm();
    EXPECT_LE(step, 0.05 * (1.0 + 1e-9));
  }
  EXPECT_NEAR(minimum.T_live_ref.translation().x(), 1.0, 1e-6);
}

TEST(MinimizeTest, SmallStepsAndSmallGainsEndIt) {
  LineTerm quartic([](double x) { return 1.0 + std::pow(x, 4); },
                   [](double x) { return 4.0 * std::pow(x, 3); },
                   [](double x) { return 12.0 * x * x; });
  Parameters precise = freeParameters();
  Parameters coarse_step = precise;
  coarse_step.alignment.min_step_pixels = 1.0;
  Parameters coarse_gain = precise;
  coarse_gain.alignment.min_cost_change = 0.01;
  const Minimum far = minimize({&quartic}, at(0.5), 1.0, kPixelMotion, precise);
  const Minimum by_step = minimize({&quartic}, at(0.5), 1.0, kPixelMotion, coarse_step);
  const Minimum by_gain = minimize({&quartic}, at(0.5), 1.0, kPixelMotion, coarse_gain);
  EXPECT_LT(by_step.iterations, far.iterations);
  EXPECT_LT(by_gain.iterations, far.iterations);
  EXPECT_GT(by_step.iterations, 1);
  // The tolerance scales both.
  Parameters both = precise;
  both.alignment.min_step_pixels *= 50.0;
  both.alignment.min_cost_change = 0.005;
  Parameters tenth = both;
  tenth.alignment.min_step_pixels *= 0.1;
  tenth.alignment.min_cost_change *= 0.1;
  const Minimum expected = minimize({&quartic}, at(0.5), 1.0, kPixelMotion, both);
  const Minimum actual = minimize({&quartic}, at(0.5), 1.0, kPixelMotion, tenth, 10.0);
  EXPECT_LT(expected.iterations, far.iterations);
  EXPECT_EQ(actual.iterations, expected.iterations);
  EXPECT_EQ(actual.cost, expected.cost);
}

TEST(MinimizeTest, AShortStepIsTakenUntriedWhereTheCostIsConvex) {
  TranslationTerm bowl(Eigen::Matrix3d::Identity(), {0.004, 0.0, 0.0});
  const Minimum minimum = minimize({&bowl}, at(0.0), 1.0, kPixelMotion, freeParameters(), 1.0, 0.5);
  EXPECT_NEAR(minimum.T_live_ref.translation().x(), 0.004, 1e-12);
  EXPECT_NEAR(minimum.cost, bowl.cost() - 0.5 * 0.004 * 0.004, 1e-12);  // as predicted
  EXPECT_EQ(minimum.iterations, 1);
  EXPECT_EQ(minimum.evaluations, 1);
  // Longer steps are evaluated, and so are steps from places of negative curvature.
  EXPECT_EQ(minimize({&bowl}, at(0.1), 1.0, kPixelMotion, freeParameters(), 1.0, 0.5).evaluations,
            2);
  LineTerm hill([](double x) { return std::cos(x); }, [](double x) { return -std::sin(x); },
                [](double x) { return -std::cos(x); });
  EXPECT_GT(minimize({&hill}, at(0.001), 1.0, kPixelMotion, freeParameters(), 1.0, 0.5).evaluations,
            2);
}

TEST(MinimizeTest, AnInfiniteCostStaysWhereItIs) {
  LineTerm nowhere([](double) { return std::numeric_limits<double>::infinity(); },
                   [](double) { return 1.0; }, [](double) { return 1.0; });
  const Minimum minimum = minimize({&nowhere}, at(0.7), 1.0, kPixelMotion, freeParameters());
  EXPECT_EQ(minimum.T_live_ref.translation().x(), 0.7);
  EXPECT_EQ(minimum.iterations, 0);
  EXPECT_TRUE(nowhere.linearized_.empty());
}

/// A quadratic cost with one entry of its model replaced.
class SpoiltTerm : public TranslationTerm {
 public:
  using Spoil = void (*)(QuadraticModel&, double);
  SpoiltTerm(Spoil spoil, double value)
      : TranslationTerm(Eigen::Matrix3d::Identity(), {0.3, 0.0, 0.0}),
        spoil_(spoil),
        value_(value) {}
  QuadraticModel model() const override {
    QuadraticModel model = TranslationTerm::model();
    spoil_(model, value_);
    return model;
  }

 private:
  Spoil spoil_;
  double value_;
};

TEST(MinimizeTest, WhatIsNotFiniteEndsWithoutAStep) {
  const Matrix6 all = Matrix6::Identity();
  const auto expectNoStep = [&](TranslationTerm& term, const Matrix6& pixel_motion) {
    for (const Matrix6* free : {static_cast<const Matrix6*>(nullptr), &all}) {
      const Minimum minimum =
          minimize({&term}, at(0.1), 1.0, pixel_motion, freeParameters(), 1.0, 0.5, free);
      EXPECT_EQ(minimum.T_live_ref.matrix(), at(0.1).matrix());
      EXPECT_EQ(minimum.iterations, 0);
      EXPECT_EQ(minimum.evaluations, 1);  // no step was tried
    }
  };
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
        -std::numeric_limits<double>::infinity()}) {
    Matrix6 motion = kPixelMotion;
    motion(0, 0) = bad;
    TranslationTerm bowl(Eigen::Matrix3d::Identity(), {0.3, 0.0, 0.0});
    expectNoStep(bowl, motion);
    SpoiltTerm slope([](QuadraticModel& m, double value) { m.gradient[0] = value; }, bad);
    expectNoStep(slope, kPixelMotion);
    SpoiltTerm curvature([](QuadraticModel& m, double value) { m.hessian(1, 1) = value; }, bad);
    expectNoStep(curvature, kPixelMotion);
  }
}

TEST(MinimizeTest, AStepIntoNothingIsRefused) {
  // Points leave the view beyond x = 0.3.
  LineTerm cliff(
      [](double x) {
        return x < 0.3 ? (x - 0.29) * (x - 0.29) : std::numeric_limits<double>::infinity();
      },
      [](double x) { return 2.0 * (x - 0.29); }, [](double) { return 1.0; });
  const Minimum minimum = minimize({&cliff}, at(0.0), 1.0, kPixelMotion, freeParameters());
  EXPECT_TRUE(std::isfinite(minimum.cost));
  EXPECT_NEAR(minimum.T_live_ref.translation().x(), 0.29, 0.01);
}

}  // namespace
}  // namespace mivo
