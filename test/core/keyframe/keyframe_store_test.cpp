// SPDX-License-Identifier: BSD-3-Clause
#include "core/keyframe/keyframe_store.h"

#include <gtest/gtest.h>

#include "core/odometry/recovery.h"
#include "support/random_pose.h"

namespace mivo {
namespace {

void add(KeyframeStore& store, int number, std::size_t num_recent) {
  store.candidate().number = number;
  store.candidate().T_odom_keyframe = Eigen::Isometry3d(Eigen::Translation3d(number, 0.0, 0.0));
  store.promote(num_recent);
}

std::vector<int> numbers(const KeyframeStore& store) {
  std::vector<int> result;
  for (std::size_t i = 0; i < store.size(); ++i) result.push_back(store.at(i).number);
  return result;
}

TEST(KeyframeStoreTest, TheNewestIsInUseAndTheOldestGoes) {
  KeyframeStore store;
  EXPECT_TRUE(store.isEmpty());
  for (int number = 1; number <= 5; ++number) add(store, number, 2);
  EXPECT_EQ(numbers(store), (std::vector<int>{5, 4, 3}));
  EXPECT_EQ(store.current().number, 5);
  add(store, 6, 0);
  EXPECT_EQ(numbers(store), std::vector<int>{6});
}

TEST(KeyframeStoreTest, AChosenOneIsInUseAndTheOthersKeepTheirOrder) {
  KeyframeStore store;
  for (int number = 1; number <= 4; ++number) add(store, number, 3);
  store.choose(2);
  EXPECT_EQ(numbers(store), (std::vector<int>{2, 4, 3, 1}));
}

TEST(KeyframeStoreTest, MemoryIsUsedAgain) {
  KeyframeStore store;
  add(store, 1, 1);
  add(store, 2, 1);
  const PosedKeyframe* oldest = &store.at(1);
  add(store, 3, 1);
  EXPECT_EQ(&store.candidate(), oldest);
  store.clear();
  EXPECT_TRUE(store.isEmpty());
}

TEST(KeyframeStoreTest, MovingTheWorldMovesAll) {
  KeyframeStore store;
  add(store, 1, 1);
  add(store, 2, 1);
  const Eigen::Isometry3d T = testing::Random(1).pose(1.0, 1.0);
  store.transform(T);
  for (std::size_t i = 0; i < 2; ++i) {
    const Eigen::Isometry3d expected =
        T * Eigen::Isometry3d(Eigen::Translation3d(store.at(i).number, 0.0, 0.0));
    EXPECT_TRUE(store.at(i).T_odom_keyframe.isApprox(expected, 1e-12));
  }
}

TEST(RecoveryTest, LastPoseFirstThenMotionThenOlderKeyframesInTurn) {
  KeyframeStore store;
  for (int number = 1; number <= 4; ++number) add(store, number, 3);
  const Eigen::Isometry3d last = testing::Random(2).pose(0.5, 0.5);
  const Eigen::Isometry3d predicted = last * testing::Random(3).pose(0.1, 0.2);
  const auto attempts = recoveryAttempts(store, last, predicted, 0);
  ASSERT_EQ(attempts.size(), 6U);
  EXPECT_TRUE(attempts[0].T_odom_camera.isApprox(last));
  EXPECT_TRUE(attempts[1].T_odom_camera.isApprox(predicted));
  const Vector6 half = logSe3(last.inverse() * attempts[2].T_odom_camera);
  EXPECT_TRUE(half.isApprox(0.5 * logSe3(last.inverse() * predicted), 1e-9));
  EXPECT_EQ(attempts[3].skipped_levels, 1);
  EXPECT_TRUE(attempts[3].T_odom_camera.isApprox(last));
  EXPECT_EQ(attempts[4].keyframe, 1U);
  EXPECT_EQ(attempts[5].keyframe, 2U);
  EXPECT_EQ(attempts[5].T_odom_camera.translation().x(), 2.0);
  const auto next = recoveryAttempts(store, last, last, 1);
  ASSERT_EQ(next.size(), 4U);  // no motion to continue
  EXPECT_EQ(next[2].keyframe, 3U);
  EXPECT_EQ(next[3].keyframe, 1U);
}

TEST(RecoveryTest, AnOnlyKeyframeIsEnough) {
  KeyframeStore store;
  add(store, 1, 3);
  const Eigen::Isometry3d last = Eigen::Isometry3d::Identity();
  EXPECT_EQ(recoveryAttempts(store, last, last, 7).size(), 2U);
}

}  // namespace
}  // namespace mivo
