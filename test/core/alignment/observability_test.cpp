// SPDX-License-Identifier: BSD-3-Clause
#include "core/alignment/observability.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "support/random_pose.h"

namespace mivo {
namespace {

using testing::Random;

constexpr double kLength = 2.0;  // m
constexpr int kPoints = 2000;
constexpr double kSignal = 100.0;  // of the derivatives in median depths and rad
constexpr double kNoise = 5.0;
constexpr std::array<bool, 6> kAll = {true, true, true, true, true, true};

/// Increments in median depths to meters.
Vector6 scale() {
  return (Vector6() << kLength, kLength, kLength, 1.0, 1.0, 1.0).finished();
}

/// Derivatives of the points in both frames: a signal in all directions but one axis (in median
/// depths and rad), and independent noise in each frame.
class TwoFrames {
 public:
  explicit TwoFrames(const Vector6& unseen, double noise = kNoise) {
    const Vector6 axis = unseen.normalized();
    for (int i = 0; i < kPoints; ++i) {
      Vector6 seen = kSignal * normal();
      seen -= axis.dot(seen) * axis;
      const Vector6 by_live = seen + noise * normal();
      add(seen + noise * normal(), by_live);
    }
  }

  /// Scales the live derivatives, as another exposure or blur does.
  TermCurvature term(double gain = 1.0) const {
    TermCurvature term;
    for (std::size_t i = 0; i < by_keyframe_.size(); ++i) {
      term.agreement.add(by_keyframe_[i], gain * by_live_[i]);
    }
    term.hessian = term.agreement.keyframe;
    return term;
  }

 private:
  Vector6 normal() {
    Vector6 v;
    for (int i = 0; i < 6; ++i) v[i] = random_.normal();
    return v;
  }

  /// For an increment in meters and rad.
  void add(const Vector6& by_keyframe, const Vector6& by_live) {
    by_keyframe_.emplace_back(scale().cwiseInverse().cwiseProduct(by_keyframe));
    by_live_.emplace_back(scale().cwiseInverse().cwiseProduct(by_live));
  }

  Random random_{7};
  std::vector<Vector6> by_keyframe_, by_live_;
};

ObservabilityInput inputFor(const Matrix6& hessian) {
  ObservabilityInput input;
  input.gradient_covariance = hessian;
  input.expected_covariance = 1e-4 * Matrix6::Identity();
  input.length = kLength;
  input.open_deviations = 3.0;
  return input;
}

Observability lookAt(const TermCurvature& term) {
  return {term.hessian, inputFor(term.hessian)};
}

int numOpen(const Observability& seen) {
  return static_cast<int>(std::count(seen.isOpen().begin(), seen.isOpen().end(), true));
}

Observability confirmed(const TermCurvature& term) {
  Observability seen = lookAt(term);
  seen.confirm(kAll, {term});
  return seen;
}

/// All directions are observable but the given axes, in meters and rad.
Observability withOpen(const std::vector<Vector6>& open) {
  Matrix6 projector = Matrix6::Identity();
  for (const Vector6& axis : open) {
    const Vector6 scaled = scale().cwiseInverse().cwiseProduct(axis).normalized();
    projector -= scaled * scaled.transpose();
  }
  const Vector6 inverse = scale().cwiseInverse();
  const Vector6 strengths = (Vector6() << 1, 2, 3, 4, 5, 6).finished();
  const Matrix6 curvature = projector * (1e6 * strengths).asDiagonal() * projector;
  const Matrix6 hessian = inverse.asDiagonal() * curvature * inverse.asDiagonal();
  return {hessian, inputFor(2.0 * hessian)};
}

TEST(ObservabilityTest, CurvatureOfNoiseIsNoViewAlthoughItIsLarge) {
  for (int k = 0; k < 6; ++k) {
    const TermCurvature term = TwoFrames(Vector6::Unit(k)).term();
    EXPECT_FALSE(lookAt(term).hasOpen()) << k;
    const Observability seen = confirmed(term);
    EXPECT_EQ(numOpen(seen), 1) << k;
    Directions expected{};
    expected[static_cast<std::size_t>(k)] = true;
    EXPECT_EQ(seen.openDirections(Eigen::Isometry3d::Identity()), expected) << k;
    EXPECT_LT((seen.openProjector() * Vector6::Unit(k) - Vector6::Unit(k)).norm(), 0.05) << k;
  }
}

// Sideways motion is not observable, rotation is, and noise correlates the two. With robust weights
// the Hessian of the term differs from the sum of squares that is compared: information about one
// must not leak into the other.
TEST(ObservabilityTest, WhatIsSeenOfOneDirectionDoesNotSpillOverIntoAnother) {
  TermCurvature term;
  Random random(9);
  for (int i = 0; i < kPoints; ++i) {
    const double seen = kSignal * random.normal();
    const auto derivative = [&](double noise, const Vector6& rest) {
      Vector6 d = rest;
      d[0] = noise;
      d[4] = 1.1 * noise + seen;
      return Vector6(scale().cwiseInverse().cwiseProduct(d));
    };
    Vector6 rest = Vector6::Zero();
    for (const int k : {1, 2, 3, 5}) rest[k] = kSignal * random.normal();
    const Vector6 by_keyframe = derivative(4.0 * kNoise * random.normal(), rest);
    term.agreement.add(by_keyframe, derivative(4.0 * kNoise * random.normal(), rest));
    const double weight = std::abs(seen) > kSignal ? 0.2 : 1.0;
    term.hessian += weight * by_keyframe * by_keyframe.transpose();
  }
  const Observability seen = confirmed(term);
  EXPECT_EQ(numOpen(seen), 1);
  const Directions expected = {true, false, false, false, false, false};
  EXPECT_EQ(seen.openDirections(Eigen::Isometry3d::Identity()), expected);
  EXPECT_LT((seen.openProjector() * Vector6::Unit(0) - Vector6::Unit(0)).norm(), 0.05);
}

TEST(ObservabilityTest, WhatBothFramesSeeIsKept) {
  const TermCurvature term = TwoFrames(Vector6::Unit(0), 0.0).term();
  TermCurvature other = TwoFrames(Vector6::Unit(1), 0.0).term();
  const Matrix6 sum = term.hessian + other.hessian;
  Observability seen(sum, inputFor(sum));
  const Vector6 before = seen.curvature();
  seen.confirm(kAll, {term, other});
  EXPECT_FALSE(seen.hasOpen());
  EXPECT_LT((seen.curvature() - before).norm(), 1e-4 * before.norm());
}

TEST(ObservabilityTest, OnlyWhatIsInDoubtIsAskedFor) {
  const TermCurvature term = TwoFrames(Vector6::Unit(0)).term();
  Observability seen = lookAt(term);
  // Eigenvalues are sorted: the first is that of the noise.
  seen.confirm({false, true, true, true, true, true}, {term});
  EXPECT_FALSE(seen.hasOpen());
  seen.confirm({true, false, false, false, false, false}, {term});
  EXPECT_EQ(numOpen(seen), 1);
  EXPECT_TRUE(seen.isOpen()[0]);
}

TEST(ObservabilityTest, BlurAndNegativesAgreeWithTheImage) {
  const TwoFrames all_seen(Vector6::Zero(), 1.0);
  for (const double gain : {1.0, 0.5, 0.1, -1.0, -0.5}) {
    const Observability seen = confirmed(all_seen.term(gain));
    EXPECT_FALSE(seen.hasOpen()) << gain;
    const Vector6 before = lookAt(all_seen.term()).curvature();
    EXPECT_LT((seen.curvature() - before).norm(), 0.01 * before.norm()) << gain;
  }
  for (const double gain : {0.5, -1.0}) {
    EXPECT_EQ(numOpen(confirmed(TwoFrames(Vector6::Unit(4)).term(gain))), 1) << gain;
  }
}

TEST(ObservabilityTest, IndependentNoiseInAllDirectionsShowsNothing) {
  TermCurvature term;
  Random random(3);
  const auto noise = [&] {
    Vector6 v;
    for (int i = 0; i < 6; ++i) v[i] = kSignal * random.normal();
    return v;
  };
  for (int i = 0; i < kPoints; ++i) {
    const Vector6 by_keyframe = noise();
    term.agreement.add(by_keyframe, noise());
  }
  term.hessian = term.agreement.keyframe;
  EXPECT_FALSE(lookAt(term).hasOpen());
  EXPECT_EQ(numOpen(confirmed(term)), 6);
}

TEST(ObservabilityTest, WhatTheMotionKnowsFarBetterIsOpen) {
  const TermCurvature term = TwoFrames(Vector6::Zero(), 0.0).term();
  ObservabilityInput input = inputFor(term.hessian);
  const double variance = lookAt(term).covarianceOfSeen()(1, 1);
  input.expected_covariance = Matrix6::Identity();
  input.expected_covariance(1, 1) = variance / 8.0;
  EXPECT_EQ(numOpen(Observability(term.hessian, input)), 0);
  input.expected_covariance = variance / 20.0 * Matrix6::Identity();
  EXPECT_GT(numOpen(Observability(term.hessian, input)), 0);
}

TEST(ObservabilityTest, TheProjectorProjects) {
  const Vector6 mixed = (Vector6() << 1.0, 0.0, 0.0, 0.0, 0.5, 0.0).finished();
  for (const std::vector<Vector6>& open :
       {std::vector<Vector6>{Vector6::Unit(2)}, {Vector6::Unit(0), Vector6::Unit(5)}, {mixed}}) {
    const Observability seen = withOpen(open);
    const Matrix6 P = seen.openProjector();
    EXPECT_EQ(numOpen(seen), static_cast<int>(open.size()));
    EXPECT_LT((P * P - P).norm(), 1e-9);
    EXPECT_NEAR(P.trace(), static_cast<double>(open.size()), 1e-9);
    for (const Vector6& axis : open) EXPECT_LT((P * axis - axis).norm(), 1e-9);
  }
  EXPECT_EQ(withOpen({}).openProjector(), Matrix6::Zero());
}

TEST(ObservabilityTest, CovarianceAndInformationAreInverseInWhatIsSeen) {
  const Vector6 mixed = (Vector6() << 1.0, 0.0, 0.3, 0.0, 0.5, 0.0).finished();
  for (const std::vector<Vector6>& open :
       {std::vector<Vector6>{}, {Vector6::Unit(0)}, {mixed, Vector6::Unit(1)}}) {
    const Observability seen = withOpen(open);
    const Matrix6 expected = Matrix6::Identity() - seen.openProjector();
    EXPECT_LT((seen.covarianceOfSeen() * seen.informationOfSeen() - expected).norm(), 1e-6);
    // The open directions have almost no information, where a guarded Hessian would have much.
    EXPECT_LT((seen.covarianceOfSeen() * scale().cwiseAbs2().cwiseInverse().asDiagonal() *
               seen.openProjector())
                  .norm(),
              1e-9);
    EXPECT_LT((seen.informationOfSeen() * seen.openProjector()).norm(), 1e-6);
  }
}

// Noise turns the open direction that is found a little towards those that are seen. A camera that
// has moved along the true one, as far as it may, must not seem to be measured by them.
TEST(ObservabilityTest, SeenDirectionsDoNotMeasureMotionAlongAnOpenOne) {
  const TermCurvature term = TwoFrames(Vector6::Unit(0)).term();
  ObservabilityInput input = inputFor(term.hessian);
  const double sigma = 0.2;  // m
  input.expected_covariance = sigma * sigma * Matrix6::Identity();
  Observability seen(term.hessian, input);
  seen.confirm(kAll, {term});
  ASSERT_EQ(numOpen(seen), 1);
  const Vector6 along = sigma * Vector6::Unit(0);
  const Vector6 across = along - seen.openProjector() * along;
  EXPECT_GT(across.dot(seen.covarianceOfSeen().completeOrthogonalDecomposition().solve(across)),
            1.0);
  EXPECT_LT(across.dot(seen.informationOfSeen() * across), 0.1);
  const Vector6 truly_across = 0.02 * Vector6::Unit(1);
  EXPECT_GT(truly_across.dot(seen.informationOfSeen() * truly_across), 100.0);
}

TEST(ObservabilityTest, TheCovarianceIsThatOfTheSandwich) {
  Random random(5);
  Matrix6 root;
  for (int i = 0; i < 36; ++i) root(i / 6, i % 6) = random.normal();
  const Matrix6 hessian = 1e6 * (root * root.transpose() + Matrix6::Identity());
  const Matrix6 C = 3.0 * hessian + 1e5 * Matrix6::Identity();
  ObservabilityInput input = inputFor(C);
  input.expected_covariance = Matrix6::Identity();
  const Observability seen(hessian, input);
  ASSERT_FALSE(seen.hasOpen());
  const Matrix6 expected = hessian.inverse() * C * hessian.inverse();
  EXPECT_LT((seen.covarianceOfSeen() - expected).norm(), 1e-9 * expected.norm());
}

// The Hessian of MI is negative in some directions, and stands for the covariance of the gradient
// where that is not known. Confirming the doubted directions turns the axes away from its own.
TEST(ObservabilityTest, TheCovarianceIsOneThoughTheHessianIsIndefinite) {
  const Matrix6 upper = TwoFrames(Vector6::Zero(), 0.0).term().hessian;
  for (const double shift : {0.0, 0.5, 0.99}) {
    Matrix6 indefinite = upper;
    indefinite.row(0) += shift * 4.0 * upper.row(4);
    indefinite.col(0) += shift * 4.0 * upper.col(4);
    TermCurvature term = TwoFrames(Vector6::Zero(), kNoise).term();
    Observability seen(indefinite, inputFor(indefinite));
    seen.confirm(kAll, {term});
    const Eigen::SelfAdjointEigenSolver<Matrix6> covariance(seen.covarianceOfSeen());
    EXPECT_GE(covariance.eigenvalues().minCoeff(), -1e-12 * covariance.eigenvalues().maxCoeff());
    const Eigen::SelfAdjointEigenSolver<Matrix6> information(seen.informationOfSeen());
    EXPECT_GE(information.eigenvalues().minCoeff(), -1e-9 * information.eigenvalues().maxCoeff());
  }
}

TEST(ObservabilityTest, DirectionsAreToldInTheAxesOfTheLiveCamera) {
  const auto turned = [](int axis, double degrees) {
    return retract(degrees * 3.14159265358979 / 180.0 * Vector6::Unit(3 + axis));
  };
  const Directions sideways = {true, false, false, false, false, false};
  const Directions vertical = {false, true, false, false, false, false};
  const Directions both = {true, true, false, false, false, false};
  const Observability seen = withOpen({Vector6::Unit(0)});
  EXPECT_EQ(seen.openDirections(Eigen::Isometry3d::Identity()), sideways);
  EXPECT_EQ(seen.openDirections(turned(2, 20.0)), sideways);
  EXPECT_EQ(seen.openDirections(turned(2, 45.0)), both);
  EXPECT_EQ(seen.openDirections(turned(2, 90.0)), vertical);
  EXPECT_EQ(seen.openDirections(turned(0, 90.0)), sideways);
  const Directions forward = {false, false, true, false, false, false};
  EXPECT_EQ(seen.openDirections(turned(1, 90.0)), forward);
  const Directions rolling = {false, false, false, false, false, true};
  EXPECT_EQ(withOpen({Vector6::Unit(5)}).openDirections(turned(2, 30.0)), rolling);
  // Rotating about a point two meters ahead moves the camera sideways.
  const Vector6 about_place = adjoint(retract(2.0 * Vector6::Unit(2))) * Vector6::Unit(4);
  const Directions around = {true, false, false, false, true, false};
  EXPECT_EQ(withOpen({about_place}).openDirections(Eigen::Isometry3d::Identity()), around);
}

TEST(ObservabilityTest, WithoutAUsableHessianAllIsOpen) {
  Matrix6 broken = Matrix6::Identity();
  broken(2, 2) = std::nan("");
  for (const Matrix6& hessian : {broken, Matrix6(Matrix6::Zero())}) {
    const Observability seen(hessian, inputFor(Matrix6::Identity()));
    EXPECT_EQ(numOpen(seen), 6);
    EXPECT_LT((seen.openProjector() - Matrix6::Identity()).norm(), 1e-12);
    EXPECT_EQ(seen.informationOfSeen(), Matrix6::Zero());
    EXPECT_EQ(seen.covarianceOfSeen(), Matrix6::Zero());
  }
}

}  // namespace
}  // namespace mivo
