// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "synthetic/renderer.h"
#include "synthetic/sequence_generator.h"

// Scenes of one surface have open directions: motion along them changes neither image nor depth, up
// to rounding in the ray caster; every other motion does.

namespace mivo {
namespace {

// Gray levels out of 255, where an edge falls between pixels.
constexpr double kRounding = 1.0;
constexpr double kDepthRounding = 3e-5;  // m

struct Open {
  std::string scene;
  std::vector<Eigen::Isometry3d> open;  // motions of the world that change neither image nor depth
  std::vector<Eigen::Isometry3d> closed;  // motions that do
};

Eigen::Isometry3d shift(double x, double y, double z) {
  return Eigen::Isometry3d(Eigen::Translation3d(x, y, z));
}

Eigen::Isometry3d turn(double angle, const Eigen::Vector3d& axis) {
  return Eigen::Isometry3d(Eigen::AngleAxisd(angle, axis));
}

std::vector<Open> openScenes() {
  const Eigen::Isometry3d about_y = turn(0.4, Eigen::Vector3d::UnitY());
  const Eigen::Isometry3d about_x = turn(0.4, Eigen::Vector3d::UnitX());
  const Eigen::Isometry3d about_z = turn(0.4, Eigen::Vector3d::UnitZ());
  return {{"stripes",
           {shift(0.0, 0.0, 0.7), shift(0.0, 0.0, -2.3)},
           {shift(0.0, 0.05, 0.0), about_x, shift(0.05, 0.0, 0.0)}},
          {"blank",
           {shift(0.0, 0.7, 0.3), about_x, about_x * shift(0.0, -1.0, 2.0)},
           {about_z, shift(0.05, 0.0, 0.0)}},
          {"tube", {shift(0.0, 0.8, 0.0)}, {about_y, shift(0.05, 0.0, 0.0)}},
          {"rings", {about_y}, {shift(0.0, 0.05, 0.0), shift(0.05, 0.0, 0.0)}},
          {"blank_floor", {shift(0.5, 0.7, 0.0), about_z}, {about_y, shift(0.0, 0.0, 0.05)}}};
}

struct View {
  cv::Mat light;  // lux times reflectance
  cv::Mat depth;
};

class OpenDirections : public testing::Test {
 protected:
  static View look(const Renderer& renderer, const Eigen::Isometry3d& T_world_camera) {
    const SceneLighting lighting("constant", {30, 1.0 / 30.0}, renderer.scene());
    const PoseAtTime pose = [&](double) { return T_world_camera; };
    const LightAtTime light = [&](double t) { return lighting.at(t); };
    Shutter shutter;
    return {renderer.renderColor(pose, light, shutter),
            renderer.renderSurface(pose, light, shutter, Eigen::Vector2f::Zero()).depth};
  }
  static Renderer rendererOf(const std::string& scene, std::uint64_t seed) {
    return Renderer(makeScene(scene, seed), xtionCamera(80, 60), 1);
  }
  static Eigen::Isometry3d somewhere(const Renderer& renderer, std::uint64_t seed) {
    return CameraPath("slide", renderer.scene().viewpoint, seed).poseAt(1.3);
  }
  // The largest difference of gray values, where the brightest light gives 255.
  static double difference(const View& a, const View& b) {
    return 255.0 * cv::norm(a.light, b.light, cv::NORM_INF) / cv::norm(a.light, cv::NORM_INF);
  }
};

TEST_F(OpenDirections, NothingChangesAlongThem) {
  for (const Open& scene : openScenes()) {
    for (std::uint64_t seed = 1; seed <= 2; ++seed) {
      const Renderer renderer = rendererOf(scene.scene, seed);
      const Eigen::Isometry3d pose = somewhere(renderer, seed);
      const View here = look(renderer, pose);
      for (const Eigen::Isometry3d& motion : scene.open) {
        const View there = look(renderer, motion * pose);
        EXPECT_LT(difference(here, there), kRounding) << scene.scene << "\n" << motion.matrix();
        EXPECT_LT(cv::norm(here.depth, there.depth, cv::NORM_INF), kDepthRounding) << scene.scene;
      }
    }
  }
}

TEST_F(OpenDirections, SomethingChangesAcrossThem) {
  for (const Open& scene : openScenes()) {
    const Renderer renderer = rendererOf(scene.scene, 1);
    const Eigen::Isometry3d pose = somewhere(renderer, 1);
    const View here = look(renderer, pose);
    for (const Eigen::Isometry3d& motion : scene.closed) {
      const View there = look(renderer, motion * pose);
      EXPECT_TRUE(difference(here, there) > 10.0 ||
                  cv::norm(here.depth, there.depth, cv::NORM_INF) > 0.01)
          << scene.scene << "\n"
          << motion.matrix();
    }
  }
}

// The direction of the stripes on a floor depends on the seed: it is the y axis of the texture.
TEST_F(OpenDirections, AStripedFloorIsOpenAlongItsStripes) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const Renderer renderer = rendererOf("floor", seed);
    const Eigen::Vector3d along =
        renderer.scene().patches.front().edge_v.normalized().cast<double>();
    const Eigen::Vector3d across =
        renderer.scene().patches.front().edge_u.normalized().cast<double>();
    const Eigen::Isometry3d pose = somewhere(renderer, seed);
    const View here = look(renderer, pose);
    EXPECT_LT(difference(here, look(renderer, Eigen::Translation3d(0.8 * along) * pose)),
              kRounding);
    EXPECT_GT(difference(here, look(renderer, Eigen::Translation3d(0.05 * across) * pose)), 10.0);
  }
}

// Depth by the closed form of each surface.
TEST_F(OpenDirections, DepthIsThatOfTheSurface) {
  const Camera camera = xtionCamera(80, 60);
  for (const Open& scene : openScenes()) {
    const Renderer renderer = rendererOf(scene.scene, 3);
    const Eigen::Isometry3d pose = somewhere(renderer, 3);
    const View view = look(renderer, pose);
    for (int y = 0; y < camera.height; y += 7) {
      for (int x = 0; x < camera.width; x += 7) {
        const Eigen::Vector3d point =
            pose * (view.depth.at<float>(y, x) * *camera.ray(Eigen::Vector2d(x, y)));
        if (scene.scene == "tube" || scene.scene == "rings") {
          EXPECT_NEAR(std::hypot(point.x(), point.z()), 1.3, kDepthRounding);
        } else if (scene.scene == "blank_floor") {
          EXPECT_NEAR(point.z(), 0.0, kDepthRounding);
        } else {
          EXPECT_NEAR(point.x(), 2.0, kDepthRounding) << scene.scene;
        }
      }
    }
  }
}

// All of the lamps' stated light arrives everywhere, for every lighting.
TEST_F(OpenDirections, LightIsEven) {
  const Renderer renderer = rendererOf("blank", 1);
  const SceneLighting lighting("left_right", {300, 1.0 / 30.0}, renderer.scene());
  const PoseAtTime pose = [&](double) { return somewhere(renderer, 1); };
  Shutter shutter;
  for (const double t : {0.5, 2.5}) {
    shutter.mid_time = t;
    const cv::Mat light = renderer.renderColor(
        pose, [&](double at) { return lighting.at(at); }, shutter);
    double low = 0.0;
    double high = 0.0;
    cv::minMaxLoc(light.reshape(1), &low, &high);
    EXPECT_NEAR(low, 0.5 * 40.0, 1e-4);
    EXPECT_NEAR(high, 0.56 * 40.0, 1e-4);
  }
}

double deviation(const cv::Mat& light) {
  cv::Scalar mean;
  cv::Scalar deviations;
  cv::meanStdDev(light, mean, deviations);
  return deviations[1] / mean[1];
}

TEST_F(OpenDirections, APictureAtTheStartGoesOutOfSight) {
  int blind = 0;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const Renderer renderer = rendererOf("blank_after_texture", seed);
    const CameraPath path("slide", renderer.scene().viewpoint, seed);
    EXPECT_GT(deviation(look(renderer, path.poseAt(0.0)).light), 0.1) << seed;
    blind += deviation(look(renderer, path.poseAt(8.0)).light) < 1e-3 ? 1 : 0;
  }
  EXPECT_GE(blind, 4);  // one in front of a wall may be slow
}

TEST_F(OpenDirections, SameSeedSameScene) {
  const Renderer a = rendererOf("stripes", 5);
  const Renderer b = rendererOf("stripes", 5);
  const Renderer other = rendererOf("stripes", 6);
  const Eigen::Isometry3d pose = somewhere(a, 5);
  EXPECT_EQ(pose.matrix(), somewhere(b, 5).matrix());
  EXPECT_EQ(difference(look(a, pose), look(b, pose)), 0.0);
  EXPECT_GT(difference(look(a, pose), look(other, pose)), 10.0);
}

}  // namespace
}  // namespace mivo
