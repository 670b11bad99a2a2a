// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "core/images/frame_pyramid.h"
#include "core/keyframe/keyframe.h"
#include "mivo/core/camera.h"
#include "mivo/core/parameters.h"

namespace mivo {

/// A keyframe, a live frame, and the true pose between them.
struct ImagePair {
  Keyframe keyframe;
  FramePyramid live;
  Eigen::Isometry3d T_live_ref = Eigen::Isometry3d::Identity();
};

struct PairOptions {
  std::string reference_folder;  ///< sequence with groundtruth.txt
  std::string live_folder;       ///< the same sequence in other light, or the same folder
  std::size_t count = 10;        ///< pairs, spread evenly over the sequence
  std::size_t gap = 3;           ///< frames from keyframe to live frame
};

/// The pairs and the camera of both.
struct ImagePairs {
  Camera camera;
  std::vector<ImagePair> pairs;
};

/// Throws Error when a sequence cannot be read, is too short, has no truth for a frame, or when the
/// cameras of the two differ.
ImagePairs loadPairs(const PairOptions& options, const Parameters& parameters);

}  // namespace mivo
