// SPDX-License-Identifier: BSD-3-Clause
#include "synthetic/camera_path.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "mivo/core/error.h"
#include "mivo/core/se3.h"
#include "synthetic/ray_caster.h"
#include "synthetic/shared_scene.h"

namespace mivo {
namespace {

constexpr double kSeconds = 40.0;
constexpr double kDegree = 3.14159265358979 / 180.0;

struct Speeds {
  double mean_speed = 0.0;  // m/s
  double max_speed = 0.0;
  double mean_turn_rate = 0.0;  // deg/s
  double max_turn_rate = 0.0;
};

Speeds measure(const CameraPath& path) {
  constexpr double kStep = 1e-3;
  Speeds speeds;
  int count = 0;
  for (double t = 0.0; t < kSeconds; t += 0.02, ++count) {
    const Vector6 motion =
        localCoordinates(path.poseAt(t).inverse() * path.poseAt(t + kStep)) / kStep;
    const double speed = motion.head<3>().norm();
    const double turn_rate = motion.tail<3>().norm() / kDegree;
    speeds.mean_speed += speed;
    speeds.mean_turn_rate += turn_rate;
    speeds.max_speed = std::max(speeds.max_speed, speed);
    speeds.max_turn_rate = std::max(speeds.max_turn_rate, turn_rate);
  }
  speeds.mean_speed /= count;
  speeds.mean_turn_rate /= count;
  return speeds;
}

CameraPath pathIn(const std::string& scene, const std::string& name, std::uint64_t seed = 1) {
  return CameraPath(name, sharedScene(scene).viewpoint, seed);
}

bool pitched(const std::string& scene) {
  return std::abs(sharedScene(scene).viewpoint.pitch) > 0.5;
}

TEST(CameraPath, MovesAsFastAsAHand) {
  for (const std::string& scene : sceneNames()) {
    const Speeds translation = measure(pathIn(scene, "translation"));
    EXPECT_GT(translation.mean_speed, 0.2) << scene;
    EXPECT_LT(translation.max_speed, 0.42) << scene;
    EXPECT_LT(translation.max_turn_rate, 5.0) << scene;
    const Speeds eight = measure(pathIn(scene, "figure_of_eight"));
    EXPECT_GT(eight.mean_speed, 0.2) << scene;
    EXPECT_LT(eight.max_speed, 0.45) << scene;
    EXPECT_GT(eight.mean_turn_rate, 18.0) << scene;
    EXPECT_LT(eight.max_turn_rate, 42.0) << scene;
    const Speeds rotation = measure(pathIn(scene, "rotation"));
    EXPECT_GT(rotation.mean_turn_rate, 20.0) << scene;
    EXPECT_LT(rotation.max_turn_rate, 42.0) << scene;
    EXPECT_LT(rotation.max_speed, 0.15) << scene;
    const Speeds fast = measure(pathIn(scene, "fast_rotation"));
    EXPECT_GT(fast.mean_turn_rate, 80.0) << scene;
    // Looking down or up, yaw and roll add.
    EXPECT_LT(fast.max_turn_rate, pitched(scene) ? 162.0 : 150.0) << scene;
  }
}

TEST(CameraPath, StaticDoesNotMoveAtAll) {
  const CameraPath path = pathIn("room", "static");
  EXPECT_EQ(path.poseAt(0.0).matrix(), path.poseAt(7.3).matrix());
}

TEST(CameraPath, LooksAlongXUpright) {
  Viewpoint level;
  const CameraPath path("static", level, 1);
  const Eigen::Matrix3d R = path.poseAt(0.0).linear();
  EXPECT_LT((R.col(2) - Eigen::Vector3d::UnitX()).norm(), 1e-12);  // forward
  EXPECT_LT((R.col(1) + Eigen::Vector3d::UnitZ()).norm(), 1e-12);  // down
  level.pitch = 0.3;
  EXPECT_NEAR(CameraPath("static", level, 1).poseAt(0.0).linear()(2, 2), std::sin(0.3),
              1e-12);  // upwards
}

TEST(CameraPath, IsARotationAtAnyTime) {
  const CameraPath path = pathIn("room", "fast_rotation");
  for (double t = 0.0; t < 5.0; t += 0.37) {
    const Eigen::Matrix3d R = path.poseAt(t).linear();
    EXPECT_LT((R * R.transpose() - Eigen::Matrix3d::Identity()).norm(), 1e-12);
    EXPECT_GT(R.determinant(), 0.0);
  }
}

// Distances from the camera to what is around it.
std::vector<float> depthsSeen(const RayCaster& caster, const Eigen::Isometry3d& T_world_camera) {
  std::vector<float> depths;
  RayPacket packet;
  for (int row = -4; row <= 4; ++row) {
    for (int i = 0; i < kPacketSize; ++i) {
      const Eigen::Vector3d ray(0.6 * (2.0 * i / (kPacketSize - 1) - 1.0), 0.45 * row / 4.0, 1.0);
      packet.setOrigin(i, T_world_camera.translation().cast<float>());
      packet.setDirection(i, (T_world_camera.linear() * ray).cast<float>());
    }
    caster.trace(packet);
    for (std::size_t k = 0; k < kPacketSize; ++k) {
      depths.push_back(packet.patch[k] < 0 ? -1.0F : packet.distance[k]);
    }
  }
  std::sort(depths.begin(), depths.end());
  return depths;
}

float nearestAround(const RayCaster& caster, const Eigen::Vector3d& position) {
  float nearest = 1e9F;
  RayPacket packet;
  for (int ring = 0; ring < 6; ++ring) {
    for (int i = 0; i < kPacketSize; ++i) {
      const double azimuth = 2.0 * 3.14159265 * (i + 0.5 * (ring % 2)) / kPacketSize;
      const double height = -0.9 + 0.36 * ring;
      const double radius = std::sqrt(1.0 - height * height);
      packet.setOrigin(i, position.cast<float>());
      packet.setDirection(i, Eigen::Vector3f(static_cast<float>(radius * std::cos(azimuth)),
                                             static_cast<float>(radius * std::sin(azimuth)),
                                             static_cast<float>(height)));
    }
    caster.trace(packet);
    nearest = std::min(nearest, *std::min_element(packet.distance.begin(), packet.distance.end()));
  }
  return nearest;
}

TEST(CameraPath, StaysClearOfTheFurnitureAndSeesThingsInRange) {
  for (const std::string& scene_name : sceneNames()) {
    const Scene& scene = sharedScene(scene_name);
    const RayCaster caster(scene);
    for (const std::string& name : CameraPath::names()) {
      for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        const CameraPath path(name, scene.viewpoint, seed);
        for (double t = 0.0; t < kSeconds; t += 0.25) {
          const Eigen::Isometry3d pose = path.poseAt(t);
          ASSERT_GT(nearestAround(caster, pose.translation()), 0.25F)
              << scene_name << " " << name << " " << t;
          const std::vector<float> depths = depthsSeen(caster, pose);
          ASSERT_GT(depths.front(), 0.0F)
              << scene_name << " " << name << " " << t;  // no hole in the room
          EXPECT_GT(depths[depths.size() / 20], 0.45F) << scene_name << " " << name << " " << t;
          // Much of a hall is beyond the range of the sensor, but never all.
          const std::size_t seen = depths.size() * (scene_name == "hall" ? 4 : 19) / 20;
          EXPECT_LT(depths[seen], 4.2F) << scene_name << " " << name << " " << t;
        }
      }
    }
  }
}

TEST(CameraPath, SlidesOnFromTheCenterWithModerateAccelerations) {
  const Viewpoint& viewpoint = sharedScene("blank").viewpoint;
  constexpr double kStep = 1e-3;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const CameraPath path("slide", viewpoint, seed);
    const auto position = [&](double t) { return Eigen::Vector3d(path.poseAt(t).translation()); };
    EXPECT_EQ(position(0.0), viewpoint.center) << seed;
    for (double t = 0.0; t < 10.0; t += 0.1) {
      const Eigen::Vector3d acceleration =
          (position(t + kStep) - 2.0 * position(t) + position(t - kStep)) / (kStep * kStep);
      EXPECT_LT(acceleration.norm(), 0.5) << seed;
    }
    const Speeds speeds = measure(path);
    EXPECT_LT(speeds.max_speed, 0.6) << seed;
    EXPECT_LT(speeds.max_turn_rate, 22.0) << seed;
    EXPECT_GT(position(5.0).norm(), 0.5) << seed;
  }
}

TEST(CameraPath, APaceMakesAllOfItFaster) {
  const Viewpoint& viewpoint = sharedScene("room").viewpoint;
  const CameraPath usual("figure_of_eight", viewpoint, 3);
  const CameraPath fast("figure_of_eight", viewpoint, 3, 2.5);
  EXPECT_EQ(fast.poseAt(0.8).matrix(), usual.poseAt(2.0).matrix());
}

TEST(CameraPath, RollsWithTheViewpoint) {
  Viewpoint rolled;
  rolled.roll = 0.3;
  const Eigen::Matrix3d R = CameraPath("static", rolled, 1).poseAt(0.0).linear();
  EXPECT_LT((R.col(2) - Eigen::Vector3d::UnitX()).norm(), 1e-12);
  EXPECT_NEAR(R(2, 0), -std::sin(0.3), 1e-12);  // the camera's right points down
}

TEST(CameraPath, SeedsGiveDifferentMotion) {
  const Eigen::Isometry3d a = pathIn("room", "figure_of_eight", 1).poseAt(1.0);
  const Eigen::Isometry3d b = pathIn("room", "figure_of_eight", 2).poseAt(1.0);
  EXPECT_GT((a.translation() - b.translation()).norm(), 0.01);
  EXPECT_THROW(pathIn("room", "jump"), Error);
}

}  // namespace
}  // namespace mivo
