// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/sim/world.hpp"

#include <cmath>
#include <numbers>

namespace verge::sim {

void add_triangle(World& world, Vec3 a, Vec3 b, Vec3 c, Surface surface, std::uint32_t object) {
  const auto first = static_cast<std::uint32_t>(world.vertices.size());
  world.vertices.insert(world.vertices.end(), {a, b, c});
  world.triangles.push_back({first, first + 1, first + 2});
  world.surface.push_back(surface);
  world.object.push_back(object);
}

void add_quad(World& world, Vec3 a, Vec3 b, Vec3 c, Vec3 d, Surface surface, std::uint32_t object) {
  add_triangle(world, a, b, c, surface, object);
  add_triangle(world, a, c, d, surface, object);
}

void add_box(World& world, const Box& box, Surface surface, std::uint32_t object) {
  const Vec3 ahead = 0.5 * box.size.x * Vec3{std::cos(box.yaw_rad), std::sin(box.yaw_rad), 0.0};
  const Vec3 left = 0.5 * box.size.y * Vec3{-std::sin(box.yaw_rad), std::cos(box.yaw_rad), 0.0};
  const Vec3 up = {0.0, 0.0, box.size.z};
  const std::array<Vec3, 4> foot = {box.base_center - ahead - left, box.base_center + ahead - left,
                                    box.base_center + ahead + left, box.base_center - ahead + left};
  for (std::size_t i = 0; i < foot.size(); ++i) {
    const Vec3 next = foot.at((i + 1) % foot.size());
    add_quad(world, foot.at(i), next, next + up, foot.at(i) + up, surface, object);
  }
  add_quad(world, foot[0] + up, foot[1] + up, foot[2] + up, foot[3] + up, surface, object);
}

void add_prism(World& world, Vec3 base_center, double foot_radius_m, double top_radius_m, double height_m,
               int sides, Surface surface, std::uint32_t object) {
  const Vec3 top_center = base_center + Vec3{0.0, 0.0, height_m};
  const auto corner = [&](int i, Vec3 center, double radius) {
    const double angle = 2.0 * std::numbers::pi * i / sides;
    return center + radius * Vec3{std::cos(angle), std::sin(angle), 0.0};
  };
  for (int i = 0; i < sides; ++i) {
    const Vec3 a = corner(i, top_center, top_radius_m);
    const Vec3 b = corner(i + 1, top_center, top_radius_m);
    add_quad(world, corner(i, base_center, foot_radius_m), corner(i + 1, base_center, foot_radius_m), b, a,
             surface, object);
    if (top_radius_m > 0.0) add_triangle(world, a, b, top_center, surface, object);
  }
}

void add_ground(World& world, Vec3 center, double half_size_m, Surface surface) {
  const Vec3 x = {half_size_m, 0.0, 0.0};
  const Vec3 y = {0.0, half_size_m, 0.0};
  add_quad(world, center - x - y, center + x - y, center + x + y, center - x + y, surface);
}

void add_world(World& world, const World& part, Vec3 origin, double yaw_rad) {
  const auto first = static_cast<std::uint32_t>(world.vertices.size());
  const double c = std::cos(yaw_rad);
  const double s = std::sin(yaw_rad);
  for (const Vec3& p : part.vertices) {
    world.vertices.push_back(origin + Vec3{c * p.x - s * p.y, s * p.x + c * p.y, p.z});
  }
  for (const auto& t : part.triangles) world.triangles.push_back({first + t[0], first + t[1], first + t[2]});
  world.surface.insert(world.surface.end(), part.surface.begin(), part.surface.end());
  world.object.insert(world.object.end(), part.object.begin(), part.object.end());
}

}  // namespace verge::sim
