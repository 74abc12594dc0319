// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/sim/noise.hpp"

#include <array>
#include <cmath>
#include <numbers>

#include "verge/core/random.hpp"

namespace verge::sim {
namespace {

// One step of the key: the state so far and the next number of the key.
std::uint64_t absorb(std::uint64_t state, std::uint64_t number) {
  constexpr std::uint64_t kGolden = 0x9E3779B97F4A7C15ULL;
  return mix_bits(state + kGolden * (number + 1));
}

}  // namespace

std::uint64_t random_bits(const RayKey& key, Draw draw, std::uint64_t index) {
  std::uint64_t state = mix_bits(key.seed);
  for (const std::uint64_t number : std::array{key.scan, key.ray, static_cast<std::uint64_t>(draw), index}) {
    state = absorb(state, number);
  }
  return state;
}

double uniform(const RayKey& key, Draw draw, std::uint64_t index) {
  return to_unit_interval(random_bits(key, draw, index));
}

double gaussian(const RayKey& key, Draw draw, std::uint64_t index) {
  const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform(key, draw, 2 * index)));  // 1 - u is never 0
  return radius * std::cos(2.0 * std::numbers::pi * uniform(key, draw, 2 * index + 1));
}

}  // namespace verge::sim
