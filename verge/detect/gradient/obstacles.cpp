// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/detect/gradient/obstacles.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "verge/core/angle.hpp"

namespace verge::detect::gradient {
namespace {

constexpr std::size_t kSectors = 360;
constexpr double kSector = 2.0 * std::numbers::pi / kSectors;
constexpr double kDepth = 0.6;  // metres of range in front of and behind the foot
constexpr double kWidth = 0.7;  // metres outward from the foot ...
constexpr double kLeastWidth = 2.0 * std::numbers::pi / 180.0;  // ... but never less than two degrees
constexpr double kBackShare = 0.25;                             // of the width, towards the road

double direction_of(Vec3 p) {
  return static_cast<double>(fast_atan2(static_cast<float>(p.y), static_cast<float>(p.x)));
}

std::size_t sector_of(double direction) {
  const double sector = std::floor((wrap_pi(direction) + std::numbers::pi) / kSector);
  return std::min(static_cast<std::size_t>(std::max(sector, 0.0)), kSectors - 1);
}

}  // namespace

Obstacles::Obstacles(const std::vector<LowRing>& low, const GradientConfig& config) : sectors_(kSectors) {
  for (const LowRing& ring : low) {
    for (const Vec3 p : ring.points) {
      if (p.z <= config.obstacle_m) continue;
      const double direction = direction_of(p);
      sectors_[sector_of(direction)].push_back({direction, norm(p.xy())});
    }
  }
}

bool Obstacles::stand_above(Vec3 foot, Quadrant region) const {
  const double range = norm(foot.xy());
  if (!(range > 0.0)) return false;
  const double direction = direction_of(foot);
  const double width = std::max(kLeastWidth, kWidth / range);
  const auto is_above = [&](const High& high) {
    const double outward = outward_sign(region) * wrap_pi(high.direction_rad - direction);
    return outward > -kBackShare * width && outward < width && std::abs(high.range_m - range) < kDepth;
  };
  const auto reach = static_cast<std::size_t>(std::ceil(width / kSector)) + 1;
  const std::size_t first = sector_of(direction) + kSectors - reach;
  for (std::size_t k = 0; k <= 2 * reach && k < kSectors; ++k) {
    const std::vector<High>& sector = sectors_[(first + k) % kSectors];
    if (std::any_of(sector.begin(), sector.end(), is_above)) return true;
  }
  return false;
}

}  // namespace verge::detect::gradient
