// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "io/depth_coding.h"
#include "mivo/io/camera_file.h"

namespace mivo {

/// A frame of a sequence folder: where its images lie and their stamps (s), of which that of color
/// is the frame's.
struct ListedFrame {
  double stamp;
  std::string image_path;
  double depth_stamp;
  std::string depth_path;
};

/// What a sequence folder holds, however it is laid out.
struct SequenceListing {
  std::vector<ListedFrame> frames;  ///< in the order of their stamps, each stamp once
  SequenceCamera camera;            ///< a width of 0: that of the images
  std::string camera_file;          ///< where the camera comes from, in a few words
  DepthCoding depth_coding = DepthCoding::kPlain;
  /// The color images show what the depth images show, at another size: they are reduced to it.
  bool is_color_reduced = false;
  std::vector<std::string> notices;             ///< what was assumed or put right
  std::map<std::string, std::size_t> left_out;  ///< images that became no frame, by the reason
};

/// Lists a folder in one of the layouts of doc/file_formats.md, which is recognized by its files.
/// Throws Error when it is none, or one of its files is missing or malformed.
SequenceListing listSequence(const std::string& folder);

}  // namespace mivo
