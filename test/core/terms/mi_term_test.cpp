// SPDX-License-Identifier: BSD-3-Clause
#include "core/terms/mi_term.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <limits>

#include "support/analytic_points.h"
#include "support/numeric_derivative.h"
#include "support/random_pose.h"
#include "support/reference_mutual_information.h"

namespace mivo {
namespace {

using testing::analyticCamera;
using testing::AnalyticImage;
using testing::Random;

/// A keyframe and a live image, and the gray levels that fill the bins of each.
struct Pair {
  const char* name;
  AnalyticImage reference;
  AnalyticImage live;
  IntensityRange reference_range;
  IntensityRange live_range;
};

// Images of different statistics, increasing and decreasing relations, and both orders. With a
// symmetric pair, exchanged axes or marginals would not be noticed.
std::vector<Pair> asymmetricPairs() {
  const IntensityRange waves{38.0F, 218.0F};
  const IntensityRange negative{35.0F, 185.0F};
  const IntensityRange lit{5.0F, 235.0F};
  const IntensityRange blobs{30.0F, 195.0F};
  return {{"waves, negative", testing::waves(), testing::negativeOfWaves(), waves, negative},
          {"negative, waves", testing::negativeOfWaves(), testing::waves(), negative, waves},
          {"lit, waves", testing::litWaves(), testing::waves(), lit, waves},
          {"blobs, lit", testing::blobs(), testing::litWaves(), blobs, lit}};
}

class Problem {
 public:
  Problem(const Pair& pair, const Parameters& parameters, int step = 4)
      : pair_(pair),
        parameters_(parameters),
        points_(testing::analyticPoints(pair.reference, camera_, step)),
        live_image_(testing::rasterized(pair.live, camera_.width, camera_.height)),
        reference_(makeMiReference(points_, pair.reference_range, parameters)),
        warp_(camera_, {}, 1),
        term_(points_, reference_, live_image_, pair.live_range, warp_, parameters) {}

  double evaluate(const Eigen::Isometry3d& T_live_ref) {
    const double cost = term_.evaluate(T_live_ref);
    LiveSamples samples;
    warp_.sample(points_, points_.size(), T_live_ref, live_image_, samples);
    live_places_.clear();
    visible_.clear();
    for (std::size_t i = 0; i < points_.size(); ++i) {
      if (samples.visible[i] == 0.0F) continue;
      visible_.push_back(i);
      live_places_.push_back(testing::binPlace(static_cast<double>(samples.value[i]),
                                               pair_.live_range, parameters_.mi.mi_bins));
    }
    return cost;
  }

  /// Joint probabilities after an increment of the keyframe; the live samples stay.
  Eigen::MatrixXd joint(const Vector6& d) const {
    std::vector<double> places;
    for (const std::size_t i : visible_) {
      const double intensity =
          testing::warpedIntensity(pair_.reference, camera_, testing::pointAt(points_, i), d);
      places.push_back(testing::binPlace(intensity, pair_.reference_range, parameters_.mi.mi_bins));
    }
    return testing::jointProbabilities(places, live_places_, parameters_.mi.mi_bins);
  }

  double bruteForceCost(const Vector6& d) const {
    return -static_cast<double>(points_.size()) * testing::mutualInformation(joint(d));
  }

  Vector6 numericGradient(double step) const {
    return testing::numericGradient<6>([this](const Vector6& d) { return bruteForceCost(d); },
                                       Vector6::Zero(), step);
  }
  Matrix6 numericHessian(double step) const {
    return testing::numericHessian<6>([this](const Vector6& d) { return bruteForceCost(d); },
                                      Vector6::Zero(), step);
  }

  Camera camera_ = analyticCamera();
  Pair pair_;
  Parameters parameters_;
  ReferencePoints points_;
  cv::Mat live_image_;
  MiReference reference_;
  Warp warp_;
  MiTerm term_;
  std::vector<double> live_places_;
  std::vector<std::size_t> visible_;
};

TEST(MiTermTest, CostIsMinusThePointsTimesTheirInformation) {
  Random random(1);
  for (const Pair& pair : asymmetricPairs()) {
    for (const int bins : {4, 8, 12}) {
      Parameters parameters;
      parameters.mi.mi_bins = bins;
      Problem problem(pair, parameters);
      const double cost = problem.evaluate(random.pose(0.03, 0.03));
      EXPECT_NEAR(cost / problem.bruteForceCost(Vector6::Zero()), 1.0, 1e-4) << pair.name;
      EXPECT_EQ(cost,
                -static_cast<double>(problem.points_.size()) * problem.term_.mutualInformation());
      EXPECT_GE(problem.term_.mutualInformation(), 0.0);
    }
  }
}

TEST(MiTermTest, GradientAgreesWithDifferencesOfTheDefinition) {
  Random random(2);
  for (const Pair& pair : asymmetricPairs()) {
    for (int trial = 0; trial < 3; ++trial) {
      Problem problem(pair, {});
      problem.evaluate(random.pose(0.04, 0.03));
      const Vector6 gradient = problem.term_.linearize(0).gradient;
      EXPECT_TRUE(testing::convergesTo(
          gradient, [&](double step) { return problem.numericGradient(step); }, 1e-3, 2e-4))
          << pair.name << "\nanalytic " << gradient.transpose() << "\nnumeric  "
          << problem.numericGradient(1e-5).transpose();
    }
  }
}

TEST(MiTermTest, FullHessianAgreesWithDifferencesOfTheDefinition) {
  Random random(3);
  for (const Pair& pair : asymmetricPairs()) {
    for (int trial = 0; trial < 2; ++trial) {
      Problem problem(pair, {});
      problem.evaluate(random.pose(0.04, 0.03));
      const Matrix6 hessian = problem.term_.linearize(0).hessian;
      EXPECT_LT(testing::relativeError(hessian, problem.numericHessian(1e-4)), 2e-3)
          << pair.name << "\nanalytic\n"
          << hessian << "\nnumeric\n"
          << problem.numericHessian(1e-4);
      EXPECT_EQ(hessian, hessian.transpose());
    }
  }
}

TEST(MiTermTest, ClampedIntensitiesDoNotMove) {
  Pair pair = asymmetricPairs()[0];
  pair.reference_range = {80.0F, 170.0F};  // many points lie outside
  Problem problem(pair, {});
  problem.evaluate(Random(4).pose(0.03, 0.02));
  const auto num_clamped =
      std::count(problem.reference_.unclamped.begin(), problem.reference_.unclamped.end(), 0.0F);
  ASSERT_GT(num_clamped, 50);
  EXPECT_LT(
      testing::relativeError(problem.term_.linearize(0).gradient, problem.numericGradient(1e-6)),
      2e-3);
}

TEST(MiTermTest, TheModelsCostIsThatOfTheLastEvaluationToTheBit) {
  Random random(5);
  Problem problem(asymmetricPairs()[2], {});
  for (int trial = 0; trial < 3; ++trial) {
    const double cost = problem.evaluate(random.pose(0.03, 0.03));
    EXPECT_EQ(problem.term_.linearize(trial).cost, cost);
  }
}

Pair selfPair() {
  const AnalyticImage image = testing::litWaves();
  return {"self", image, image, {5.0F, 235.0F}, {5.0F, 235.0F}};
}

TEST(MiTermTest, SelfAlignmentIsAMinimumOfTheCost) {
  Problem problem(selfPair(), {});
  const double aligned = problem.evaluate(Eigen::Isometry3d::Identity());
  const QuadraticModel model = problem.term_.linearize(0);
  EXPECT_LT(testing::relativeError(model.hessian, problem.numericHessian(1e-4)), 2e-3);
  const Eigen::SelfAdjointEigenSolver<Matrix6> solver(model.hessian);
  EXPECT_GT(solver.eigenvalues().minCoeff(), 0.0);
  Random random(6);
  for (int trial = 0; trial < 10; ++trial) {
    EXPECT_GT(problem.evaluate(random.pose(0.02, 0.02)), aligned);
  }
}

// A Gauss-Newton derivation would keep the products of first derivatives of the probabilities. It
// would turn the maximum into a minimum.
TEST(MiTermTest, WithoutTheWindowsSecondDerivativeTheHessianHasTheWrongSign) {
  Problem problem(selfPair(), {});
  problem.evaluate(Eigen::Isometry3d::Identity());
  const Eigen::MatrixXd p = problem.joint(Vector6::Zero());
  std::vector<Eigen::MatrixXd> derivatives;
  constexpr double kStep = 1e-5;
  for (int k = 0; k < 6; ++k) {
    derivatives.push_back(
        (problem.joint(kStep * Vector6::Unit(k)) - problem.joint(-kStep * Vector6::Unit(k))) /
        (2.0 * kStep));
  }
  Matrix6 first_order = Matrix6::Zero();  // of the information, so a maximum would be negative
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 6; ++j) {
      const Eigen::MatrixXd& a = derivatives[static_cast<std::size_t>(i)];
      const Eigen::MatrixXd& b = derivatives[static_cast<std::size_t>(j)];
      for (int r = 0; r < p.rows(); ++r) {
        for (int l = 0; l < p.cols(); ++l) {
          if (p(r, l) > 1e-12) first_order(i, j) += a(r, l) * b(r, l) / p(r, l);
        }
        const double marginal = p.row(r).sum();
        if (marginal > 1e-12) first_order(i, j) -= a.row(r).sum() * b.row(r).sum() / marginal;
      }
    }
  }
  const Matrix6 of_cost = -static_cast<double>(problem.points_.size()) * first_order;
  const Matrix6 full = problem.term_.linearize(0).hessian;
  for (int k = 0; k < 6; ++k) {
    EXPECT_LT(of_cost(k, k), 0.0);
    EXPECT_GT(full(k, k), 0.0);
  }
}

TEST(MiTermTest, TheHessianOfTheReferenceIsTheFullOneOfItsSelfAlignment) {
  Parameters constant;
  constant.mi.mi_hessian = MiHessian::kReference;
  Problem full(selfPair(), {});
  Problem reference(selfPair(), constant);
  full.evaluate(Eigen::Isometry3d::Identity());
  reference.evaluate(Random(7).pose(0.05, 0.05));
  const Matrix6 expected = full.term_.linearize(0).hessian;
  EXPECT_LT(testing::relativeError(reference.term_.linearize(0).hessian, expected), 1e-3);
  // The gradient is still that of the pose.
  EXPECT_LT(testing::relativeError(reference.term_.linearize(0).gradient,
                                   reference.numericGradient(1e-5)),
            1e-3);
}

TEST(MiTermTest, NothingInViewIsAnInfiniteCost) {
  Problem problem(asymmetricPairs()[0], {});
  EXPECT_EQ(problem.evaluate(retract(30.0 * Vector6::Unit(0))),
            std::numeric_limits<double>::infinity());
  EXPECT_EQ(problem.term_.numVisible(), 0U);
  EXPECT_EQ(problem.term_.mutualInformation(), 0.0);
  EXPECT_TRUE(problem.term_.linearize(0).gradient.allFinite());
  EXPECT_TRUE(problem.term_.linearize(0).hessian.allFinite());
}

TEST(MiTermTest, TheNumberOfThreadsDoesNotChangeABit) {
  const Eigen::Isometry3d T = Random(8).pose(0.03, 0.03);
  Parameters threaded;
  threaded.alignment.threads = 4;
  Problem one(asymmetricPairs()[1], {}, 1);
  Problem four(asymmetricPairs()[1], threaded, 1);
  ASSERT_GT(one.points_.size(), 2U * 2048U);
  EXPECT_EQ(one.term_.evaluate(T), four.term_.evaluate(T));
  const QuadraticModel a = one.term_.linearize(0);
  const QuadraticModel b = four.term_.linearize(0);
  EXPECT_EQ(a.gradient, b.gradient);
  EXPECT_EQ(a.hessian, b.hessian);
}

}  // namespace
}  // namespace mivo
