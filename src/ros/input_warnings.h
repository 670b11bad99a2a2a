// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "ros/image_message.h"
#include "ros/node_parameters.h"
#include "ros/transform_source.h"
#include "session/depth_sample.h"

namespace mivo {

/// Says, each once, what in the messages and in tf cannot be right though it can be tracked.
class InputWarnings {
 public:
  explicit InputWarnings(const NodeParameters& parameters) : parameters_(parameters) {}

  /// Frame names and stamps; to be asked before anything is published, for tf then has our
  /// transform too.
  void lookAtFrames(const ImagePair& pair, TransformSource& transforms);
  void lookAtDepth(const DepthSample& depth);
  void lookAtCamera(const Camera& camera);

 private:
  void lookAtClock(double age);
  void lookAtParent(TransformSource& transforms);

  const NodeParameters& parameters_;
  int frames_off_clock_ = 0;  // in a row
  bool has_warned_of_clock_ = false;
  bool has_warned_of_frames_ = false;
  bool has_warned_of_depth_ = false;
  bool has_warned_of_camera_ = false;
  bool has_warned_of_parent_ = false;
};

}  // namespace mivo
