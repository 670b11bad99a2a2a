// SPDX-License-Identifier: BSD-3-Clause
#include "ros/bag_pairs.h"

#include <limits>

#include "session/frame_order.h"
#include "session/stamp_order.h"

namespace mivo {
namespace {

std::string withoutPartner(ImageStream stream) {
  return std::string(stream == ImageStream::kColor ? "color" : "depth") +
         " image without a partner within 20 ms";
}

void leaveOut(const std::string& reason, std::size_t count, BagPairs& result) {
  if (count > 0) result.left_out[reason] += count;
}

/// @param dropped  pairs of no time
BagPairs pairAsRecorded(const std::vector<StreamedImage>& images, std::size_t& dropped) {
  BagPairs result;
  FrameOrder<BagPair> order(
      [&](BagPair& pair, bool is_new_time) {
        result.pairs.push_back(pair);
        result.pairs.back().is_new_time = is_new_time;
      },
      [&](BagPair&, StampFault fault) {
        ++dropped;
        leaveOut(describe(fault), 1, result);
      });
  PairingOptions options;
  options.capacity = std::numeric_limits<std::size_t>::max();
  StampPairer<BagImage> pairer(
      options,
      [&](BagImage& color, BagImage& depth) {
        order.push(color.stamp, {color, depth});
      },
      [&](ImageStream stream, BagImage&) { leaveOut(withoutPartner(stream), 1, result); });
  for (const StreamedImage& image : images) {
    pairer.push(image.stream, image.image.stamp, image.image);
  }
  pairer.flush();
  order.flush();
  return result;
}

std::vector<double> stampsOf(const std::vector<BagImage>& images) {
  std::vector<double> stamps;
  for (const BagImage& image : images) stamps.push_back(image.stamp);
  return stamps;
}

BagPairs pairSorted(const std::vector<StreamedImage>& images) {
  BagPairs result;
  result.is_sorted_anew = true;
  std::vector<BagImage> streams[2];
  for (const StreamedImage& image : images) {
    streams[static_cast<std::size_t>(image.stream)].push_back(image.image);
  }
  for (std::vector<BagImage>& stream : streams) {
    const StampOrder order = putInOrder(stream);
    leaveOut(describe(StampFault::kLate), order.doubled, result);
    leaveOut(describe(StampFault::kUnset), order.unset, result);
  }
  for (const auto& [i, j] : pairByStamp(stampsOf(streams[0]), stampsOf(streams[1]))) {
    result.pairs.push_back({streams[0][i], streams[1][j]});
  }
  for (const ImageStream stream : {ImageStream::kColor, ImageStream::kDepth}) {
    leaveOut(withoutPartner(stream),
             streams[static_cast<std::size_t>(stream)].size() - result.pairs.size(), result);
  }
  return result;
}

}  // namespace

BagPairs pairImages(const std::vector<StreamedImage>& images) {
  std::size_t dropped = 0;
  BagPairs result = pairAsRecorded(images, dropped);
  return dropped > result.pairs.size() ? pairSorted(images) : result;
}

}  // namespace mivo
