// SPDX-License-Identifier: BSD-3-Clause
// Lenses whose polynomial folds back: which pixels have a ray, which lenses are refused, and that
// an odometry is right with what is left.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "core/geometry/warp.h"
#include "core/kernels/kernels.h"
#include "core/keyframe/keyframe.h"
#include "core/keyframe/keyframe_view.h"
#include "mivo/core/camera.h"
#include "mivo/core/error.h"
#include "mivo/core/odometry.h"
#include "support/camera_path.h"
#include "support/error_text.h"
#include "support/projection.h"
#include "support/random_pose.h"
#include "support/scene.h"

namespace mivo {
namespace {

using testing::Random;
using testing::smallCamera;

Camera withLens(const Distortion& distortion) {
  Camera camera = smallCamera();
  camera.distortion = distortion;
  return camera;
}

double cornerRadius(const Camera& c) {
  return std::hypot(std::max(c.cx, c.width - 1.0 - c.cx) / c.fx,
                    std::max(c.cy, c.height - 1.0 - c.cy) / c.fy);
}

// The small camera's corners lie at the distorted radius 0.76. These fold where rays have the radii
// 0.91, 0.64 and, towards the side where it is nearest, 1.00: all inside of the corners.
const Distortion kStrongBarrel = {-0.4, 0.0, 0.0, 0.0, 0.0};
const Distortion kLateFold = {0.3, -0.2, 0.0, 0.0, -2.5};
const Distortion kTangential = {-0.25, 0.0, 0.03, -0.03, 0.0};

/// Eight coefficients, as an Azure Kinect's.
const Distortion kRational = {0.62, -2.74, 0.0005, -0.0002, 1.54, 0.49, -2.55, 1.46};

/// 120 degrees wide, 145 from corner to corner.
Camera fisheye() {
  Camera camera =
      withLens({0.03, -0.01, 0.0, 0.0, 0.002, -0.0005, 0.0, 0.0, LensModel::kEquidistant});
  camera.fx = camera.fy = 0.5 * camera.width / camera.distort({std::tan(M_PI / 3.0), 0.0}).x();
  return camera;
}

TEST(LensTest, DistortionIsThatOfTheFormulas) {
  const double x = 0.4;
  const double y = -0.3;  // r = 0.5
  const auto expectDistorted = [&](const Distortion& d, double px, double py) {
    const Eigen::Vector2d pixel = withLens(d).distort({x, y});
    EXPECT_NEAR(pixel.x(), px, 1e-14);
    EXPECT_NEAR(pixel.y(), py, 1e-14);
  };
  // 1 + 0.25 k1 + 0.0625 k2 + 0.015625 k3 over the same of k4 to k6.
  const double scale = (1.0 + 0.25 * 0.8 - 0.0625 * 0.4 + 0.015625 * 0.32) /
                       (1.0 + 0.25 * 0.4 + 0.0625 * 0.8 - 0.015625 * 0.64);
  expectDistorted({0.8, -0.4, 0.0, 0.0, 0.32, 0.4, 0.8, -0.64}, x * scale, y * scale);
  const double angle = std::atan(0.5);
  const double radius = angle + 0.1 * std::pow(angle, 3) - 0.2 * std::pow(angle, 5) +
                        0.3 * std::pow(angle, 7) - 0.4 * std::pow(angle, 9);
  expectDistorted({0.1, -0.2, 0.0, 0.0, 0.3, -0.4, 0.0, 0.0, LensModel::kEquidistant},
                  x * radius / 0.5, y * radius / 0.5);
}

TEST(LensTest, TheDerivativeIsThatOfTheDistortion) {
  constexpr double kStep = 1e-6;
  for (const Camera& camera : {withLens(kRational), fisheye(), withLens(kStrongBarrel)}) {
    for (const Eigen::Vector2d& point : {Eigen::Vector2d(0.0, 0.0), Eigen::Vector2d(1e-7, 0.0),
                                         Eigen::Vector2d(0.3, -0.2), Eigen::Vector2d(-0.5, 0.4)}) {
      Eigen::Matrix2d derivative;
      camera.distort(point, &derivative);
      for (int k = 0; k < 2; ++k) {
        const Eigen::Vector2d step = kStep * Eigen::Vector2d::Unit(k);
        const Eigen::Vector2d numeric =
            (camera.distort(point + step) - camera.distort(point - step)) / (2.0 * kStep);
        EXPECT_LT((derivative.col(k) - numeric).norm(), 1e-8);
      }
    }
  }
}

TEST(LensTest, EachPixelOfLensesOfEightCoefficientsAndOfAFisheyeHasItsRay) {
  for (const Camera& camera : {withLens(kRational), fisheye()}) {
    EXPECT_NO_THROW(camera.validate());
    const LensRange range = camera.lensRange();
    EXPECT_GT(range.distorted, cornerRadius(camera));
    for (int y = 0; y < camera.height; ++y) {
      for (int x = 0; x < camera.width; ++x) {
        const auto ray = camera.ray({x, y}, range);
        ASSERT_TRUE(ray);
        EXPECT_LT((*testing::project(camera, *ray) - Eigen::Vector2d(x, y)).norm(), 1e-9);
      }
    }
  }
  EXPECT_EQ(*fisheye().ray({fisheye().cx, fisheye().cy}), Eigen::Vector3d::UnitZ());
}

TEST(LensTest, APureFisheyeIsNoPinhole) {
  Distortion zeros;
  EXPECT_TRUE(zeros.isZero());
  zeros.model = LensModel::kEquidistant;
  EXPECT_FALSE(zeros.isZero());
  EXPECT_NE(zeros, Distortion());
}

TEST(LensTest, WithoutDistortionEachPixelHasARay) {
  const Camera camera = smallCamera();
  EXPECT_TRUE(std::isinf(camera.lensRange().distorted));
  EXPECT_EQ(*camera.ray({1e6, -1e6}),
            Eigen::Vector3d((1e6 - camera.cx) / camera.fx, (-1e6 - camera.cy) / camera.fy, 1.0));
}

TEST(LensTest, PublishedCalibrationsOfTheTumKinectsHaveARayForEachPixel) {
  for (const Camera& camera :
       {Camera{640, 480, 517.3, 516.5, 318.6, 255.3, {0.2624, -0.9531, -0.0054, 0.0026, 1.1633}},
        Camera{
            640, 480, 520.9, 521.0, 325.1, 249.7, {0.2312, -0.7849, -0.0033, -0.0001, 0.9172}}}) {
    const LensRange range = camera.lensRange();
    EXPECT_GT(range.distorted, cornerRadius(camera));
    for (const double x : {0.0, 639.0}) {
      for (const double y : {0.0, 479.0}) EXPECT_TRUE(camera.ray({x, y}, range));
    }
  }
}

// By definition: the first radius, over all directions, at which the derivative's least eigenvalue
// is a fifth. Where Newton's method is quick that far, it is the range.
TEST(LensTest, TheRangeEndsWhereTheLensShrinksLengthsFiveTimes) {
  for (const Distortion& lens : {kStrongBarrel, kLateFold, kTangential}) {
    const Camera camera = withLens(lens);
    const double range = camera.lensRange().undistorted;
    const auto leastStretch = [&](double r) {
      double least = 1e9;
      for (int i = 0; i < 720; ++i) {
        const double angle = i * M_PI / 360.0;
        Eigen::Matrix2d D;
        camera.distort({r * std::cos(angle), r * std::sin(angle)}, &D);
        least = std::min(least, D.trace() / 2.0 - std::hypot((D(0, 0) - D(1, 1)) / 2.0, D(0, 1)));
      }
      return least;
    };
    EXPECT_GT(leastStretch(range), 0.2);
    EXPECT_LT(leastStretch(range + 2.0 / 64.0), 0.2);
  }
}

TEST(LensTest, PixelsBeyondTheFoldHaveNoRayAndAllOthersTheirOwn) {
  for (const Distortion& lens : {kStrongBarrel, kLateFold, kTangential}) {
    const Camera camera = withLens(lens);
    const LensRange range = camera.lensRange();
    int without = 0;
    for (int y = 0; y < camera.height; ++y) {
      for (int x = 0; x < camera.width; ++x) {
        const auto ray = camera.ray({x, y}, range);
        EXPECT_EQ(ray.has_value(), camera.hasRay({x, y}, range));
        without += ray ? 0 : 1;
        if (!ray) continue;
        EXPECT_LE(ray->head<2>().norm(), range.undistorted);
        EXPECT_LT((*testing::project(camera, *ray) - Eigen::Vector2d(x, y)).norm(), 1e-9);
      }
    }
    EXPECT_FALSE(camera.ray({0.0, 0.0}));
    EXPECT_GT(without, 20);
    EXPECT_LT(without, camera.width * camera.height / 2);
  }
}

/// A lens of any kind, none too mild to be interesting.
Distortion randomLens(Random& random, int kind) {
  if (kind == 2) {
    return {random.uniform(-0.1, 0.1),   random.uniform(-0.05, 0.05), 0.0, 0.0,
            random.uniform(-0.02, 0.02), random.uniform(-0.01, 0.01), 0.0, 0.0,
            LensModel::kEquidistant};
  }
  Distortion lens = {random.uniform(-1.0, 0.6), random.uniform(-0.6, 0.6),
                     random.uniform(-0.02, 0.02), random.uniform(-0.02, 0.02),
                     random.uniform(-0.4, 0.4)};
  if (kind == 1) {
    lens.k4 = random.uniform(-0.5, 0.5);
    lens.k5 = random.uniform(-0.3, 0.3);
    lens.k6 = random.uniform(-0.2, 0.2);
  }
  return lens;
}

// The kernels have six steps in floats and test nothing: each pixel they are given must be right.
TEST(LensTest, TheKernelsFindTheRayOfEachPixelWithinTheRange) {
  Random random(7);
  for (int trial = 0; trial < 300; ++trial) {
    const int kind = trial % 3;
    Camera camera = withLens(randomLens(random, kind));
    if (kind == 2) camera.fx = camera.fy = fisheye().fx;
    const LensRange range = camera.lensRange();
    std::vector<float> u;
    std::vector<float> v;
    for (int y = 0; y < camera.height; y += 4) {
      for (int x = 0; x < camera.width; x += 4) {
        if (!camera.hasRay({x, y}, range)) continue;
        u.push_back(static_cast<float>(x));
        v.push_back(static_cast<float>(y));
      }
    }
    const std::vector<float> one(u.size(), 1.0F);
    std::vector<std::vector<float>> arrays(9, one);
    kernels::DerivedPoints points{arrays[0].data(), arrays[1].data(), arrays[2].data(), {}, {}};
    for (std::size_t k = 0; k < 6; ++k) points.jacobian[k] = arrays[3 + k].data();
    double motion[21] = {};
    kernels::active().keyframePoints(
        Warp(camera, RowMotion{}, 1).parameters(Eigen::Isometry3d::Identity()),
        {u.data(), v.data(), one.data(), one.data(), one.data(), nullptr, nullptr, nullptr},
        u.size(), points, motion);
    for (std::size_t i = 0; i < u.size(); ++i) {
      const Eigen::Vector3d point = Eigen::Vector3f(points.x[i], points.y[i], 1.0F).cast<double>();
      const auto ray = camera.ray({static_cast<double>(u[i]), static_cast<double>(v[i])}, range);
      ASSERT_TRUE(ray) << trial;
      // In pixels: towards the side of a fisheye a pixel holds more and more of the plane.
      Eigen::Matrix2d scale = Eigen::Matrix2d::Identity();
      if (kind == 2) camera.distort(ray->head<2>(), &scale);
      ASSERT_LT((scale * (point - *ray).head<2>()).norm() * camera.fx, 2e-3) << trial;
    }
    for (const double sum : motion) ASSERT_TRUE(std::isfinite(sum)) << trial;
  }
}

TEST(LensTest, AFoldInTheInnerHalfIsRefusedWithItsRadius) {
  struct Case {
    Distortion lens;
    const char* radius;
  };
  for (const Case& c : {Case{{-4.0, 0.0, 0.0, 0.0, 0.0}, "radius 0.25, "},
                        Case{{0.0, 0.0, 0.0, 0.0, -60.0}, "radius 0.34375, "},
                        Case{{0.0, 0.0, 0.5, 0.0, 0.0}, "radius 0.265625, "}}) {
    const Camera camera = withLens(c.lens);
    const LensRange range = camera.lensRange();
    EXPECT_LT(range.distorted, 0.5 * cornerRadius(camera));
    const std::string text = errorText([&] { camera.validate(); });
    EXPECT_NE(text.find(c.radius), std::string::npos) << text;
    const std::string pixels =
        std::to_string(std::lround(range.distorted * std::min(camera.fx, camera.fy)));
    EXPECT_NE(text.find(' ' + pixels + " pixels from the principal point"), std::string::npos)
        << text;
    EXPECT_EQ(text.find('\n'), std::string::npos);
    EXPECT_THROW(Odometry(camera, {}), Error);
  }
}

TEST(LensTest, AFoldNearTheCornersIsAccepted) {
  for (const Distortion& lens : {kStrongBarrel, kLateFold, kTangential}) {
    EXPECT_NO_THROW(withLens(lens).validate());
  }
}

// At the corners the image shows something else than the polynomial could say.
TEST(LensTest, NoPointOfAKeyframeLiesBeyondTheFold) {
  const Camera camera = withLens(kStrongBarrel);
  const LensRange range = camera.lensRange();
  const Parameters parameters;
  const Frame frame = testing::render(testing::wallScene(), camera, Eigen::Isometry3d::Identity());
  FramePyramid pyramid;
  pyramid.build(frame, parameters);
  Keyframe keyframe;
  keyframe.build(pyramid, camera, Vector6::Zero(), {}, parameters);
  for (int l = 0; l < keyframe.numLevels(); ++l) {
    const ReferencePoints& points = keyframe.level(l).points;
    EXPECT_GT(points.size(), 20U) << l;
    EXPECT_LE(points.num_leading, points.size()) << l;
    EXPECT_TRUE(points.pixel_motion.allFinite()) << l;
    for (const Pixel& pixel : points.pixels) {
      EXPECT_TRUE(camera.atLevel(l).hasRay({pixel.x, pixel.y}, range)) << l;
    }
  }
  const GeometricPoints& planes = keyframe.geometricPoints();
  EXPECT_GT(planes.size(), 100U);
  for (std::size_t i = 0; i < planes.size(); ++i) {
    EXPECT_LE(std::hypot(planes.x[i] / planes.z[i], planes.y[i] / planes.z[i]), range.undistorted);
    EXPECT_NEAR(planes.z[i], 2.0F, 0.01F);
  }
  for (const CloudPoint& point : makeCloud(keyframe, camera)) {
    EXPECT_LE(std::hypot(point.x / point.z, point.y / point.z), range.undistorted);
  }
}

TEST(LensTest, AnOdometryIsPreciseBehindEachLens) {
  for (const Camera& camera : {withLens(kStrongBarrel), withLens(kLateFold), withLens(kTangential),
                               withLens(kRational), fisheye()}) {
    const Distortion& lens = camera.distortion;
    const testing::Recording recording = testing::recordWalk(12, camera);
    Odometry odometry(recording.camera, {});
    for (std::size_t i = 0; i < recording.frames.size(); ++i) {
      const TrackingResult& result = odometry.process(recording.frames[i]);
      ASSERT_EQ(result.state, TrackingState::kTracking) << i;
      ASSERT_TRUE(result.T_odom_camera.matrix().allFinite()) << i;
      ASSERT_TRUE(result.covariance.allFinite()) << i;
      const Vector6 error =
          localCoordinates(result.T_odom_camera.inverse() * recording.T_first_camera[i]);
      EXPECT_LT(error.head<3>().norm(), 0.008) << i << " " << lens.k1;
      EXPECT_LT(error.tail<3>().norm(), 0.004) << i;
    }
  }
}

}  // namespace
}  // namespace mivo
