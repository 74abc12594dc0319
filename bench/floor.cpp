// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/floor.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

#include "verge/core/angle.hpp"

namespace verge::bench {
namespace {

constexpr std::size_t kSectors = 361;  // the last one for an azimuth of exactly pi
constexpr std::size_t kSteps = 241;    // the last one for everything beyond 120 m
constexpr std::size_t kBlock = 1024;

// Bin of each point of a block, in a loop that vectorises.
void bin_block(const float* x, const float* y, std::size_t count, std::int32_t* bin) {
  constexpr float kPi = std::numbers::pi_v<float>;
  for (std::size_t i = 0; i < count; ++i) {
    const auto sector = static_cast<std::int32_t>((fast_atan2(y[i], x[i]) + kPi) * (180.0F / kPi));
    const float planar = std::sqrt(x[i] * x[i] + y[i] * y[i]);
    const float step = planar < 120.0F ? planar * 2.0F : 240.0F;
    bin[i] = sector * static_cast<std::int32_t>(kSteps) + static_cast<std::int32_t>(step);
  }
}

}  // namespace

Floor::Floor() : lowest_(kSectors * kSteps) {}

std::span<const float> Floor::run(std::span<const float> x, std::span<const float> y,
                                  std::span<const float> z) {
  std::fill(lowest_.begin(), lowest_.end(), std::numeric_limits<float>::infinity());
  std::array<std::int32_t, kBlock> bin{};
  float* const lowest = lowest_.data();
  for (std::size_t from = 0; from < x.size(); from += kBlock) {
    const std::size_t count = std::min(kBlock, x.size() - from);
    bin_block(x.data() + from, y.data() + from, count, bin.data());
    for (std::size_t i = 0; i < count; ++i) {
      float& low = lowest[bin[i]];
      low = std::min(low, z[from + i]);
    }
  }
  return lowest_;
}

}  // namespace verge::bench
