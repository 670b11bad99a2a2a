// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "mivo/core/camera.h"
#include "mivo/core/frame.h"

namespace mivo {

/// A frame as a driver delivers it, with its calibration.
struct Delivery {
  Frame frame;
  Camera camera;
  std::size_t index = 0;  ///< of the frame in the recording: where its image was taken
};

/// A driver, cable or clock with a fault: frames go in, what a receiver gets of them comes out.
/// Which frames it hits, and how, depends on the seed alone.
class FrameFaults {
 public:
  /// Throws Error for an unknown fault.
  /// @param rate  part of the frames that it hits, 0..1
  FrameFaults(const std::string& fault, double rate, std::uint32_t seed);

  /// What comes out when a frame goes in: nothing, the frame, or several.
  std::vector<Delivery> pass(const Delivery& delivery);

  /// The fault is over: what was held back.
  std::vector<Delivery> end();

  static std::vector<std::string> names();

  /// What a fault does with the frames that it hits.
  using Fault = std::vector<Delivery> (*)(FrameFaults& state, Delivery delivery);

  // For the faults: chance, the frames that went in before, the one that came out last, and those
  // that are still to come out.
  std::mt19937& engine() { return engine_; }
  const std::deque<Delivery>& earlier() const { return earlier_; }
  const std::optional<Delivery>& last() const { return last_; }
  std::vector<Delivery>& held() { return held_; }

 private:
  Fault fault_;
  std::bernoulli_distribution hits_;
  std::mt19937 engine_;
  std::deque<Delivery> earlier_;
  std::optional<Delivery> last_;
  std::vector<Delivery> held_;
};

}  // namespace mivo
