// SPDX-License-Identifier: BSD-3-Clause
#include "image_pair.h"

#include <algorithm>

#include "mivo/core/error.h"
#include "mivo/io/sequence_reader.h"
#include "true_poses.h"

namespace mivo {
namespace {

constexpr double kMaxTimeDifference = 1e-4;  // s: the truth of a synthetic sequence is per frame

/// Frames of a folder with their true poses, read in order.
class TrueSequence {
 public:
  explicit TrueSequence(const std::string& folder)
      : folder_(folder), reader_(folder), truth_(folder + "/groundtruth.txt", kMaxTimeDifference) {}

  const SequenceReader& reader() const { return reader_; }

  /// Frame number `index`; indices must grow from call to call.
  Frame read(std::size_t index) {
    Frame frame;
    FrameFault fault;
    for (; next_ <= index; ++next_) {
      const auto status = reader_.next(frame, fault);
      if (status == FrameSource::Status::kEnd) throw Error(folder_ + " has too few frames");
      if (status == FrameSource::Status::kSkipped) throw Error(fault.text);
    }
    return frame;
  }

  const Eigen::Isometry3d& pose(double stamp) const { return truth_.at(stamp); }

 private:
  std::string folder_;
  SequenceReader reader_;
  TruePoses truth_;
  std::size_t next_ = 0;
};

}  // namespace

ImagePairs loadPairs(const PairOptions& options, const Parameters& parameters) {
  TrueSequence reference(options.reference_folder);
  TrueSequence live(options.live_folder);
  ImagePairs result;
  result.camera = reference.reader().camera();
  if (result.camera != live.reader().camera()) {
    throw Error(options.live_folder + " was filmed by another camera than " +
                options.reference_folder);
  }
  const std::size_t frames = std::min(reference.reader().size(), live.reader().size());
  if (options.count == 0 || frames < options.count + options.gap) {
    throw Error(options.reference_folder + " is too short for " + std::to_string(options.count) +
                " pairs");
  }
  const std::size_t spacing = (frames - options.gap) / options.count;
  result.pairs.resize(options.count);
  for (std::size_t i = 0; i < options.count; ++i) {
    ImagePair& pair = result.pairs[i];
    const Frame reference_frame = reference.read(i * spacing);
    const Frame live_frame = live.read(i * spacing + options.gap);
    FramePyramid pyramid;
    pyramid.build(reference_frame, parameters);
    pair.keyframe.build(pyramid, result.camera, Vector6::Zero(), {}, parameters);
    pair.live.build(live_frame, parameters);
    pair.T_live_ref = live.pose(live_frame.stamp).inverse() * reference.pose(reference_frame.stamp);
  }
  return result;
}

}  // namespace mivo
