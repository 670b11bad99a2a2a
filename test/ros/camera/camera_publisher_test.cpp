// SPDX-License-Identifier: BSD-3-Clause
// The camera's publisher goes, with its nodelet, while others subscribe to it.
#include "ros/camera_publisher.h"

#include <gtest/gtest.h>
#include <ros/ros.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>

#include <atomic>
#include <future>
#include <memory>
#include <thread>

namespace mivo {
namespace {

template <typename Message>
ros::Subscriber subscribe(ros::NodeHandle& node, const std::string& topic) {
  return node.subscribe<Message>(topic, 1,
                                 boost::function<void(const boost::shared_ptr<const Message>&)>(
                                     [](const boost::shared_ptr<const Message>& /*message*/) {}));
}

TEST(CameraPublisherTest, NobodyIsCountedOnceItGoes) {
  ros::NodeHandle node("camera");
  for (int round = 0; round < 20; ++round) {
    std::promise<void> entered;
    std::promise<void> release;
    const std::shared_future<void> released = release.get_future().share();
    std::atomic<int> calls{0};
    auto publisher = std::make_unique<CameraPublisher>(node, CameraParameters(),
                                                       [&](const StreamDemand& /*demand*/) {
                                                         if (calls++ == 0) entered.set_value();
                                                         released.wait();
                                                       });
    const ros::Subscriber image = subscribe<sensor_msgs::Image>(node, "rgb/image_raw");
    ASSERT_EQ(std::future_status::ready, entered.get_future().wait_for(std::chrono::seconds(10)));
    // While the first is counted, the next one waits for its turn, and the publisher has to go.
    const ros::Subscriber info = subscribe<sensor_msgs::CameraInfo>(node, "rgb/camera_info");
    std::thread end([&] { publisher.reset(); });
    // Nothing tells how far a destructor is. What is asserted holds without this wait, too; with it
    // more of the publisher has gone when the callback goes on, and a fault shows sooner.
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    release.set_value();
    end.join();
    EXPECT_LE(calls, 2);
  }
}

}  // namespace
}  // namespace mivo

int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "camera_publisher_test");
  ros::AsyncSpinner spinner(2);
  spinner.start();
  return RUN_ALL_TESTS();
}
