// SPDX-License-Identifier: BSD-3-Clause
#include "session/stamp_pairer.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>

namespace mivo {
namespace {

constexpr ImageStream kC = ImageStream::kColor;
constexpr ImageStream kD = ImageStream::kDepth;

/// Stamps in whole milliseconds. The log has "(c,d)" for pairs and "c" or "d" for images without
/// partner, in the order of output.
class StampPairerTest : public ::testing::Test {
 protected:
  void setUp(const PairingOptions& options) {
    pairer_ = std::make_unique<StampPairer<std::unique_ptr<int>>>(
        options,
        [this](std::unique_ptr<int>& c, std::unique_ptr<int>& d) {
          log_ += '(' + std::to_string(*c) + ',' + std::to_string(*d) + ')';
        },
        [this](ImageStream stream, std::unique_ptr<int>& item) {
          log_ += (stream == kC ? 'c' : 'd') + std::to_string(*item);
        });
  }

  void push(ImageStream stream, int milliseconds) {
    pairer_->push(stream, 0.001 * milliseconds, std::make_unique<int>(milliseconds));
  }

  std::string log_;
  std::unique_ptr<StampPairer<std::unique_ptr<int>>> pairer_;  // move only: nothing may copy them
};

TEST_F(StampPairerTest, EqualStampsArePairedAtOnce) {
  setUp({});
  push(kC, 0);
  push(kD, 0);
  EXPECT_EQ(log_, "(0,0)");
  push(kD, 33);
  push(kC, 33);
  EXPECT_EQ(log_, "(0,0)(33,33)");
}

TEST_F(StampPairerTest, APairWaitsUntilNoImageToComeCanFitBetter) {
  setUp({});
  push(kC, 0);
  push(kD, 10);
  EXPECT_EQ(log_, "");  // the next color image could have the stamp 10
  push(kC, 19);
  EXPECT_EQ(log_, "");  // it is nearer, and the next depth could be nearer still
  push(kD, 27);
  EXPECT_EQ(log_, "");  // nearer to 19, and 10 would go to 0; but the next color may be at 20
  push(kC, 40);
  EXPECT_EQ(log_, "(0,10)(19,27)");
}

TEST_F(StampPairerTest, AKnownPeriodMakesWaitingNeedless) {
  PairingOptions options;
  options.min_gap = 0.030;
  setUp(options);
  push(kC, 0);
  push(kD, 10);
  EXPECT_EQ(log_, "(0,10)");
  push(kD, 43);
  push(kC, 50);
  EXPECT_EQ(log_, "(0,10)(50,43)");
}

TEST_F(StampPairerTest, ThePeriodIsLearned) {
  PairingOptions options;
  options.learns_gap = true;
  setUp(options);
  for (int i = 0; i < 11; ++i) {
    push(kC, 33 * i);
    push(kD, 33 * i + 12);
  }
  log_.clear();
  push(kC, 363);
  push(kD, 375);
  EXPECT_EQ(log_, "(363,375)");
}

TEST_F(StampPairerTest, WithoutPartnerOnceNoneCanCome) {
  setUp({});
  push(kC, 0);
  push(kC, 33);
  push(kD, 20);
  EXPECT_EQ(log_, "");  // 0 and 20 are 20 ms apart, the limit, and 33 is nearer
  push(kD, 40);
  EXPECT_EQ(log_, "");
  push(kC, 66);  // 33 and 40 are a pair: 20 goes to 0
  EXPECT_EQ(log_, "(0,20)(33,40)");
  push(kD, 87);
  EXPECT_EQ(log_, "(0,20)(33,40)c66");
}

TEST_F(StampPairerTest, TheLimitIsInclusive) {
  PairingOptions options;
  options.max_difference = 0.25;
  options.min_gap = 1.0;
  setUp(options);
  push(kC, 0);
  push(kD, 250);
  EXPECT_EQ(log_, "(0,250)");
  push(kC, 2000);
  push(kD, 2251);
  EXPECT_EQ(log_, "(0,250)c2000d2251");
}

TEST_F(StampPairerTest, ASilentPartnerHoldsBackNoMoreThanTheCapacity) {
  PairingOptions options;
  options.capacity = 3;
  setUp(options);
  for (int i = 0; i < 5; ++i) push(kC, 33 * i);
  EXPECT_EQ(log_, "c0c33");
  EXPECT_EQ(pairer_->numWaiting(kC), 3U);
  push(kD, 100);  // late, but the nearest is still waiting
  pairer_->flush();
  EXPECT_EQ(log_, "c0c33c66(99,100)c132");
  EXPECT_EQ(pairer_->numWaiting(kC), 0U);
}

TEST_F(StampPairerTest, ImagesFromBeforeAJumpOfTimeGoOut) {
  setUp({});
  push(kC, 9000);
  push(kD, 9005);
  push(kC, 0);
  EXPECT_EQ(log_, "(9000,9005)");
  push(kD, 0);
  EXPECT_EQ(log_, "(9000,9005)(0,0)");
}

TEST_F(StampPairerTest, ADeviceClockMayNotGoBackAtAll) {
  PairingOptions options;
  options.time_jump = 0.0;
  setUp(options);
  push(kC, 90);
  push(kC, 57);
  EXPECT_EQ(log_, "c90");
  push(kD, 57);
  EXPECT_EQ(log_, "c90(57,57)");
}

TEST_F(StampPairerTest, ALateImageIsTakenWhereItBelongs) {
  setUp({});
  push(kC, 0);
  push(kC, 66);
  push(kC, 33);
  push(kD, 0);
  push(kD, 33);
  push(kD, 66);
  EXPECT_EQ(log_, "(0,0)(33,33)(66,66)");
}

TEST_F(StampPairerTest, ARecordingPlayedBackwardsIsPaired) {
  for (const bool learns_gap : {false, true}) {
    PairingOptions options;
    options.learns_gap = learns_gap;
    setUp(options);
    for (int i = 0; i < 12; ++i) {
      push(kC, 33 * i);
      push(kD, 33 * i);
    }
    log_.clear();
    for (int i = 3; i > 0; --i) {
      push(kC, 33 * i);
      push(kD, 33 * i);
    }
    EXPECT_EQ(log_, "(99,99)(66,66)(33,33)");
  }
}

TEST_F(StampPairerTest, PairsDoNotCross) {
  setUp({});
  for (const int stamp : {0, 10}) push(kC, stamp);
  for (const int stamp : {12, 14}) push(kD, stamp);
  pairer_->flush();
  EXPECT_EQ(log_, "c0(10,12)d14");
}

}  // namespace
}  // namespace mivo
