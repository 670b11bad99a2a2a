// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "io/depth_account.h"
#include "ros/image_message.h"
#include "ros/node_parameters.h"
#include "ros/transform_source.h"

namespace mivo {

/// Warns, once each, of implausible messages and transforms that do not prevent tracking.
class InputWarnings {
 public:
  explicit InputWarnings(const NodeParameters& parameters) : parameters_(parameters) {}

  /// Checks frame names and stamps. Call it before publishing, because tf then contains our own
  /// transform as well.
  void lookAtFrames(const ImagePair& pair, TransformSource& transforms);
  void lookAtDepth(const Frame& frame, const DepthParameters& parameters);
  void lookAtCamera(const Camera& camera);

 private:
  void lookAtClock(double age);
  void lookAtOffset(double offset);
  void lookAtParent(TransformSource& transforms);

  const NodeParameters& parameters_;
  int frames_off_clock_ = 0;  // in a row
  bool has_warned_of_clock_ = false;
  bool has_warned_of_frames_ = false;
  DepthAccount depth_;                // of the first frames
  std::vector<double> pair_offsets_;  // s, of the first pairs: depth later than color
  bool has_warned_of_camera_ = false;
  bool has_warned_of_parent_ = false;
};

}  // namespace mivo
