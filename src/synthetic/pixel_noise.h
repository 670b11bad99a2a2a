// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

// Random numbers that depend on where they are used, not on who used one before: the noise of a
// pixel is a function of (seed, frame, pixel). Images come out the same for any number of threads.

namespace mivo {

/// Mixes all bits (the finalizer of SplitMix64).
inline std::uint64_t mixBits(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15ULL;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
  return x ^ (x >> 31);
}

/// 64 independent bits for each tuple of numbers.
inline std::uint64_t hashOf(std::uint64_t seed, std::uint64_t a, std::uint64_t b = 0) {
  return mixBits(mixBits(mixBits(seed) ^ a) ^ b);
}

/// Uniform in [0, 1) from the upper 24 bits.
inline float uniformFrom(std::uint64_t bits) {
  return static_cast<float>(bits >> 40) * 0x1p-24F;
}

/// Table of 65536 equally likely values of the standard normal distribution (its quantiles at
/// (k + 0.5) / 65536): any 16 random bits are an index. Built once, on first use.
const float* gaussianTable();

/// Standard normal from the lowest 16 bits.
inline float gaussianFrom(std::uint64_t bits) {
  return gaussianTable()[bits & 0xffffU];
}

}  // namespace mivo
