// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/sim/caster.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <random>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include "verge/core/angle.hpp"
#include "verge/sensor/hdl32e.hpp"
#include "verge/sim/test_worlds.hpp"

namespace verge::sim {
namespace {

Vec3 direction(double azimuth_rad, double elevation_rad) {
  return {std::cos(elevation_rad) * std::cos(azimuth_rad), std::cos(elevation_rad) * std::sin(azimuth_rad),
          std::sin(elevation_rad)};
}

// A road between kerbs of 0.12 m at y = -4 and y = 4, level on and off the road.
Caster road_between_curbs() {
  World world;
  for (const double sign : {-1.0, 1.0}) {
    const double y = 4.0 * sign;
    add_quad(world, {-100, 0, 0}, {100, 0, 0}, {100, y, 0}, {-100, y, 0}, Surface::kRoad);
    add_quad(world, {-100, y, 0}, {100, y, 0}, {100, y, 0.12}, {-100, y, 0.12}, Surface::kCurb);
    add_quad(world, {-100, y, 0.12}, {100, y, 0.12}, {100, 20.0 * sign, 0.12}, {-100, 20.0 * sign, 0.12},
             Surface::kSidewalk);
  }
  return Caster(std::move(world));
}

TEST(Caster, RingsOfFlatGroundHaveRadiusHeightOverTangent) {
  const Caster caster = testing::flat_ground();
  const double height = 1.9;
  for (const sensor::Laser& laser : sensor::hdl32e().lasers) {
    if (laser.elevation_rad >= 0.0) continue;
    for (double azimuth = -3.0; azimuth <= 3.0; azimuth += 0.25) {
      const auto hit = caster.cast({0.0, 0.0, height}, direction(azimuth, laser.elevation_rad));
      ASSERT_TRUE(hit.has_value());
      const double radius = hit->distance_m * std::cos(laser.elevation_rad);
      const double expected = height / std::tan(-laser.elevation_rad);
      EXPECT_NEAR(radius, expected, 1e-12 * expected);
      EXPECT_NEAR(hit->cos_incidence, std::sin(-laser.elevation_rad), 1e-12);
    }
  }
}

TEST(Caster, RaysAtOrAboveTheHorizonMeetNothingOnFlatGround) {
  const Caster caster = testing::flat_ground();
  EXPECT_FALSE(caster.cast({0.0, 0.0, 1.9}, direction(0.3, 0.0)).has_value());
  EXPECT_FALSE(caster.cast({0.0, 0.0, 1.9}, direction(0.3, 0.1)).has_value());
}

TEST(Caster, FourLayersOneMetreUpHitTheGroundWherePaper1Says) {
  const Caster caster = testing::flat_ground();
  const std::array expected = {3.732, 4.031, 4.378, 4.787};
  for (std::size_t layer = 0; layer < expected.size(); ++layer) {
    const double from_vertical = deg_to_rad(75.0 + 3.2 / 3.0 * static_cast<double>(layer));
    const auto hit = caster.cast({0.0, 0.0, 1.0}, direction(0.0, from_vertical - deg_to_rad(90.0)));
    ASSERT_TRUE(hit.has_value());
    EXPECT_NEAR(hit->distance_m * std::sin(from_vertical), expected.at(layer), 5e-4);
  }
}

TEST(Caster, TheFaceOfAKerbIsHitWhereTheRayCrossesItsPlane) {
  const Caster caster = road_between_curbs();
  const double height = 1.9;
  int faces = 0;
  for (const sensor::Laser& laser : sensor::hdl32e().lasers) {
    for (double azimuth = 0.05; azimuth < 3.1; azimuth += 0.05) {
      const Vec3 d = direction(azimuth, laser.elevation_rad);
      const double to_face = 4.0 / d.y;  // on the plane y = 4
      const double z = height + to_face * d.z;
      if (z < 1e-4 || z > 0.12 - 1e-4 || std::fabs(to_face * d.x) > 99.0) continue;
      const auto hit = caster.cast({0.0, 0.0, height}, d);
      ASSERT_TRUE(hit.has_value());
      EXPECT_EQ(hit->surface, Surface::kCurb);
      EXPECT_NEAR(hit->distance_m, to_face, 1e-12 * to_face);
      EXPECT_NEAR(hit->cos_incidence, d.y, 1e-12);
      ++faces;
    }
  }
  EXPECT_GT(faces, 20);
}

TEST(Caster, ABoxIsHitOnTheWallThatFacesTheRay) {
  World world;
  add_box(world, {{10.0, 0.0, 0.0}, {4.0, 2.0, 1.5}, 0.0}, Surface::kWall);
  const Caster caster(std::move(world));
  EXPECT_NEAR(caster.cast({0.0, 0.0, 1.0}, {1.0, 0.0, 0.0})->distance_m, 8.0, 1e-12);
  EXPECT_NEAR(caster.cast({10.0, 5.0, 1.0}, {0.0, -1.0, 0.0})->distance_m, 4.0, 1e-12);
  EXPECT_NEAR(caster.cast({10.0, 0.0, 9.0}, {0.0, 0.0, -1.0})->distance_m, 7.5, 1e-12);
  EXPECT_FALSE(caster.cast({0.0, 0.0, 1.6}, {1.0, 0.0, 0.0}).has_value());
}

TEST(Caster, ATurnedBoxIsHitOnItsTurnedWall) {
  World world;
  add_box(world, {{10.0, 0.0, 0.0}, {4.0, 2.0, 1.5}, deg_to_rad(90.0)}, Surface::kWall);
  const Caster caster(std::move(world));
  EXPECT_NEAR(caster.cast({0.0, 0.0, 1.0}, {1.0, 0.0, 0.0})->distance_m, 9.0, 1e-12);
  EXPECT_NEAR(caster.cast({10.0, 5.0, 1.0}, {0.0, -1.0, 0.0})->distance_m, 3.0, 1e-12);
}

TEST(Caster, NoRaySlipsThroughTheEdgesBetweenTriangles) {
  const auto vertex = [](int i, int j) { return Vec3{0.3 * i, 0.3 * j, 0.0}; };
  World world;
  for (int i = -20; i < 20; ++i) {
    for (int j = -20; j < 20; ++j) {
      add_quad(world, vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1), Surface::kRoad);
    }
  }
  const Caster caster(std::move(world));
  const Vec3 eye = {0.123, 0.456, 1.9};
  for (int i = -19; i < 20; ++i) {
    for (int j = -19; j < 20; ++j) {
      for (const Vec3& end : std::array{vertex(i + 1, j), vertex(i, j + 1), vertex(i + 1, j + 1)}) {
        const Vec3 on_edge = vertex(i, j) + 0.37 * (end - vertex(i, j));
        const Vec3 toward = on_edge - eye;
        EXPECT_TRUE(caster.cast(eye, (1.0 / norm(toward)) * toward).has_value()) << i << " " << j;
      }
    }
  }
}

// The oracle: every triangle in turn, in double precision (Moeller and Trumbore 1997).
std::optional<double> distance_by_brute_force(const World& world, Vec3 origin, Vec3 d) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const auto& t : world.triangles) {
    const Vec3 a = world.vertices[t[0]];
    const Vec3 e1 = world.vertices[t[1]] - a;
    const Vec3 e2 = world.vertices[t[2]] - a;
    const Vec3 p = cross(d, e2);
    const double det = dot(e1, p);
    const Vec3 s = origin - a;
    const double u = dot(s, p) / det;
    const double v = dot(d, cross(s, e1)) / det;
    const double distance = dot(e2, cross(s, e1)) / det;
    if (u >= 0.0 && v >= 0.0 && u + v <= 1.0 && distance > 0.0) nearest = std::min(nearest, distance);
  }
  if (!std::isfinite(nearest)) return std::nullopt;
  return nearest;
}

TEST(Caster, AgreesWithTryingEveryTriangle) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> coordinate(-10.0, 10.0);
  const auto point = [&] { return Vec3{coordinate(random), coordinate(random), coordinate(random)}; };
  World world;
  for (int i = 0; i < 60; ++i) add_triangle(world, point(), point(), point(), Surface::kWall);
  const Caster caster(world);
  int hits = 0;
  int disagreements = 0;  // rays through an edge, decided by single precision
  for (int i = 0; i < 5000; ++i) {
    const Vec3 origin = point();
    const Vec3 toward = point() - origin;
    const Vec3 d = (1.0 / norm(toward)) * toward;
    const auto hit = caster.cast(origin, d);
    const auto expected = distance_by_brute_force(world, origin, d);
    const bool same = hit.has_value() == expected.has_value() &&
                      (!hit || std::fabs(hit->distance_m - *expected) <= 1e-9 * *expected);
    disagreements += same ? 0 : 1;
    hits += hit ? 1 : 0;
  }
  EXPECT_GT(hits, 2500);
  EXPECT_LE(disagreements, 2);
}

TEST(Caster, AnEmptyWorldGivesNoHit) {
  EXPECT_FALSE(Caster(World{}).cast({0.0, 0.0, 1.0}, {0.0, 0.0, -1.0}).has_value());
}

TEST(Caster, AWorldThatDoesNotFitTogetherIsRefused) {
  World world;
  add_triangle(world, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, Surface::kRoad);
  World no_surface = world;
  no_surface.surface.clear();
  EXPECT_THROW(Caster{no_surface}, std::invalid_argument);
  world.triangles[0][2] = 3;
  EXPECT_THROW(Caster{world}, std::invalid_argument);
}

}  // namespace
}  // namespace verge::sim
