// SPDX-License-Identifier: BSD-3-Clause
#include "session/clock_offset.h"

#include <cmath>
#include <vector>

#include "session/median.h"

namespace mivo {
namespace {

constexpr std::size_t kSamples = 60;  // two seconds of an Xtion
constexpr std::size_t kEnough = 10;
// Stamps and arrivals that pass at rates further apart are not both of real time.
constexpr double kRateTolerance = 0.1;

}  // namespace

void ClockOffset::add(ImageStream stream, double stamp, double arrival) {
  std::deque<Sample>& samples = samples_[static_cast<std::size_t>(stream)];
  samples.push_back({stamp, arrival});
  if (samples.size() > kSamples) samples.pop_front();
}

std::optional<double> ClockOffset::seconds() const {
  double lead[2];
  for (std::size_t i = 0; i < 2; ++i) {
    const std::deque<Sample>& samples = samples_[i];
    if (samples.size() < kEnough) return std::nullopt;
    const double passed = samples.back().stamp - samples.front().stamp;
    const double waited = samples.back().arrival - samples.front().arrival;
    if (!(std::abs(passed - waited) <= kRateTolerance * waited)) return std::nullopt;
    std::vector<double> leads;
    for (const Sample& sample : samples) leads.push_back(sample.stamp - sample.arrival);
    lead[i] = medianOf(std::move(leads));
  }
  return lead[1] - lead[0];
}

}  // namespace mivo
