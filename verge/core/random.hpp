// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cassert>
#include <cstddef>
#include <cstdint>

namespace verge {

/// The finaliser of SplitMix64 (Steele, Lea and Flood, "Fast splittable pseudorandom number generators",
/// OOPSLA 2014): every bit of the input turns about half of the output's.
[[nodiscard]] constexpr std::uint64_t mix_bits(std::uint64_t z) {
  z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9ULL;
  z = (z ^ (z >> 27U)) * 0x94D049BB133111EBULL;
  return z ^ (z >> 31U);
}

/// A number in [0, 1) of 53 random bits.
[[nodiscard]] constexpr double to_unit_interval(std::uint64_t bits) {
  return static_cast<double>(bits >> 11U) * 0x1p-53;
}

/// SplitMix64: the same numbers from the same seed on every platform, which the standard library's
/// distributions do not promise. Not for security.
class RandomSequence {
 public:
  explicit constexpr RandomSequence(std::uint64_t seed) : state_(seed) {}

  constexpr std::uint64_t next() { return mix_bits(state_ += 0x9E3779B97F4A7C15ULL); }
  /// Uniform in [0, 1).
  constexpr double uniform() { return to_unit_interval(next()); }
  /// One of 0 .. n - 1, each as likely to within n / 2^32. 0 < n <= 2^32.
  constexpr std::size_t below(std::size_t n) {
    assert(n > 0 && n <= (std::uint64_t{1} << 32U));
    return static_cast<std::size_t>(((next() >> 32U) * n) >> 32U);
  }

 private:
  std::uint64_t state_;
};

}  // namespace verge
