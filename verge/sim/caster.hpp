// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "verge/core/pose.hpp"
#include "verge/core/vec.hpp"
#include "verge/sim/world.hpp"

struct RTCSceneTy;  // Embree's scene

namespace verge::sim {

/// Where a ray first meets the world.
struct Hit {
  double distance_m = 0.0;  ///< From the ray's origin, along its direction.
  Surface surface = Surface::kGround;
  double cos_incidence = 1.0;  ///< Of the angle between the ray and the surface's normal, 0..1.
  std::uint32_t object = 0;    ///< As World::object.
  Vec3 normal;                 ///< Of the surface, on either side; a unit vector in the world frame.
};

/// A ray: its origin, and its direction as a unit vector, in the world frame.
struct Ray {
  Vec3 origin;
  Vec3 direction;
};

/// Finds what rays hit. Embree finds the triangle (single precision, watertight); the distance to its plane
/// is then computed in double precision, so that it is exact to about 1e-12 of itself. Calls may run in
/// parallel, and give the same bits in any order.
class Caster {
 public:
  /// Builds the trees over a copy of the world and of what moves in it, each of `bodies` in its own frame;
  /// until at() says otherwise, their frames are the world's. Throws std::invalid_argument where a triangle
  /// names a vertex that is not there or the surfaces or objects do not match the triangles,
  /// std::runtime_error where Embree cannot start.
  explicit Caster(World world, std::vector<World> bodies = {});
  Caster(const Caster&) = delete;
  Caster& operator=(const Caster&) = delete;
  Caster(Caster&&) noexcept;
  Caster& operator=(Caster&&) noexcept;
  ~Caster();

  /// The same world with its bodies at these poses, T_world_body, one each (assert). Shares the trees.
  [[nodiscard]] Caster at(std::span<const Pose> T_world_body) const;

  /// The nearest hit of the ray from `origin` along `direction` (a unit vector), both in the world frame;
  /// none where it meets nothing.
  [[nodiscard]] std::optional<Hit> cast(Vec3 origin, Vec3 direction) const;

  /// The nearest hits of many rays, each as cast() finds it but where a ray meets an edge of two triangles;
  /// faster where neighbours run alike. `hits` is as long as `rays` (assert).
  void cast(std::span<const Ray> rays, std::span<std::optional<Hit>> hits) const;

  /// Whether anything stands between the two points, less `margin_m` before the second one.
  [[nodiscard]] bool blocked(Vec3 from, Vec3 to, double margin_m) const;

 private:
  struct Trees;
  struct Moment;
  Caster(std::shared_ptr<const Trees> trees, std::span<const Pose> T_world_body);
  [[nodiscard]] RTCSceneTy* scene() const;
  [[nodiscard]] std::optional<Hit> exact(unsigned int geometry, unsigned int instance, unsigned int triangle,
                                         const Ray& ray) const;

  std::shared_ptr<const Trees> trees_;
  std::unique_ptr<const Moment> moment_;
};

}  // namespace verge::sim
