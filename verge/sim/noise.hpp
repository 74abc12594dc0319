// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace verge::sim {

/// Names one shot of one scan of one simulation: what its random numbers are keyed by. Random numbers are a
/// function of their key alone, so that they do not depend on the order in which rays are cast, nor on the
/// number of threads.
struct RayKey {
  std::uint64_t seed = 0;
  std::uint64_t scan = 0;
  std::uint64_t ray = 0;
};

/// The purposes for which a ray draws numbers; each has its own stream.
enum class Draw : std::uint64_t {
  kRangeNoise,
  kDropout,
  kBumps,
  kScenario,
  kFading,
  kDrop,
  kDropRange,
  kDropFading,
  kDirt
};

/// 64 random bits of the key.
[[nodiscard]] std::uint64_t random_bits(const RayKey& key, Draw draw, std::uint64_t index = 0);

/// Uniform in [0, 1), 53 bits.
[[nodiscard]] double uniform(const RayKey& key, Draw draw, std::uint64_t index = 0);

/// Normal with mean 0 and deviation 1 (Box-Muller; never beyond 8.6).
[[nodiscard]] double gaussian(const RayKey& key, Draw draw, std::uint64_t index = 0);

}  // namespace verge::sim
