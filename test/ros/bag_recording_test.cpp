// SPDX-License-Identifier: BSD-3-Clause
// A bag of a real recording gives the bits of its folder.
#include <utility>

#include "programs/recording.h"

namespace mivo {
namespace {

class BagRecordingTest : public RecordingTest, public ::testing::WithParamInterface<const char*> {};

TEST_P(BagRecordingTest, BagAndFolderGiveTheSameBits) {
  const std::string sequence = recording(GetParam());
  const std::string bag = folder_ / "recording.bag";
  const std::string of_folder = folder_ / "folder.txt";
  const std::string of_bag = folder_ / "bag.txt";
  for (const auto& [program, arguments] : {
           std::pair("sequence_to_bag", std::vector<std::string>{sequence, bag}),
           std::pair("run_bag", std::vector<std::string>{bag, "--output", of_bag}),
           std::pair("run_sequence", std::vector<std::string>{sequence, "--output", of_folder}),
       }) {
    const ProcessResult result = run(program, arguments);
    ASSERT_EQ(0, result.exit_code) << program << ": " << result.errors;
  }
  const std::string expected = contentOf(of_folder);
  EXPECT_FALSE(expected.empty());
  EXPECT_TRUE(expected == contentOf(of_bag));
}

INSTANTIATE_TEST_SUITE_P(Recordings, BagRecordingTest,
                         ::testing::Values("tum_fr1_rpy_first240", "sun3d_xtion_fragA"));

}  // namespace
}  // namespace mivo
