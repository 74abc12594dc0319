// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "verge/core/fields.hpp"
#include "verge/core/vec.hpp"

namespace verge::sim {

/// What a triangle of the world is the surface of.
enum class Surface : std::uint8_t {
  kRoad,
  kCurb,
  kSidewalk,
  kGround,
  kWall,  ///< Of a house too.
  kRail,  ///< Sheet metal: guard rails, poles, bins.
  kVegetation,
  kVehicle,
  kPerson,     ///< On foot or on a bicycle.
  kPlastic,    ///< Barrels of a building site.
  kReflector,  ///< Retro-reflecting sheet: signs.
  kNone        ///< Nothing that stands there: drops of rain, dirt on the window, mirror images.
};

}  // namespace verge::sim

namespace verge {
template <>
inline constexpr std::array enum_names<sim::Surface> =
    std::to_array<std::string_view>({"road", "curb", "sidewalk", "ground", "wall", "rail", "vegetation",
                                     "vehicle", "person", "plastic", "reflector", "none"});
}  // namespace verge

namespace verge::sim {

/// Everything that a ray can hit: triangles with a surface each. Frame: the world's, x east, y north, z up,
/// metres. Triangles are two-sided.
struct World {
  std::vector<Vec3> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< Indices into vertices.
  std::vector<Surface> surface;                         ///< One a triangle.
  std::vector<std::uint32_t> object;  ///< One a triangle: what it belongs to; 0 = the ground.
};

/// Adds the triangle a, b, c.
void add_triangle(World& world, Vec3 a, Vec3 b, Vec3 c, Surface surface, std::uint32_t object = 0);

/// Adds the quadrilateral a, b, c, d (in order around it) as the triangles a b c and a c d.
void add_quad(World& world, Vec3 a, Vec3 b, Vec3 c, Vec3 d, Surface surface, std::uint32_t object = 0);

/// A box that stands upright: its walls and its roof.
struct Box {
  Vec3 base_center;      ///< Middle of its footprint, at its foot.
  Vec3 size;             ///< Length, width, height.
  double yaw_rad = 0.0;  ///< Direction of its length, from +x counter-clockwise.
};

void add_box(World& world, const Box& box, Surface surface, std::uint32_t object = 0);

/// Adds an upright prism with a regular foot of `sides` corners within the radii at its foot and at its top,
/// and its top.
void add_prism(World& world, Vec3 base_center, double foot_radius_m, double top_radius_m, double height_m,
               int sides, Surface surface, std::uint32_t object = 0);

/// Adds the level square from (-half_size, -half_size) to (half_size, half_size) around `center`.
void add_ground(World& world, Vec3 center, double half_size_m, Surface surface);

/// Adds all triangles of `part`, turned by `yaw_rad` and moved so that its origin comes to `origin`.
void add_world(World& world, const World& part, Vec3 origin, double yaw_rad);

}  // namespace verge::sim
