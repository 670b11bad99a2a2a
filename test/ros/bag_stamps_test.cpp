// SPDX-License-Identifier: BSD-3-Clause
// Bags with unusual stamps or calibrations: the frames that are delivered, and the messages.
#include <gtest/gtest.h>

#include <algorithm>

#include "ros/bag_source.h"
#include "ros/expect_error.h"
#include "ros/small_bag.h"
#include "support/temporary_folder.h"

namespace mivo {
namespace {

using Counts = std::map<std::string, std::size_t>;

const char kLate[] = "stamp is not newer than that of the frame before";

class BagStampsTest : public ::testing::Test {
 protected:
  void write(const SmallBag::Change& change, int frames = 40) {
    SmallBag::write(path_, 0, frames, change);
  }
  /// The same stamps for color and depth of a frame.
  void writeStamps(const std::function<double(int)>& stamp) {
    write([&](int i, SmallBag::Messages& m) {
      m.color.header.stamp = m.depth.header.stamp = m.info.header.stamp = toTime(stamp(i));
    });
  }
  static std::vector<double> stampsOf(const BagSource& source) {
    std::vector<double> stamps;
    for (const BagSource::Pair& pair : source.pairs()) stamps.push_back(pair.color.stamp);
    return stamps;
  }

  TemporaryFolder folder_;
  std::string path_ = folder_ / "test.bag";
};

TEST_F(BagStampsTest, ZerosBeforeTheClockIsSetAreLeftOut) {
  writeStamps([](int i) { return i < 5 ? 0.0 : SmallBag::stamp(i); });
  const BagSource source(path_, {});
  EXPECT_EQ(source.size(), 35U);
  EXPECT_EQ(stampsOf(source).front(), SmallBag::stamp(5));
  EXPECT_EQ(source.leftOut(), (Counts{{"stamp is zero", 5}}));
}

TEST_F(BagStampsTest, ZerosAloneAreNoTime) {
  writeStamps([](int) { return 0.0; });
  EXPECT_ERROR(BagSource(path_, {}), "all 40 stamps are 0.000000");
}

TEST_F(BagStampsTest, AlternatingStampsGiveTheLaterClock) {
  writeStamps([](int i) { return SmallBag::stamp(i) - (i % 2 == 1 ? 3.0 : 0.0); });
  const BagSource source(path_, {});
  std::vector<double> expected;
  for (int i = 0; i < 40; i += 2) expected.push_back(SmallBag::stamp(i));
  EXPECT_EQ(stampsOf(source), expected);
  EXPECT_EQ(source.leftOut(), (Counts{{kLate, 20}}));
}

TEST_F(BagStampsTest, DoubledStampsGiveTheFirst) {
  writeStamps([](int i) { return SmallBag::stamp(i / 2 * 2); });
  const BagSource source(path_, {});
  EXPECT_EQ(source.size(), 20U);
  EXPECT_EQ(source.leftOut(), (Counts{{kLate, 20}}));
}

TEST_F(BagStampsTest, ASingleStampInTheFutureIsLeftOut) {
  writeStamps([](int i) { return SmallBag::stamp(i) + (i == 20 ? 1e6 : 0.0); });
  const BagSource source(path_, {});
  EXPECT_EQ(source.size(), 39U);
  EXPECT_EQ(source.leftOut(),
            (Counts{{"stamp is far ahead of the frames before and after it", 1}}));
}

TEST_F(BagStampsTest, TimeSetBackBeginsOneNewTime) {
  writeStamps([](int i) { return SmallBag::stamp(i < 20 ? i : i - 20); });
  BagSource source(path_, {});
  EXPECT_EQ(source.size(), 36U);  // four are skipped until the jump is confirmed
  Frame frame;
  FrameFault fault;
  int new_times = 0;
  while (source.next(frame, fault) == FrameSource::Status::kFrame) {
    if (!source.startsAnew()) continue;
    ++new_times;
    EXPECT_EQ(frame.stamp, SmallBag::stamp(4));
  }
  EXPECT_EQ(new_times, 1);
}

TEST_F(BagStampsTest, ARecordingInAnotherOrderIsSorted) {
  write([](int i, SmallBag::Messages& m) { m.recorded = toTime(SmallBag::stamp(100 - i)); });
  const BagSource reversed(path_, {});
  EXPECT_EQ(reversed.size(), 40U);
  write([](int i, SmallBag::Messages& m) {  // in blocks of a second and more
    m.recorded = toTime(SmallBag::stamp(i * 7 % 40));
    for (sensor_msgs::Image* image : {&m.color, &m.depth}) {
      image->header.stamp = toTime(SmallBag::kFirst + 2.0 * i);
    }
  });
  const BagSource shuffled(path_, {});
  EXPECT_EQ(shuffled.size(), 40U);
  EXPECT_EQ(shuffled.notice(),
            "the images were recorded in another order than that of their stamps, and are sorted");
  EXPECT_TRUE(std::is_sorted(shuffled.pairs().begin(), shuffled.pairs().end(),
                             [](const BagSource::Pair& a, const BagSource::Pair& b) {
                               return a.color.stamp < b.color.stamp;
                             }));
}

TEST_F(BagStampsTest, ClocksApartArePairedNeverAndTheOffsetIsTold) {
  write([](int i, SmallBag::Messages& m) {
    m.depth.header.stamp = toTime(SmallBag::stamp(i) + 0.7);
  });
  EXPECT_ERROR(BagSource(path_, {}),
               "color and depth that come together are stamped 0.7 s apart (depth later): two "
               "clocks");
  // Without a partner at all.
  write([](int i, SmallBag::Messages& m) {
    m.depth.header.stamp = toTime(SmallBag::stamp(i) + 2.0);
  });
  EXPECT_ERROR(BagSource(path_, {}), "depth that comes with a color image is stamped 2.0");
}

TEST_F(BagStampsTest, AnOffsetWithinPairsIsTold) {
  write([](int i, SmallBag::Messages& m) {
    m.depth.header.stamp = toTime(SmallBag::stamp(i) + 0.015);
  });
  EXPECT_EQ(BagSource(path_, {}).notice(),
            "depth is stamped 15.0 ms later than the color images that it is paired with");
}

TEST_F(BagStampsTest, ALeadingCalibrationOfZerosIsPassedOver) {
  write([](int i, SmallBag::Messages& m) {
    if (i < 3) m.info.K.fill(0.0);
    if (i < 3) m.info.P.fill(0.0);
  });
  EXPECT_EQ(BagSource(path_, {}).camera().fx, 30.0);
  write([](int, SmallBag::Messages& m) {
    m.info.K.fill(0.0);
    m.info.P.fill(0.0);
  });
  EXPECT_ERROR(BagSource(path_, {}), "camera_info is not calibrated: all messages on /camera/rgb/");
}

TEST_F(BagStampsTest, ACalibrationOfAnotherSizeIsTold) {
  write([](int, SmallBag::Messages& m) { m.info.K = {15.0, 0, 7.5, 0, 15.0, 5.5, 0, 0, 1}; });
  EXPECT_NE(BagSource(path_, {}).notice().find("is the calibration for images of 16 x 12 pixels?"),
            std::string::npos);
}

TEST_F(BagStampsTest, ACalibrationChangesOnlyWhenItDoes) {
  const auto camerasOf = [&] {
    BagSource source(path_, {});
    std::vector<double> cameras = {source.camera().fx};
    Frame frame;
    FrameFault fault;
    while (source.next(frame, fault) == FrameSource::Status::kFrame) {
      if (source.camera().fx != cameras.back()) cameras.push_back(source.camera().fx);
    }
    return cameras;
  };
  write([](int i, SmallBag::Messages& m) { m.info.K[0] = 30.0 + 1e-9 * (i % 2); });
  EXPECT_EQ(camerasOf(), std::vector<double>{30.0});
  write([](int i, SmallBag::Messages& m) { m.info.K[0] = i < 20 ? 30.0 : 31.0; });
  EXPECT_EQ(camerasOf(), (std::vector<double>{30.0, 31.0}));
}

TEST_F(BagStampsTest, ACalibrationWithoutASizeIsThatOfTheImages) {
  write([](int, SmallBag::Messages& m) { m.info.width = m.info.height = 0; });
  BagSource source(path_, {});
  EXPECT_EQ(source.camera().width, 32);
}

}  // namespace
}  // namespace mivo
