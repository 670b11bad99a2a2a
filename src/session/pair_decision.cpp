// SPDX-License-Identifier: BSD-3-Clause
#include "session/pair_decision.h"

#include <algorithm>
#include <cmath>

namespace mivo {
namespace {

/// Two images that may be partners: numbers in the two lists.
struct Candidate {
  double difference;
  std::size_t i;
  std::size_t j;
};

/// The closest first.
std::vector<Candidate> candidatesOf(const std::vector<double>& first,
                                    const std::vector<double>& second, double max_difference) {
  std::vector<Candidate> candidates;
  std::size_t begin = 0;
  for (std::size_t i = 0; i < first.size(); ++i) {
    while (begin < second.size() && first[i] - second[begin] > max_difference) ++begin;
    for (std::size_t j = begin; j < second.size() && second[j] - first[i] <= max_difference; ++j) {
      candidates.push_back({std::abs(first[i] - second[j]), i, j});
    }
  }
  std::stable_sort(
      candidates.begin(), candidates.end(),
      [](const Candidate& a, const Candidate& b) { return a.difference < b.difference; });
  return candidates;
}

/// They share an image, or cross: both cannot be pairs.
bool excludes(const Candidate& a, const Candidate& b) {
  return !((a.i < b.i && a.j < b.j) || (a.i > b.i && a.j > b.j));
}

bool isExcluded(const Candidate& candidate, const std::vector<Candidate>& others) {
  return std::any_of(others.begin(), others.end(),
                     [&](const Candidate& other) { return excludes(candidate, other); });
}

/// No image from `next` on is closer to the stamp. One that is as close comes too late.
bool isNearest(double stamp, double difference, double next) {
  return difference == 0.0 || next - stamp >= difference;
}

/// What can be said without the candidates: an image that nothing to come can be the partner of
/// stays alone.
/// @param num_decided  images up to the last paired one: to come is nothing that would not cross it
std::vector<PairFate> fatesWithoutPartner(const std::vector<double>& stamps, double next_other,
                                          std::size_t num_decided, double max_difference) {
  std::vector<PairFate> fates(stamps.size());
  for (std::size_t i = 0; i < stamps.size(); ++i) {
    const bool is_single = i < num_decided || next_other - stamps[i] > max_difference;
    fates[i].kind = is_single ? PairFate::Kind::kSingle : PairFate::Kind::kOpen;
  }
  return fates;
}

}  // namespace

PairFates decidePairs(const WaitingStamps& first, const WaitingStamps& second,
                      double max_difference) {
  std::vector<Candidate> pairs;
  std::vector<Candidate> open;
  std::size_t first_decided = 0;  // behind the last pair
  std::size_t second_decided = 0;
  for (const Candidate& candidate : candidatesOf(first.stamps, second.stamps, max_difference)) {
    if (isExcluded(candidate, pairs)) continue;
    if (isExcluded(candidate, open) ||
        !isNearest(first.stamps[candidate.i], candidate.difference, second.next) ||
        !isNearest(second.stamps[candidate.j], candidate.difference, first.next)) {
      open.push_back(candidate);
      continue;
    }
    pairs.push_back(candidate);
    first_decided = std::max(first_decided, candidate.i + 1);
    second_decided = std::max(second_decided, candidate.j + 1);
  }

  PairFates fates;
  fates.first = fatesWithoutPartner(first.stamps, second.next, first_decided, max_difference);
  fates.second = fatesWithoutPartner(second.stamps, first.next, second_decided, max_difference);
  for (const Candidate& candidate : open) {
    fates.first[candidate.i].kind = fates.second[candidate.j].kind = PairFate::Kind::kOpen;
  }
  for (const Candidate& pair : pairs) {
    fates.first[pair.i] = {PairFate::Kind::kPaired, pair.j};
    fates.second[pair.j] = {PairFate::Kind::kPaired, pair.i};
  }
  return fates;
}

}  // namespace mivo
