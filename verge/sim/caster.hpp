// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>

#include "verge/core/vec.hpp"
#include "verge/sim/world.hpp"

namespace verge::sim {

/// Where a ray first meets the world.
struct Hit {
  double distance_m = 0.0;  ///< From the ray's origin, along its direction.
  Surface surface = Surface::kGround;
  double cos_incidence = 1.0;  ///< Of the angle between the ray and the surface's normal, 0..1.
};

/// Finds what rays hit. Embree finds the triangle (single precision, watertight); the distance to its plane
/// is then computed in double precision, so that it is exact to about 1e-12 of itself. Calls may run in
/// parallel, and give the same bits in any order.
class Caster {
 public:
  /// Builds the tree over a copy of the world. Throws std::invalid_argument where a triangle names a vertex
  /// that is not there or the surfaces do not match the triangles, std::runtime_error where Embree cannot
  /// start.
  explicit Caster(World world);
  Caster(const Caster&) = delete;
  Caster& operator=(const Caster&) = delete;
  Caster(Caster&&) noexcept;
  Caster& operator=(Caster&&) noexcept;
  ~Caster();

  /// The nearest hit of the ray from `origin` along `direction` (a unit vector), both in the world frame;
  /// none where it meets nothing.
  [[nodiscard]] std::optional<Hit> cast(Vec3 origin, Vec3 direction) const;

 private:
  struct State;
  std::unique_ptr<const State> state_;
};

}  // namespace verge::sim
