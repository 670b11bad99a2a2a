// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "mivo/core/frame.h"
#include "mivo/core/parameters.h"

namespace mivo {

/// How a message tells its unit of depth.
constexpr char kDepthUnitOfMessages[] = "16UC1 is millimeters, 32FC1 meters";

/// What the depth of several frames looks like, and whether it can be depth at all.
class DepthAccount {
 public:
  /// What is expected of the median: what is filmed indoors has one, a live camera may come near.
  enum class Expected { kRoom, kAnything };

  /// Precondition: the frame matches its camera.
  void add(const Frame& frame);

  std::size_t frames() const { return frames_; }
  double median() const;    ///< m, of the medians of the frames; 0: there is no reading
  double coverage() const;  ///< mean part of the pixels with a reading, 0 to 1

  /// "median depth seen 2.1 m, 98 % of the pixels".
  std::string describe() const;

  /// One line if something is wrong with the depth as a whole: there is none, its median is outside
  /// of the range of the tracker or not as expected, or its bits are stored in an unusual way. With
  /// the median and the likely cause. Empty otherwise.
  /// @param unit_source  where the unit of depth comes from
  std::string findFault(const DepthParameters& parameters, const std::string& unit_source,
                        Expected expected) const;

 private:
  std::string usualStorage() const;

  std::size_t frames_ = 0;
  std::vector<double> medians_;                 // m, of the frames that have depth
  double coverages_ = 0.0;                      // summed over the frames
  double unit_ = 0.0;                           // m, of 16-bit depth, of the last frame; 0: meters
  std::map<std::string, std::size_t> storage_;  // frames by how their depth seems to be stored
};

}  // namespace mivo
