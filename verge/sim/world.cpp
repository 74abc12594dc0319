// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/sim/world.hpp"

#include <cmath>

namespace verge::sim {

void add_triangle(World& world, Vec3 a, Vec3 b, Vec3 c, Surface surface) {
  const auto first = static_cast<std::uint32_t>(world.vertices.size());
  world.vertices.insert(world.vertices.end(), {a, b, c});
  world.triangles.push_back({first, first + 1, first + 2});
  world.surface.push_back(surface);
}

void add_quad(World& world, Vec3 a, Vec3 b, Vec3 c, Vec3 d, Surface surface) {
  add_triangle(world, a, b, c, surface);
  add_triangle(world, a, c, d, surface);
}

void add_box(World& world, const Box& box, Surface surface) {
  const Vec3 ahead = 0.5 * box.size.x * Vec3{std::cos(box.yaw_rad), std::sin(box.yaw_rad), 0.0};
  const Vec3 left = 0.5 * box.size.y * Vec3{-std::sin(box.yaw_rad), std::cos(box.yaw_rad), 0.0};
  const Vec3 up = {0.0, 0.0, box.size.z};
  const std::array<Vec3, 4> foot = {box.base_center - ahead - left, box.base_center + ahead - left,
                                    box.base_center + ahead + left, box.base_center - ahead + left};
  for (std::size_t i = 0; i < foot.size(); ++i) {
    const Vec3 next = foot.at((i + 1) % foot.size());
    add_quad(world, foot.at(i), next, next + up, foot.at(i) + up, surface);
  }
  add_quad(world, foot[0] + up, foot[1] + up, foot[2] + up, foot[3] + up, surface);
}

void add_ground(World& world, Vec3 center, double half_size_m, Surface surface) {
  const Vec3 x = {half_size_m, 0.0, 0.0};
  const Vec3 y = {0.0, half_size_m, 0.0};
  add_quad(world, center - x - y, center + x - y, center + x + y, center - x + y, surface);
}

}  // namespace verge::sim
