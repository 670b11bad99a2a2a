// SPDX-License-Identifier: BSD-3-Clause
// Loading, unloading and long runs: while images arrive, and while services are called. What the
// manager's process holds stays the same.
#include <dynamic_reconfigure/Reconfigure.h>
#include <gtest/gtest.h>
#include <nodelet/NodeletLoad.h>
#include <nodelet/NodeletUnload.h>
#include <std_srvs/Trigger.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>
#include <map>
#include <string>
#include <thread>

#include "ros/node_fixture.h"
#include "ros/node_process.h"
#include "support/holdings.h"

namespace mivo {
namespace {

using testing::fromEnvironment;
using testing::Holdings;

/// Does something again and again, in a thread of its own, until it is destroyed.
class Repeatedly {
 public:
  explicit Repeatedly(const std::function<void()>& action)
      : thread_([this, action] {
          while (!is_over_) action();
        }) {}
  ~Repeatedly() {
    is_over_ = true;
    thread_.join();
  }
  Repeatedly(const Repeatedly&) = delete;
  Repeatedly& operator=(const Repeatedly&) = delete;

 private:
  std::atomic<bool> is_over_{false};
  std::thread thread_;
};

class LifetimeTest : public NodeTest {
 protected:
  Holdings holdings() { return testing::holdingsOf(manager_); }

  /// Publishes the next frame of a path there and back, faster than it can be tracked.
  void publishNext() {
    const int at = next_++;
    const int turn = at % 40;
    publish(turn < 20 ? turn : 40 - turn, at);
    waitFor([&] { return hasStatus(at); }, std::chrono::milliseconds(3));
  }

  /// Loads the nodelet, waits for the status of any frame, and unloads it.
  void live() {
    forget();
    loadOnly();
    ASSERT_TRUE(waitFor([&] { return !statuses_.empty(); }));
    ASSERT_TRUE(unload());
  }

  const pid_t manager_ = processOf("/manager");
  std::atomic<int> next_{0};
};

// MIVO_LOADS=100 takes a minute.
TEST_F(LifetimeTest, ItIsLoadedAndUnloadedWhileImagesArrive) {
  const int num_loads = fromEnvironment("MIVO_LOADS", 15);
  publishCameraOnBase();
  const Repeatedly images([this] { publishNext(); });
  for (int i = 0; i < 5; ++i) live();
  const Holdings before = holdings();
  for (int i = 0; i < num_loads; ++i) live();
  const Holdings after = holdings();
  EXPECT_EQ(after.threads, before.threads);
  EXPECT_LE(after.descriptors, before.descriptors + 2);  // sockets that are about to close
  EXPECT_LT(after.resident_mb, before.resident_mb + 8.0);
  RecordProperty("mb_more", std::to_string(after.resident_mb - before.resident_mb));
}

TEST_F(LifetimeTest, ItIsUnloadedInTheMiddleOfServiceCalls) {
  publishCameraOnBase();
  const Repeatedly images([this] { publishNext(); });
  const Repeatedly resets([this] {
    std_srvs::Trigger reset;
    ros::service::call(privateName("reset"), reset);  // fails while there is none
  });
  const Repeatedly changes([this] {
    dynamic_reconfigure::Reconfigure change;
    change.request.config.doubles.resize(1);
    change.request.config.doubles[0].name = "keyframe_translation";
    change.request.config.doubles[0].value = next_ % 2 == 0 ? 0.1 : 0.2;
    ros::service::call(privateName("set_parameters"), change);
  });
  for (int i = 0; i < 5; ++i) live();
}

TEST_F(LifetimeTest, TwoInOneManagerSayTheSame) {
  publishCameraOnBase();
  load();
  nodelet::NodeletLoad twin;
  twin.request.name = ns_ + "/twin/odometry";
  twin.request.type = "mivo/OdometryNodelet";
  for (const std::string topic : {"rgb/image", "rgb/camera_info", "depth/image"}) {
    twin.request.remap_source_args.push_back(ns_ + "/twin/" + topic);
    twin.request.remap_target_args.push_back(ns_ + '/' + topic);
  }
  ros::param::set(ns_ + "/twin/odometry/base_frame", frame("base_link"));
  ros::param::set(ns_ + "/twin/odometry/odom_frame", frame("twin_odom"));
  ros::param::set(ns_ + "/twin/odometry/publish_tf", false);
  ros::param::set(ns_ + "/twin/odometry/drop_frames", false);
  std::map<ros::Time, nav_msgs::Odometry> twins;
  const boost::function<void(const nav_msgs::OdometryConstPtr&)> on_odometry =
      [&](const nav_msgs::OdometryConstPtr& message) {
        notify([&] { twins[message->header.stamp] = *message; });
      };
  const ros::Subscriber subscriber =
      node_.subscribe<nav_msgs::Odometry>("twin/odom", 100, on_odometry);
  ASSERT_TRUE(ros::service::call("/manager/load_nodelet", twin) && twin.response.success);
  ASSERT_GE(publishUntil([&] { return !twins.empty(); }, 0, 0), 0);
  for (const std::string& name : {privateName("reset"), ns_ + "/twin/odometry/reset"}) {
    std_srvs::Trigger reset;
    ASSERT_TRUE(ros::service::call(name, reset) && reset.response.success);
  }
  constexpr int kFirst = 200;
  constexpr int kFrames = 10;
  for (int i = 0; i < kFrames; ++i) track(i, kFirst + i);
  const ros::Time last = stampOf(kFirst + kFrames - 1);
  ASSERT_TRUE(waitFor([&] { return isDone(kFirst + kFrames - 1) && twins.count(last) > 0; }));
  nodelet::NodeletUnload end;
  end.request.name = twin.request.name;
  EXPECT_TRUE(ros::service::call("/manager/unload_nodelet", end) && end.response.success);
  const std::lock_guard<std::mutex> lock(mutex_);
  const nav_msgs::Odometry one = odometries_[last];
  EXPECT_GT(std::abs(one.pose.pose.position.x) + std::abs(one.pose.pose.position.y), 0.01);
  EXPECT_EQ(one.pose, twins[last].pose);
}

// In the suite for a few seconds; MIVO_SOAK_FRAMES=54000 is half an hour of 30 Hz.
TEST_F(LifetimeTest, ALongRunHoldsNothingMore) {
  const int num_frames = fromEnvironment("MIVO_SOAK_FRAMES", 1500);
  constexpr double kBytesPerPose = 152.0;  // kept for ~save_trajectory
  publishCameraOnBase();
  load();
  const auto run = [this](int frames) {
    for (int i = 0; i < frames; ++i) {
      const int at = next_;
      publishNext();
      ASSERT_TRUE(waitFor([&] { return hasStatus(at); }));
      if (i % 100 == 0) forget();
    }
  };
  // The path is published up to path_length, and buffers grow to their largest.
  run(std::max(500, num_frames / 2));
  const Holdings before = holdings();
  run(num_frames);
  const Holdings after = holdings();
  EXPECT_EQ(after.threads, before.threads);
  EXPECT_EQ(after.descriptors, before.descriptors);
  EXPECT_LT(after.resident_mb, before.resident_mb + 1.0 + 1e-6 * kBytesPerPose * num_frames);
  RecordProperty("mb_more", std::to_string(after.resident_mb - before.resident_mb));
}

}  // namespace
}  // namespace mivo
