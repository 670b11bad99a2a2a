// SPDX-License-Identifier: BSD-3-Clause
#include "ros/bag_source.h"

#include <gtest/gtest.h>
#include <rosbag/view.h>
#include <tf2_msgs/TFMessage.h>

#include <fstream>
#include <opencv2/imgproc.hpp>

#include "ros/bag_writer.h"
#include "ros/expect_error.h"
#include "ros/pose_conversion.h"
#include "ros/stamp.h"
#include "support/temporary_folder.h"

namespace mivo {
namespace {

constexpr int kWidth = 32;
constexpr int kHeight = 24;
constexpr double kFirstStamp = 1305031229.528748;

SequenceCamera makeCamera(double units = 5000.0) {
  SequenceCamera camera;
  camera.camera.width = kWidth;
  camera.camera.height = kHeight;
  camera.camera.fx = camera.camera.fy = 30.0;
  camera.camera.cx = 15.5;
  camera.camera.cy = 11.5;
  camera.depth_units_per_meter = units;
  return camera;
}

cv::Mat color(int i) {
  cv::Mat image(kHeight, kWidth, CV_8UC3);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      image.at<cv::Vec3b>(y, x) =
          cv::Vec3b(static_cast<std::uint8_t>(7 * x + i), static_cast<std::uint8_t>(5 * y + 3 * i),
                    static_cast<std::uint8_t>(11 * x + 2 * y));
    }
  }
  return image;
}

cv::Mat depth(int i) {
  cv::Mat image(kHeight, kWidth, CV_16UC1);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      image.at<std::uint16_t>(y, x) =
          static_cast<std::uint16_t>(x == 0 ? 0 : 4000 + 13 * x + y + i);
    }
  }
  return image;
}

double stamp(int i) {
  return kFirstStamp + i / 30.0;
}

class BagSourceTest : public ::testing::Test {
 protected:
  /// Depth comes 4 ms later than color, as Kinects have it.
  void writeBag(const BagLayout& layout, BagImages images, int frames, double units = 5000.0) {
    BagWriter writer(path_, layout, makeCamera(units), images, Overwrite::kNo);
    for (int i = 0; i < frames; ++i) {
      writer.writeColor(stamp(i), color(i));
      writer.writeDepth(stamp(i) + 0.004, depth(i));
    }
  }

  TemporaryFolder folder_;
  std::string path_ = folder_ / "test.bag";
};

TEST_F(BagSourceTest, FloatDepthHasTheBitsOfTheTracker) {
  writeBag(bagLayout("tum"), BagImages::kRaw, 3);
  BagSource source(path_, {});
  EXPECT_EQ(makeCamera().camera, source.camera());
  ASSERT_EQ(3U, source.size());
  Frame frame;
  FrameFault fault;
  for (int i = 0; i < 3; ++i) {
    ASSERT_EQ(FrameSource::Status::kFrame, source.next(frame, fault)) << fault.text;
    EXPECT_EQ(stamp(i), frame.stamp);
    EXPECT_EQ(0.0, cv::norm(toGray(color(i), ChannelOrder::kBgr), frame.image, cv::NORM_INF));
    ASSERT_EQ(CV_32FC1, frame.depth.type());
    EXPECT_EQ(
        static_cast<float>(depth(i).at<std::uint16_t>(5, 7)) * static_cast<float>(1.0 / 5000.0),
        frame.depth.at<float>(5, 7));
    EXPECT_TRUE(std::isnan(frame.depth.at<float>(5, 0)));
  }
  EXPECT_EQ(FrameSource::Status::kEnd, source.next(frame, fault));
}

TEST_F(BagSourceTest, IntegerAndCompressedDepthAreMillimeters) {
  for (const BagImages images : {BagImages::kRaw, BagImages::kCompressed}) {
    path_ = folder_ / (images == BagImages::kRaw ? "raw.bag" : "compressed.bag");
    writeBag(bagLayout("realsense"), images, 2, 1000.0);
    BagSource source(path_, {});
    Frame frame;
    FrameFault fault;
    ASSERT_EQ(FrameSource::Status::kFrame, source.next(frame, fault)) << fault.text;
    EXPECT_EQ(0.0, cv::norm(toGray(color(0), ChannelOrder::kBgr), frame.image, cv::NORM_INF));
    EXPECT_EQ(0.0, cv::norm(depth(0), frame.depth, cv::NORM_INF));
    EXPECT_EQ(0.001, frame.depth_unit);
    EXPECT_EQ(1000.0, source.depthUnitsPerMeter());
  }
}

TEST_F(BagSourceTest, OtherUnitsAreRoundedToMillimeters) {
  writeBag(bagLayout("openni2"), BagImages::kRaw, 1, 5000.0);
  BagSource source(path_, {});
  Frame frame;
  FrameFault fault;
  ASSERT_EQ(FrameSource::Status::kFrame, source.next(frame, fault)) << fault.text;
  EXPECT_EQ(cvRound(depth(0).at<std::uint16_t>(5, 7) / 5.0), frame.depth.at<std::uint16_t>(5, 7));
}

TEST_F(BagSourceTest, RangeTakesAPart) {
  writeBag(bagLayout("tum"), BagImages::kRaw, 5);
  BagSource source(path_, {}, {2, 2});
  ASSERT_EQ(2U, source.size());
  Frame frame;
  FrameFault fault;
  ASSERT_EQ(FrameSource::Status::kFrame, source.next(frame, fault));
  EXPECT_EQ(stamp(2), frame.stamp);
  EXPECT_ERROR(BagSource(path_, {}, FrameRange{5, 1}), "no frame left");
}

TEST_F(BagSourceTest, ImagesWithoutPartnerAreLeftOut) {
  {
    BagWriter writer(path_, bagLayout("tum"), makeCamera(), BagImages::kRaw, Overwrite::kNo);
    writer.writeColor(stamp(0), color(0));
    writer.writeColor(stamp(10), color(1));
    writer.writeDepth(stamp(10) + 0.019, depth(1));
    writer.writeColor(stamp(20), color(2));
    writer.writeDepth(stamp(20) + 0.021, depth(2));
  }
  BagSource source(path_, {});
  ASSERT_EQ(1U, source.size());
  EXPECT_EQ(stamp(10), source.pairs().front().color.stamp);
  const std::map<std::string, std::size_t> expected = {
      {"color image without a partner within 20 ms", 2},
      {"depth image without a partner within 20 ms", 1}};
  EXPECT_EQ(source.leftOut(), expected);
}

TEST_F(BagSourceTest, BrokenMessagesAreSkippedWithTheReason) {
  writeBag(bagLayout("tum"), BagImages::kRaw, 1);
  {
    rosbag::Bag bag(path_, rosbag::bagmode::Append);
    sensor_msgs::Image message;
    message.header.stamp = toTime(stamp(1));
    message.width = kWidth;
    message.height = kHeight;
    message.encoding = "rgb8";
    message.step = 3 * kWidth;
    message.data.resize(10);  // truncated
    bag.write("/camera/rgb/image_color", message.header.stamp, message);
    message.encoding = "32FC1";
    message.step = 4 * kWidth;
    message.data.resize(4 * kWidth * kHeight);
    bag.write("/camera/depth/image", message.header.stamp, message);
  }
  BagSource source(path_, {});
  Frame frame;
  FrameFault fault;
  ASSERT_EQ(FrameSource::Status::kFrame, source.next(frame, fault));
  ASSERT_EQ(FrameSource::Status::kSkipped, source.next(frame, fault));
  EXPECT_NE(std::string::npos, fault.reason.find("holds 10 bytes")) << fault.text;
  EXPECT_EQ(fault.text,
            path_ + ", frame of stamp " + std::to_string(stamp(1)) + ": " + fault.reason);
  EXPECT_EQ(FrameSource::Status::kEnd, source.next(frame, fault));
}

TEST_F(BagSourceTest, DoubledStampsAreLeftOutAndTold) {
  {
    BagWriter writer(path_, bagLayout("tum"), makeCamera(), BagImages::kRaw, Overwrite::kNo);
    for (const int i : {0, 1, 1, 2}) {
      writer.writeColor(stamp(i), color(i));
      writer.writeDepth(stamp(i) + 0.001 * i, depth(i));
    }
  }
  const BagSource source(path_, {});
  EXPECT_EQ(3U, source.size());
  const std::map<std::string, std::size_t> expected = {
      {"stamp is not newer than that of the frame before", 1}};
  EXPECT_EQ(source.leftOut(), expected);
}

TEST_F(BagSourceTest, ImagesWithoutTimesAreRefused) {
  {
    BagWriter writer(path_, bagLayout("tum"), makeCamera(), BagImages::kRaw, Overwrite::kNo);
    for (int i = 0; i < 3; ++i) {
      writer.writeColor(0.0, color(i));
      writer.writeDepth(0.0, depth(i));
    }
  }
  EXPECT_ERROR(BagSource(path_, {}),
               "the images on /camera/rgb/image_color: all 3 stamps are 0.000000");
}

TEST_F(BagSourceTest, FilesThatAreNoBagsAreRefused) {
  EXPECT_ERROR(BagSource(folder_ / "nothing.bag", {}), "nothing.bag cannot be read");
  EXPECT_ERROR(BagSource(folder_.write("text.bag", "no bag"), {}), "text.bag cannot be read");
}

TEST_F(BagSourceTest, GroundTruthComesBackAndPlacesOdomInTheWorld) {
  Trajectory truth(2);
  truth[0].stamp = stamp(0) + 0.003;
  truth[0].pose.translation() << 1.0, 2.0, 3.0;
  truth[1].stamp = stamp(1);
  truth[1].pose.translation() << 1.5, 2.0, 3.0;
  {
    BagWriter writer(path_, bagLayout("openni2"), makeCamera(), BagImages::kRaw, Overwrite::kNo);
    EXPECT_TRUE(writer.writeGroundTruth(truth, stamp(0)));
    writer.writeColor(stamp(0), color(0));
    writer.writeDepth(stamp(0), depth(0));
  }
  const Trajectory read = BagSource(path_, {}).groundTruth();
  ASSERT_EQ(2U, read.size());
  EXPECT_EQ(truth[1].stamp, read[1].stamp);
  EXPECT_EQ(truth[1].pose.matrix(), read[1].pose.matrix());

  // The camera is at (1, 2, 3) and looks along the world's z: so does camera_link's x axis, and
  // odom is where camera_link is at the first image.
  rosbag::Bag bag(path_);
  rosbag::View view(bag, rosbag::TopicQuery("/tf_static"));
  bool found = false;
  for (const rosbag::MessageInstance& instance : view) {
    const auto message = instance.instantiate<tf2_msgs::TFMessage>();
    const geometry_msgs::TransformStamped& transform = message->transforms.at(0);
    if (transform.header.frame_id != "world") continue;
    found = true;
    EXPECT_EQ("odom", transform.child_frame_id);
    const Eigen::Isometry3d T = toIsometry(transform.transform);
    EXPECT_TRUE(T.translation().isApprox(Eigen::Vector3d(1, 2, 3), 1e-12));
    EXPECT_TRUE((T.linear() * Eigen::Vector3d::UnitX()).isApprox(Eigen::Vector3d::UnitZ(), 1e-12));
    EXPECT_TRUE((T.linear() * Eigen::Vector3d::UnitZ()).isApprox(-Eigen::Vector3d::UnitY(), 1e-12));
  }
  EXPECT_TRUE(found);
}

TEST_F(BagSourceTest, GroundTruthFarFromTheFirstImageDoesNotPlaceOdom) {
  Trajectory truth(1);
  truth[0].stamp = stamp(0) + 1.0;
  BagWriter writer(path_, bagLayout("openni2"), makeCamera(), BagImages::kRaw, Overwrite::kNo);
  EXPECT_FALSE(writer.writeGroundTruth(truth, stamp(0)));
}

TEST(BagWriterTest, RefusesWhatALayoutCannotHold) {
  const TemporaryFolder folder;
  SequenceCamera camera = makeCamera();
  camera.camera.distortion.k1 = 0.1;
  EXPECT_ERROR(
      BagWriter(folder / "a.bag", bagLayout("rtabmap"), camera, BagImages::kRaw, Overwrite::kNo),
      "rectified");
  const std::string existing = folder.write("b.bag", "precious");
  EXPECT_ERROR(BagWriter(existing, bagLayout("tum"), makeCamera(), BagImages::kRaw, Overwrite::kNo),
               "b.bag");
  EXPECT_EQ("precious", contentOf(existing));
  BagWriter writer(folder / "c.bag", bagLayout("tum"), makeCamera(), BagImages::kRaw,
                   Overwrite::kNo);
  EXPECT_ERROR(writer.writeColor(0.0, cv::Mat(kHeight, kWidth + 1, CV_8UC3)), "33 x 24");
  EXPECT_ERROR(writer.writeDepth(0.0, cv::Mat(kHeight, kWidth, CV_32FC1)), "16 bits");
}

}  // namespace
}  // namespace mivo
