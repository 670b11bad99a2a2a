// SPDX-License-Identifier: BSD-3-Clause
#include "ros/bag_topics.h"

#include <gtest/gtest.h>

#include "ros/expect_error.h"

namespace mivo {
namespace {

constexpr char kImage[] = "sensor_msgs/Image";
constexpr char kCompressed[] = "sensor_msgs/CompressedImage";
constexpr char kInfo[] = "sensor_msgs/CameraInfo";

TEST(FindTopicsTest, EveryLayoutIsFound) {
  for (const BagLayout& layout : bagLayouts()) {
    const BagContents contents = {{layout.topics.color, kImage},
                                  {layout.topics.depth, kImage},
                                  {layout.topics.camera_info, kInfo},
                                  {"/imu", "sensor_msgs/Imu"}};
    const RgbdTopics topics = findTopics(contents, {});
    EXPECT_EQ(layout.topics.color, topics.color);
    EXPECT_EQ(layout.topics.depth, topics.depth);
    EXPECT_EQ(layout.topics.camera_info, topics.camera_info);
  }
}

TEST(FindTopicsTest, CompressedTopicsAreFoundWhereRawOnesAreMissing) {
  const RgbdTopics topics =
      findTopics({{"/camera/color/image_raw/compressed", kCompressed},
                  {"/camera/aligned_depth_to_color/image_raw/compressedDepth", kCompressed},
                  {"/camera/color/camera_info", kInfo}},
                 {});
  EXPECT_EQ("/camera/color/image_raw/compressed", topics.color);
  EXPECT_EQ("/camera/aligned_depth_to_color/image_raw/compressedDepth", topics.depth);
  EXPECT_EQ("/camera/color/camera_info", topics.camera_info);
}

TEST(FindTopicsTest, ThrottledTopicsHaveTheirCalibrationBesideThem) {
  const RgbdTopics topics =
      findTopics({{"/data_throttled_image/compressed", kCompressed},
                  {"/data_throttled_image_depth/compressedDepth", kCompressed},
                  {"/data_throttled_camera_info", kInfo}},
                 {});
  EXPECT_EQ("/data_throttled_camera_info", topics.camera_info);
}

TEST(FindTopicsTest, WantedTopicsAreTaken) {
  const BagContents contents = {{"/a/image", kImage},
                                {"/b/depth", kImage},
                                {"/c/info", kInfo},
                                {"/a/camera_info", kInfo},
                                {"/camera/rgb/image_color", kImage},
                                {"/camera/depth/image", kImage},
                                {"/camera/rgb/camera_info", kInfo}};
  const RgbdTopics topics = findTopics(contents, {"/a/image", "/b/depth", ""});
  EXPECT_EQ("/a/image", topics.color);
  EXPECT_EQ("/b/depth", topics.depth);
  EXPECT_EQ("/a/camera_info", topics.camera_info);
  EXPECT_EQ("/c/info", findTopics(contents, {"/a/image", "/b/depth", "/c/info"}).camera_info);
}

TEST(FindTopicsTest, AWantedColorTopicGoesWithTheDepthOfItsDriver) {
  const BagContents contents = {{"/camera/rgb/image_color", kImage},
                                {"/camera/depth/image", kImage},
                                {"/camera/rgb/image_raw", kImage},
                                {"/camera/depth_registered/image_raw", kImage},
                                {"/camera/rgb/camera_info", kInfo}};
  EXPECT_EQ("/camera/depth_registered/image_raw",
            findTopics(contents, {"/camera/rgb/image_raw", "", ""}).depth);
  EXPECT_EQ("/camera/depth/image", findTopics(contents, {"/camera/rgb/image_color", "", ""}).depth);
}

TEST(FindTopicsTest, ASlashAtTheBeginningMakesNoDifference) {
  const BagContents without = {{"camera/rgb/image_raw", kImage},
                               {"camera/depth_registered/image_raw/compressedDepth", kCompressed},
                               {"camera/rgb/camera_info", kInfo}};
  for (const RgbdTopics& wanted :
       {RgbdTopics{}, RgbdTopics{"/camera/rgb/image_raw", "", "/camera/rgb/camera_info"}}) {
    const RgbdTopics topics = findTopics(without, wanted);
    EXPECT_EQ("camera/rgb/image_raw", topics.color);  // as the bag spells it
    EXPECT_EQ("camera/depth_registered/image_raw/compressedDepth", topics.depth);
    EXPECT_EQ("camera/rgb/camera_info", topics.camera_info);
    EXPECT_EQ("openni2", layoutOf(topics));
  }
  const BagContents with = {{"/a/image", kImage}, {"/b/depth", kImage}, {"/a/camera_info", kInfo}};
  const RgbdTopics topics = findTopics(with, {"a/image", "b/depth", "a/camera_info"});
  EXPECT_EQ("/a/image", topics.color);
  EXPECT_EQ("/b/depth", topics.depth);
  EXPECT_EQ("/a/camera_info", topics.camera_info);
}

TEST(FindTopicsTest, OtherCamerasAreThoseWithColorElsewhere) {
  const BagContents contents = {{"/camera/rgb/image_raw", kImage},
                                {"/camera/rgb/image_mono/compressed", kCompressed},
                                {"/camera/depth_registered/image_raw", kImage},
                                {"/camera/ir/image", kImage},
                                {"/camera/infra1/image_rect_raw", kImage},
                                {"/camera/rgb/camera_info", kInfo}};
  EXPECT_TRUE(otherCameras(contents, findTopics(contents, {})).empty());
  BagContents two = contents;
  two["/camera2/color/image_raw"] = kImage;
  two["/camera2/color/image_raw/compressed"] = kCompressed;
  two["/camera2/aligned_depth_to_color/image_raw"] = kImage;
  EXPECT_EQ(std::set<std::string>{"/camera2/color/image_raw"},
            otherCameras(two, findTopics(two, {})));
}

TEST(FindTopicsTest, WhatIsMissingIsNamedWithWhatThereIs) {
  const BagContents contents = {{"/left/image", kImage}, {"/camera/rgb/camera_info", kInfo}};
  EXPECT_ERROR(findTopics(contents, {}), "/left/image");
  EXPECT_ERROR(findTopics(contents, {"/nonsense", "", ""}), "no images on the topic /nonsense");
  EXPECT_ERROR(findTopics({}, {}), "none");
  EXPECT_ERROR(
      findTopics({{"/camera/rgb/image_color", kImage}, {"/camera/depth/image", kImage}}, {}),
      "no camera_info beside");
  EXPECT_ERROR(findTopics({{"/a", kImage}, {"/b", kImage}}, {"/a", "/b", "/c"}),
               "no camera_info on the topic /c");
}

TEST(BagLayoutTest, UnknownNamesAreRefusedWithTheKnownOnes) {
  EXPECT_EQ("realsense", bagLayout("realsense").name);
  EXPECT_ERROR(bagLayout("kinect"), "tum openni2 rtabmap realsense");
}

}  // namespace
}  // namespace mivo
