// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "ros/recording.h"
#include "session/stamp_pairer.h"

namespace mivo {

/// One image message of a recording.
struct BagImage {
  double stamp;  ///< s, of its header
  RecordedMessage recorded;
};

/// The same, of one of the two streams.
struct StreamedImage {
  ImageStream stream;
  BagImage image;
};

struct BagPair {
  BagImage color;
  BagImage depth;
  bool is_new_time = false;  ///< time was set back before it
};

struct BagPairs {
  std::vector<BagPair> pairs;
  std::map<std::string, std::size_t> left_out;  ///< images and pairs, by the reason
  bool is_sorted_anew = false;                  ///< the order of the recording was not believed
};

/// Pairs of images in the order in which they were recorded, as the node makes them of the same
/// messages (StampPairer, FrameOrder). Where that order contradicts most stamps, the images are
/// sorted by their stamps first.
BagPairs pairImages(const std::vector<StreamedImage>& images);

}  // namespace mivo
