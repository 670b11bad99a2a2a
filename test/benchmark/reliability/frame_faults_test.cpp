// SPDX-License-Identifier: BSD-3-Clause
#include "frame_faults.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

#include "support/error_text.h"

namespace mivo {
namespace {

/// Frame i: gray of i everywhere, 1 m + i mm away, at i seconds.
Delivery delivery(std::size_t i) {
  Delivery result;
  result.index = i;
  result.camera = {8, 6, 10.0, 10.0, 3.5, 2.5, {}};
  result.frame.stamp = 10000.0 + static_cast<double>(i);
  result.frame.image = cv::Mat(6, 8, CV_8UC1, cv::Scalar(static_cast<double>(i)));
  result.frame.depth = cv::Mat(6, 8, CV_16UC1, cv::Scalar(1000.0 + static_cast<double>(i)));
  return result;
}

/// What comes out for `count` frames, the late ones included.
std::vector<Delivery> passed(const std::string& fault, double rate, std::size_t count,
                             std::uint32_t seed = 1) {
  FrameFaults faults(fault, rate, seed);
  std::vector<Delivery> all;
  for (std::size_t i = 0; i < count; ++i) {
    for (const Delivery& out : faults.pass(delivery(i))) all.push_back(out);
  }
  for (const Delivery& out : faults.end()) all.push_back(out);
  return all;
}

std::vector<std::size_t> indices(const std::vector<Delivery>& deliveries) {
  std::vector<std::size_t> result;
  for (const Delivery& one : deliveries) result.push_back(one.index);
  return result;
}

using Indices = std::vector<std::size_t>;

TEST(FrameFaultsTest, NothingHappensAtRateZero) {
  for (const std::string& name : FrameFaults::names()) {
    const std::vector<Delivery> out = passed(name, 0.0, 5);
    ASSERT_EQ(indices(out), (Indices{0, 1, 2, 3, 4})) << name;
    EXPECT_EQ(out[3].frame.stamp, 10003.0) << name;
    EXPECT_EQ(out[3].frame.image.at<std::uint8_t>(2, 2), 3) << name;
    EXPECT_EQ(out[3].frame.depth.at<std::uint16_t>(2, 2), 1003) << name;
  }
}

TEST(FrameFaultsTest, OrderAndNumber) {
  EXPECT_EQ(indices(passed("dropped", 1.0, 3)), Indices{});
  EXPECT_EQ(indices(passed("duplicated", 1.0, 2)), (Indices{0, 0, 1, 1}));
  EXPECT_EQ(indices(passed("reordered", 1.0, 5)), (Indices{1, 0, 3, 2, 4}));
  FrameFaults burst("burst after a pause", 1.0, 1);
  for (std::size_t i = 0; i < 14; ++i) EXPECT_TRUE(burst.pass(delivery(i)).empty());
  const std::vector<Delivery> all = burst.pass(delivery(14));
  ASSERT_EQ(all.size(), 15U);
  EXPECT_EQ(all.front().index, 0U);
  EXPECT_EQ(all.back().index, 14U);
}

TEST(FrameFaultsTest, SeedsDecideWhichFramesAreHit) {
  const Indices first = indices(passed("dropped", 0.5, 100, 1));
  EXPECT_EQ(first, indices(passed("dropped", 0.5, 100, 1)));
  EXPECT_NE(first, indices(passed("dropped", 0.5, 100, 2)));
  EXPECT_GT(first.size(), 30U);
  EXPECT_LT(first.size(), 70U);
}

TEST(FrameFaultsTest, Stamps) {
  EXPECT_EQ(passed("stamp an hour ahead", 1.0, 1)[0].frame.stamp, 13600.0);
  EXPECT_EQ(passed("stamp five seconds back", 1.0, 1)[0].frame.stamp, 9995.0);
  EXPECT_EQ(passed("stamp of zero", 1.0, 1)[0].frame.stamp, 0.0);
  EXPECT_TRUE(std::isnan(passed("NaN as stamp", 1.0, 1)[0].frame.stamp));
}

TEST(FrameFaultsTest, Images) {
  EXPECT_EQ(passed("saturated image", 1.0, 1)[0].frame.image.at<std::uint8_t>(2, 2), 255);
  EXPECT_EQ(passed("black image", 1.0, 2)[1].frame.image.at<std::uint8_t>(2, 2), 0);
  const std::vector<Delivery> frozen = passed("frozen image", 1.0, 3);
  EXPECT_EQ(frozen[2].frame.image.at<std::uint8_t>(2, 2), 0);
  EXPECT_EQ(frozen[2].index, 0U);
  EXPECT_EQ(frozen[2].frame.depth.at<std::uint16_t>(2, 2), 1002);
  EXPECT_EQ(passed("cropped images", 1.0, 1)[0].frame.depth.size(), cv::Size(4, 3));
  EXPECT_NE(passed("truncated", 1.0, 1)[0].frame.image.size(),
            passed("truncated", 1.0, 1)[0].frame.depth.size());
  // The second frame is written into the memory of the first.
  EXPECT_EQ(passed("overwritten after publishing", 1.0, 2)[0].frame.image.at<std::uint8_t>(2, 2),
            1);
}

TEST(FrameFaultsTest, Depth) {
  const auto last = [](const std::string& fault) {
    return passed(fault, 1.0, 1)[0].frame.depth.at<float>(5, 7);
  };
  EXPECT_TRUE(std::isnan(last("NaN as depth")));
  EXPECT_TRUE(std::isinf(last("infinite depth")));
  EXPECT_EQ(last("negative depth"), -1.0F);
  EXPECT_EQ(last("zero depth"), 0.0F);
  EXPECT_EQ(passed("depth of another frame", 1.0, 3)[2].frame.depth.at<std::uint16_t>(2, 2), 1000);
}

TEST(FrameFaultsTest, Calibration) {
  EXPECT_EQ(passed("calibration without focal length", 1.0, 1)[0].camera.fx, 0.0);
  EXPECT_EQ(passed("another camera's calibration", 1.0, 1)[0].camera.fx, 13.0);
}

TEST(FrameFaultsTest, UnknownOnesAreRefused) {
  EXPECT_EQ(errorText([] { FrameFaults("plague", 1.0, 1); }), "there is no fault 'plague'");
}

}  // namespace
}  // namespace mivo
