// SPDX-License-Identifier: BSD-3-Clause
#include "ros/output_bag.h"

#include <gtest/gtest.h>
#include <rosbag/view.h>
#include <sensor_msgs/Image.h>

#include "ros/expect_error.h"
#include "support/temporary_folder.h"

namespace mivo {
namespace {

const ros::Time kTime(1.0);

sensor_msgs::Image imageOf(std::size_t bytes) {
  sensor_msgs::Image image;
  image.data.resize(bytes);
  return image;
}

TEST(OutputBagTest, IsCompleteWhenItIsClosedOrGone) {
  const TemporaryFolder folder;
  const std::string closed = folder / "closed.bag";
  const std::string gone = folder / "gone.bag";
  OutputBag bag(closed);
  bag.write("/image", kTime, imageOf(10));
  bag.close();
  OutputBag(gone).write("/image", kTime, imageOf(10));
  for (const std::string& path : {closed, gone}) {
    rosbag::Bag read(path);
    EXPECT_EQ(rosbag::View(read).size(), 1U) << path;
  }
}

TEST(OutputBagTest, AFullDiskIsAnErrorAndNotTheEndOfTheProcess) {
  const std::string text = "/dev/full cannot be written";
  const auto fill = [](std::size_t bytes) {
    OutputBag bag("/dev/full");
    for (int i = 0; i < 10; ++i) bag.write("/image", kTime, imageOf(bytes));
    bag.close();
  };
  EXPECT_ERROR(fill(1), text);  // less than a buffer: told when the bag is closed
  EXPECT_ERROR(fill(1000000), text);
}

TEST(OutputBagTest, AMissingFolderIsAnError) {
  EXPECT_ERROR(OutputBag("/missing/x.bag"), "/missing/x.bag cannot be written");
}

}  // namespace
}  // namespace mivo
