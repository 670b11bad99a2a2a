// SPDX-License-Identifier: BSD-3-Clause
// Recordings that are split, cut off, damaged, or of another kind.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "ros/bag_source.h"
#include "ros/expect_error.h"
#include "ros/recording.h"
#include "ros/small_bag.h"
#include "ros/whole_copy.h"
#include "support/temporary_folder.h"

namespace mivo {
namespace {

class RecordingTest : public ::testing::Test {
 protected:
  /// Stamps of the frames that a source delivers.
  static std::vector<double> framesOf(BagSource& source) {
    std::vector<double> stamps;
    Frame frame;
    FrameFault fault;
    for (auto status = source.next(frame, fault); status != FrameSource::Status::kEnd;
         status = source.next(frame, fault)) {
      if (status == FrameSource::Status::kFrame) stamps.push_back(frame.stamp);
    }
    return stamps;
  }

  static std::vector<double> stamps(int first, int end) {
    std::vector<double> stamps;
    for (int i = first; i < end; ++i) stamps.push_back(SmallBag::stamp(i));
    return stamps;
  }

  std::string write(const std::string& name, rosbag::CompressionType compression) {
    const std::string path = folder_ / name;
    SmallBag::write(
        path, 0, kFrames, [](int, SmallBag::Messages&) {}, compression);
    return path;
  }

  static constexpr int kFrames = 20;
  TemporaryFolder folder_;
};

TEST_F(RecordingTest, SplitBagsAreOne) {
  SmallBag::write(folder_ / "a_0.bag", 0, 10);
  SmallBag::write(folder_ / "a_1.bag", 10, 15, [](int, SmallBag::Messages& m) {
    m.has_info = false;  // none in the second part
  });
  SmallBag::write(folder_ / "a_2.bag", 15, 20);
  // In any order: parts are sorted by their recording time.
  BagSource source({folder_ / "a_2.bag", folder_ / "a_0.bag", folder_ / "a_1.bag"}, {});
  EXPECT_EQ(framesOf(source), stamps(0, 20));
  EXPECT_EQ(source.notice(), "");
}

TEST_F(RecordingTest, ACutOffBagGivesWhatIsThereAndNamesReindex) {
  for (const auto compression :
       {rosbag::compression::Uncompressed, rosbag::compression::BZ2, rosbag::compression::LZ4}) {
    const std::string bytes = contentOf(write("whole.bag", compression));
    const std::string path = folder_.write("half.bag", bytes.substr(0, bytes.size() / 2));
    BagSource source(path, {});
    const std::vector<double> frames = framesOf(source);
    EXPECT_GE(frames.size(), 6U);
    EXPECT_LT(frames.size(), static_cast<std::size_t>(kFrames));
    EXPECT_EQ(frames, stamps(0, static_cast<int>(frames.size())));
    EXPECT_EQ(source.notice(),
              path +
                  ": its index is damaged or missing, its end is missing; what is whole is used "
                  "(rosbag reindex " +
                  path + " mends the file)");
  }
}

TEST_F(RecordingTest, OfTheIndexAloneNothingIsLost) {
  const std::string bytes = contentOf(write("whole.bag", rosbag::compression::LZ4));
  BagSource source(folder_.write("cut.bag", bytes.substr(0, bytes.size() - 100)), {});
  EXPECT_EQ(framesOf(source), stamps(0, kFrames));
}

TEST_F(RecordingTest, ADamagedChunkCostsItsFramesOnly) {
  for (const auto compression : {rosbag::compression::BZ2, rosbag::compression::LZ4}) {
    std::string bytes = contentOf(write("whole.bag", compression));
    for (std::size_t i = 0; i < 8; ++i) bytes[bytes.size() / 2 + i] ^= '\xff';
    BagSource source(folder_.write("damaged.bag", bytes), {});
    const std::vector<double> frames = framesOf(source);
    EXPECT_GE(frames.size(), kFrames - 4U);
    EXPECT_LT(frames.size(), static_cast<std::size_t>(kFrames));
    EXPECT_EQ(frames.front(), SmallBag::stamp(0));
    EXPECT_EQ(frames.back(), SmallBag::stamp(kFrames - 1));
    EXPECT_NE(source.notice().find("1 of its parts are damaged"), std::string::npos)
        << source.notice();
  }
}

TEST_F(RecordingTest, AHoleInAnUncompressedBagCostsItsFramesOnly) {
  std::string bytes = contentOf(write("whole.bag", rosbag::compression::Uncompressed));
  std::fill_n(bytes.begin() + static_cast<std::ptrdiff_t>(bytes.size() / 2), 6000, '\0');
  BagSource source(folder_.write("hole.bag", bytes), {});
  const std::vector<double> frames = framesOf(source);
  EXPECT_GE(frames.size(), kFrames - 6U);
  EXPECT_LT(frames.size(), static_cast<std::size_t>(kFrames));
  EXPECT_EQ(frames.back(), SmallBag::stamp(kFrames - 1));
}

TEST_F(RecordingTest, TheCopyForPlayingHasTheSameFrames) {
  std::string bytes = contentOf(write("whole.bag", rosbag::compression::LZ4));
  const std::string half = folder_.write("half.bag", bytes.substr(0, bytes.size() / 2));
  for (std::size_t i = 0; i < 8; ++i) bytes[bytes.size() / 2 + i] ^= '\xff';
  const std::string damaged = folder_.write("damaged.bag", bytes);
  for (const std::string& path : {half, damaged}) {
    const std::string copy = folder_ / "copy.bag";
    BagSource source(path, {});
    EXPECT_EQ(copyWhenDamaged({path}, copy), source.notice());
    BagSource copied(copy, {});
    EXPECT_EQ(copied.notice(), "");
    EXPECT_EQ(framesOf(copied), framesOf(source));
  }
}

TEST_F(RecordingTest, ASoundBagIsNotCopied) {
  const std::string path = write("whole.bag", rosbag::compression::BZ2);
  EXPECT_EQ(copyWhenDamaged({path}, folder_ / "copy.bag"), "");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "copy.bag"));
}

TEST_F(RecordingTest, NoBytesAreReadAsABag) {
  const std::string bytes = contentOf(write("whole.bag", rosbag::compression::LZ4));
  for (const std::size_t size : {0U, 5U, 13U, 20U, 4000U}) {
    const std::string path = folder_.write("short.bag", bytes.substr(0, size));
    EXPECT_ERROR(BagSource(path, {}), "short.bag cannot be read as a bag: ");
  }
}

TEST_F(RecordingTest, OtherFormatsAreNamed) {
  const auto expect = [&](const std::string& path, const std::string& what) {
    EXPECT_ERROR(Recording({path}), path + " cannot be read as a bag: it " + what);
  };
  expect(folder_.write("x.db3", "SQLite format 3\0 and more"), "is a recording of ROS 2 (SQLite)");
  expect(folder_.write("x.mcap", "\x89MCAP0\r\n"), "is a recording of ROS 2 (MCAP)");
  folder_.write("ros2/metadata.yaml", "rosbag2_bagfile_information:\n");
  expect(folder_ / "ros2", "is a recording of ROS 2 (a folder): convert it first");
  folder_.write("images/rgb.txt", "");
  expect(folder_ / "images", "is a folder; name the bags themselves");
  expect(folder_.write("old.bag", "#ROSBAG V1.2\n"), "is a bag of an old version: rosbag fix");
  expect(folder_.write("older.bag", "#ROSRECORD V1.1\n"), "is a bag of an old version");
  expect(folder_.write("text.bag", "hello world\n"), "is no bag");
  expect(folder_.write("empty.bag", ""), "is empty");
  EXPECT_ERROR(Recording({folder_ / "nothing.bag"}), "nothing.bag cannot be read: No such file");
}

}  // namespace
}  // namespace mivo
