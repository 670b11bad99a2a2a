// SPDX-License-Identifier: BSD-3-Clause
#include "core/terms/ssd_term.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/terms/robust_weight.h"
#include "support/analytic_points.h"
#include "support/numeric_derivative.h"
#include "support/random_pose.h"

namespace mivo {
namespace {

using testing::analyticCamera;
using testing::AnalyticImage;
using testing::Random;

const RobustWeight kKinds[] = {RobustWeight::kNone, RobustWeight::kHuber, RobustWeight::kTukey,
                               RobustWeight::kStudentT};

/// The losses written independently, in double precision.
double loss(RobustWeight kind, double u) {
  switch (kind) {
    case RobustWeight::kHuber:
      return std::abs(u) <= 1.345 ? 0.5 * u * u : 1.345 * std::abs(u) - 0.5 * 1.345 * 1.345;
    case RobustWeight::kTukey:
      return 4.685 * 4.685 / 6.0 *
             (1.0 - std::pow(std::max(0.0, 1.0 - u * u / (4.685 * 4.685)), 3));
    case RobustWeight::kStudentT:
      return 3.0 * std::log(1.0 + u * u / 5.0);
    case RobustWeight::kNone:
      break;
  }
  return 0.5 * u * u;
}

double weight(RobustWeight kind, double u) {
  const double step = 1e-5;
  return (loss(kind, u + step) - loss(kind, u - step)) / (2.0 * step * u);
}

/// Keyframe and live image of different statistics, and the term on them.
class SsdTermTest : public ::testing::Test {
 protected:
  explicit SsdTermTest(int step = 3)
      : points_(testing::analyticPoints(reference_, camera_, step)),
        live_(testing::rasterized(testing::litWaves(), camera_.width, camera_.height)) {}

  SsdTerm term(RobustWeight kind, int threads = 1) {
    Parameters parameters;
    parameters.ssd.robust_weight = kind;
    parameters.alignment.threads = threads;
    return SsdTerm(points_, points_.size(), live_, nullptr, warp_, parameters);
  }

  /// The cost by definition: live samples are fixed, the keyframe is warped by the increment.
  double bruteForceCost(const SsdTerm& term, RobustWeight kind, const Vector6& d) const {
    double sum = 0.0;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      if (term.residuals().visible[i] == 0.0F) continue;
      const double residual =
          static_cast<double>(term.samples().value[i]) -
          testing::warpedIntensity(reference_, camera_, testing::pointAt(points_, i), d);
      sum += loss(kind, residual / term.scale());
    }
    return sum * static_cast<double>(points_.size()) / static_cast<double>(term.numVisible());
  }

  /// Sum of w J Jᵀ / scale² (Gauss-Newton), times the ratio of the loss's curvature to the weights
  /// for Gaussian residuals.
  Matrix6 bruteForceHessian(const SsdTerm& term, RobustWeight kind) const {
    Matrix6 sum = Matrix6::Zero();
    for (std::size_t i = 0; i < points_.size(); ++i) {
      if (term.residuals().visible[i] == 0.0F) continue;
      const Eigen::Vector3d point = testing::pointAt(points_, i);
      const auto intensity = [&](const Vector6& d) {
        return testing::warpedIntensity(reference_, camera_, point, d);
      };
      const Vector6 J = testing::numericGradient<6>(intensity, Vector6::Zero(), 1e-5);
      const double u = (static_cast<double>(term.samples().value[i]) - intensity(Vector6::Zero())) /
                       term.scale();
      sum += weight(kind, u) * J * J.transpose();
    }
    sum *= gaussianCurvature(kind);
    return sum / (term.scale() * term.scale()) * static_cast<double>(points_.size()) /
           static_cast<double>(term.numVisible());
  }

  Camera camera_ = analyticCamera();
  AnalyticImage reference_ = testing::waves();
  ReferencePoints points_;
  cv::Mat live_;
  Warp warp_{camera_, {}, 1};
};

TEST_F(SsdTermTest, CostAndGradientAreThoseOfItsDefinition) {
  Random random(1);
  for (const RobustWeight kind : kKinds) {
    for (int trial = 0; trial < 3; ++trial) {
      SsdTerm ssd = term(kind);
      const double cost = ssd.evaluate(random.pose(0.03, 0.02));
      ASSERT_TRUE(ssd.isSignificant());
      const QuadraticModel model = ssd.linearize(0);
      const auto definition = [&](const Vector6& d) { return bruteForceCost(ssd, kind, d); };
      EXPECT_NEAR(cost / definition(Vector6::Zero()), 1.0, 1e-5);
      EXPECT_TRUE(testing::convergesTo(
          model.gradient,
          [&](double step) {
            return testing::numericGradient<6>(definition, Vector6::Zero(), step);
          },
          2e-3, 1e-4))
          << static_cast<int>(kind) << "\nanalytic " << model.gradient.transpose() << "\nnumeric  "
          << testing::numericGradient<6>(definition, Vector6::Zero(), 1e-5).transpose();
    }
  }
}

TEST_F(SsdTermTest, HessianIsThatOfGaussAndNewton) {
  for (const RobustWeight kind : kKinds) {
    SsdTerm ssd = term(kind);
    ssd.evaluate(Random(2).pose(0.03, 0.02));
    const QuadraticModel model = ssd.linearize(0);
    EXPECT_LT(testing::relativeError(model.hessian, bruteForceHessian(ssd, kind)), 1e-3);
    EXPECT_EQ(model.hessian, model.hessian.transpose());
  }
}

TEST_F(SsdTermTest, WithoutResidualsTheHessianIsTheTrueOne) {
  live_ = testing::rasterized(reference_, camera_.width, camera_.height);
  SsdTerm ssd = term(RobustWeight::kNone);
  ssd.evaluate(Eigen::Isometry3d::Identity());
  const QuadraticModel model = ssd.linearize(0);
  const auto definition = [&](const Vector6& d) {
    return bruteForceCost(ssd, RobustWeight::kNone, d);
  };
  EXPECT_NEAR(model.cost, 0.0, 1e-3);
  EXPECT_LT(testing::relativeError(model.hessian,
                                   testing::numericHessian<6>(definition, Vector6::Zero(), 1e-4)),
            1e-3);
}

TEST_F(SsdTermTest, TheModelsCostIsThatOfTheLastEvaluationToTheBit) {
  Random random(3);
  for (const RobustWeight kind : kKinds) {
    SsdTerm ssd = term(kind);
    for (int trial = 0; trial < 3; ++trial) {
      const double cost = ssd.evaluate(random.pose(0.02, 0.02));
      EXPECT_EQ(ssd.linearize(trial == 0 ? 0 : 50).cost, cost);
    }
  }
}

// The scale is 1.4826 times the median magnitude, at first and in the first iterations only.
TEST_F(SsdTermTest, TheScaleIsEstimatedInTheFirstIterationsAndThenKept) {
  const auto medianScale = [this](const SsdTerm& ssd) {
    std::vector<float> magnitudes;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      if (ssd.residuals().visible[i] != 0.0F) {
        magnitudes.push_back(std::abs(ssd.residuals().value[i]));
      }
    }
    std::sort(magnitudes.begin(), magnitudes.end());
    return 1.4826 * static_cast<double>(magnitudes[magnitudes.size() / 2]);
  };
  Random random(4);
  SsdTerm ssd = term(RobustWeight::kHuber);
  EXPECT_EQ(ssd.scale(), 0.0);
  ssd.evaluate(random.pose(0.04, 0.03));
  const double first = ssd.scale();
  EXPECT_NEAR(first, medianScale(ssd), first / 64.0);
  ssd.linearize(0);
  ssd.evaluate(random.pose(0.01, 0.01));
  EXPECT_EQ(ssd.scale(), first);
  const QuadraticModel model = ssd.linearize(1);
  EXPECT_NEAR(ssd.scale(), medianScale(ssd), ssd.scale() / 64.0);
  EXPECT_NE(ssd.scale(), first);
  // The cost returned with the new scale is the one that later costs are compared with.
  EXPECT_NEAR(model.cost, bruteForceCost(ssd, RobustWeight::kHuber, Vector6::Zero()),
              1e-4 * model.cost);
  const double kept = ssd.scale();
  ssd.evaluate(random.pose(0.05, 0.05));
  ssd.linearize(3);
  EXPECT_EQ(ssd.scale(), kept);
}

TEST_F(SsdTermTest, TheScaleIsNeverBelowTheRoundingOfTheImage) {
  live_ = testing::rasterized(reference_, camera_.width, camera_.height);
  SsdTerm ssd = term(RobustWeight::kTukey);
  ssd.evaluate(Eigen::Isometry3d::Identity());
  EXPECT_EQ(ssd.scale(), Parameters().ssd.min_residual_scale);
}

TEST_F(SsdTermTest, PointsOutOfViewMakeTheCostNeitherBetterNorWorse) {
  live_ = cv::Mat(camera_.height, camera_.width, CV_32FC1, cv::Scalar(128.0F));
  std::fill(points_.intensity.begin(), points_.intensity.end(), 118.0F);
  SsdTerm ssd = term(RobustWeight::kNone);
  const double all = ssd.evaluate(Eigen::Isometry3d::Identity());
  const double some = ssd.evaluate(retract(0.4 * Vector6::Unit(0)));
  EXPECT_LT(ssd.numVisible(), 0.9 * static_cast<double>(points_.size()));
  EXPECT_NEAR(some / all, 1.0, 1e-6);
}

TEST_F(SsdTermTest, NothingInViewIsAnInfiniteCost) {
  SsdTerm ssd = term(RobustWeight::kHuber);
  EXPECT_EQ(ssd.evaluate(retract(30.0 * Vector6::Unit(0))),
            std::numeric_limits<double>::infinity());
  EXPECT_FALSE(ssd.isSignificant());
  EXPECT_EQ(ssd.correlation(), 0.0);
}

TEST_F(SsdTermTest, CorrelationTellsRelatedImagesFromOthers) {
  SsdTerm related = term(RobustWeight::kHuber);
  related.evaluate(Eigen::Isometry3d::Identity());
  EXPECT_GT(related.correlation(), 0.8);
  EXPECT_LE(related.correlation(), 1.0);
  EXPECT_TRUE(related.isSignificant());
  live_ = testing::rasterized(testing::negativeOfWaves(), camera_.width, camera_.height);
  SsdTerm inverted = term(RobustWeight::kHuber);
  inverted.evaluate(Eigen::Isometry3d::Identity());
  EXPECT_LT(inverted.correlation(), -0.9);
  EXPECT_FALSE(inverted.isSignificant());
  live_ = cv::Mat(camera_.height, camera_.width, CV_32FC1, cv::Scalar(3.0F));
  SsdTerm covered = term(RobustWeight::kHuber);
  covered.evaluate(Eigen::Isometry3d::Identity());
  EXPECT_EQ(covered.correlation(), 0.0);
  covered.linearize(0);
  EXPECT_FALSE(covered.isInformative());
}

TEST_F(SsdTermTest, TheFirstPointsAreATermOfTheirOwn) {
  const std::size_t n = points_.size() / 3;
  SsdTerm first(points_, n, live_, nullptr, warp_, {});
  ReferencePoints alone = points_;
  alone.pixels.resize(n);
  SsdTerm same(alone, n, live_, nullptr, warp_, {});
  const Eigen::Isometry3d T = Random(6).pose(0.01, 0.01);
  EXPECT_EQ(first.evaluate(T), same.evaluate(T));
  EXPECT_NE(first.evaluate(T), term(RobustWeight::kHuber).evaluate(T));
  EXPECT_LE(first.numVisible(), n);
  EXPECT_EQ(first.linearize(0).hessian, same.linearize(0).hessian);
  Matrix6 of_first;
  Matrix6 of_same;
  EXPECT_EQ(first.gradientCovariance(of_first), same.gradientCovariance(of_same));
  EXPECT_EQ(of_first, of_same);
}

class LargeSsdTermTest : public SsdTermTest {
 protected:
  LargeSsdTermTest() : SsdTermTest(1) {}
};

TEST_F(LargeSsdTermTest, TheNumberOfThreadsDoesNotChangeABit) {
  ASSERT_GT(points_.size(), 2U * 2048U);
  const Eigen::Isometry3d T = Random(5).pose(0.03, 0.03);
  SsdTerm one = term(RobustWeight::kHuber, 1);
  SsdTerm four = term(RobustWeight::kHuber, 4);
  EXPECT_EQ(one.evaluate(T), four.evaluate(T));
  const QuadraticModel a = one.linearize(0);
  const QuadraticModel b = four.linearize(0);
  EXPECT_EQ(a.gradient, b.gradient);
  EXPECT_EQ(a.hessian, b.hessian);
}

}  // namespace
}  // namespace mivo
