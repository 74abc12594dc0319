// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "verge/core/fields.hpp"
#include "verge/core/vec.hpp"
#include "verge/sim/road.hpp"

namespace verge::sim {

/// What the ground is like, all over the world.
struct GroundConfig {
  double crown = 0.02;
  double cross_fall = 0.0;
  double roughness_m = 0.0;
  double roughness_length_m = 2.0;
  double grass_m = 0.0;
  std::int64_t seed = 1;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor&& visit) {
    visit(self.crown,
          {"crown", "1", 0.0, 0.1,
           "fall of the carriageway to both sides of its centre line, a metre for each metre", "ours"});
    visit(self.cross_fall, {"cross_fall", "1", -0.1, 0.1,
                            "rise from right to left across the first road, a metre for each metre", "ours"});
    visit(self.roughness_m, {"roughness_m", "m", 0.0, 0.2, "deviation of the bumps of all ground", "ours"});
    visit(self.roughness_length_m,
          {"roughness_length_m", "m", 0.5, 50.0, "distance from bump to bump", "ours"});
    visit(self.grass_m, {"grass_m", "m", 0.0, 0.5, "deviation of the height of grass beside a road", "ours"});
    visit(self.seed, {"seed", "1", 0, 1e15, "of the bumps", "ours"});
  }
};

/// The height of the ground as a function of the place in the plane.
///
///     land(p)  = profile(s) + cross_fall * l + bumps(p)
///     road(p)  = land(p) - crown * (distance of p from the nearest centre line of any road)
///
/// with s the station of the first road that is nearest to p and l its lateral distance, at most 30 m; beyond
/// the first road's ends the profile stays as it is there. Both are continuous, but far inside the curves of
/// a first road that climbs or leans, where two places of it are equally near.
class Ground {
 public:
  /// The roads must outlive it. Throws std::invalid_argument where a value is out of its range.
  Ground(const GroundConfig& config, const std::vector<Road>& roads);

  [[nodiscard]] const GroundConfig& config() const { return config_; }

  [[nodiscard]] double land(Vec2 p) const;
  /// How far the carriageway lies below the land, for its crown.
  [[nodiscard]] double below_crown(Vec2 p) const;
  /// Height of the carriageway.
  [[nodiscard]] double road(Vec2 p) const { return land(p) - below_crown(p); }
  /// Seeded unevenness of grass, mean 0, deviation grass_m, at a lattice of 0.25 m.
  [[nodiscard]] double grass(Vec2 p) const;
  /// Whether the land is a plane or level: it needs no more triangles than its edges.
  [[nodiscard]] bool is_plane() const;

 private:
  GroundConfig config_;
  const std::vector<Road>& roads_;
};

/// Smooth seeded bumps: values at the corners of a square lattice, uniform and
/// independent, blended with smooth steps and scaled to deviation 1 over the plane.
[[nodiscard]] double bumps(Vec2 p, double length_m, std::uint64_t seed);

}  // namespace verge::sim
