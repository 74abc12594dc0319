// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/sim/ground.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "verge/core/field_io.hpp"
#include "verge/sim/noise.hpp"

namespace verge::sim {
namespace {

constexpr double kLeanReach_m = 30.0;
constexpr double kBlade_m = 0.25;

double smooth_step(double t) { return t * t * (3.0 - 2.0 * t); }

// Uniform in [-1, 1) at a corner of the lattice.
double corner_value(std::int64_t column, std::int64_t row, std::uint64_t seed) {
  const RayKey key{seed, static_cast<std::uint64_t>(column), static_cast<std::uint64_t>(row)};
  return 2.0 * uniform(key, Draw::kBumps) - 1.0;
}

}  // namespace

double bumps(Vec2 p, double length_m, std::uint64_t seed) {
  // Deviation of uniform numbers (1/sqrt 3) times that of the blend (26/35: mean of w^2 + (1 - w)^2, twice).
  constexpr double kDeviation = 0.57735026918962576 * 26.0 / 35.0;
  const double u = p.x / length_m;
  const double v = p.y / length_m;
  const auto column = static_cast<std::int64_t>(std::floor(u));
  const auto row = static_cast<std::int64_t>(std::floor(v));
  const double s = smooth_step(u - std::floor(u));
  const double t = smooth_step(v - std::floor(v));
  const auto line = [&](std::int64_t r) {
    return (1.0 - s) * corner_value(column, r, seed) + s * corner_value(column + 1, r, seed);
  };
  return ((1.0 - t) * line(row) + t * line(row + 1)) / kDeviation;
}

Ground::Ground(const GroundConfig& config, const std::vector<Road>& roads) : config_(config), roads_(roads) {
  check_fields(config_);
}

bool Ground::is_plane() const {
  return config_.roughness_m == 0.0 && config_.cross_fall == 0.0 && roads_.front().config().heights.empty();
}

double Ground::land(Vec2 p) const {
  double height = 0.0;
  const Road& first = roads_.front();
  if (config_.cross_fall != 0.0 || !first.config().heights.empty()) {
    const Beside beside = first.line().nearest(p);
    height = first.profile(beside.station_m) +
             config_.cross_fall * std::clamp(beside.lateral_m, -kLeanReach_m, kLeanReach_m);
  }
  if (config_.roughness_m == 0.0) return height;
  const auto seed = static_cast<std::uint64_t>(config_.seed);
  return height + config_.roughness_m * bumps(p, config_.roughness_length_m, seed);
}

double Ground::below_crown(Vec2 p) const {
  if (config_.crown == 0.0) return 0.0;
  double least = std::numeric_limits<double>::infinity();
  for (const Road& road : roads_) {
    if (road.line().at_least_m(p) < least)
      least = std::min(least, std::fabs(road.line().nearest(p).lateral_m));
  }
  return config_.crown * least;
}

double Ground::grass(Vec2 p) const {
  if (config_.grass_m == 0.0) return 0.0;
  return config_.grass_m * bumps(p, kBlade_m, static_cast<std::uint64_t>(config_.seed) + 1);
}

}  // namespace verge::sim
