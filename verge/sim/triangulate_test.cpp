// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/sim/triangulate.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <set>
#include <stdexcept>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace verge::sim {
namespace {

double area_of(const Triangulation& net, const std::vector<std::array<std::uint32_t, 3>>& triangles) {
  double sum = 0.0;
  for (const auto& t : triangles) {
    const double twice = cross(net.points[t[1]] - net.points[t[0]], net.points[t[2]] - net.points[t[0]]);
    EXPECT_GT(twice, 0.0) << "a triangle that does not turn left";
    sum += 0.5 * twice;
  }
  return sum;
}

std::set<std::pair<std::uint32_t, std::uint32_t>> edges_of(const Triangulation& net) {
  std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (const auto* part : {&net.inside, &net.outside}) {
    for (const auto& t : *part) {
      for (std::size_t i = 0; i < 3; ++i) edges.insert(std::minmax(t.at(i), t.at((i + 1) % 3)));
    }
  }
  return edges;
}

std::vector<FixedEdge> ring(std::uint32_t first, std::uint32_t count) {
  std::vector<FixedEdge> edges;
  for (std::uint32_t i = 0; i < count; ++i) edges.push_back({first + i, first + (i + 1) % count});
  return edges;
}

std::vector<Vec2> random_points(std::size_t count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> coordinate(-40.0, 40.0);
  std::vector<Vec2> points(count);
  for (Vec2& p : points) p = {coordinate(random), coordinate(random)};
  return points;
}

TEST(Triangulate, CoversItsFrameOnce) {
  const Triangulation net = triangulate(random_points(500, 1), {}, 10.0);
  const Vec2 low = net.points[500];
  const Vec2 high = net.points[502];
  EXPECT_NEAR(area_of(net, net.outside), (high.x - low.x) * (high.y - low.y), 1e-6);
  EXPECT_TRUE(net.inside.empty());
  EXPECT_EQ(net.outside.size(), 2U * 500U + 2U);  // Euler
}

TEST(Triangulate, WithoutFixedEdgesNoPointLiesInTheCircleOfATriangle) {
  const auto points = random_points(120, 2);
  const Triangulation net = triangulate(points, {}, 1000.0);
  for (const auto& t : net.outside) {
    const Vec2 a = net.points[t[0]];
    const Vec2 b = net.points[t[1]] - a;
    const Vec2 c = net.points[t[2]] - a;
    const double d = 2.0 * cross(b, c);
    const Vec2 center = {(c.y * dot(b, b) - b.y * dot(c, c)) / d, (b.x * dot(c, c) - c.x * dot(b, b)) / d};
    for (const Vec2 p : points) EXPECT_GT(distance(p - a, center), norm(center) * (1.0 - 1e-6));
  }
}

TEST(Triangulate, APolygonWithAHoleHasItsAreaInside) {
  std::vector<Vec2> points = {{0, 0}, {10, 0}, {10, 8}, {0, 8}, {4, 3}, {4, 5}, {6, 5}, {6, 3}};
  std::vector<FixedEdge> edges = ring(0, 4);
  for (const FixedEdge& edge : ring(4, 4)) edges.push_back(edge);
  const Triangulation net = triangulate(points, edges, 5.0);
  EXPECT_NEAR(area_of(net, net.inside), 76.0, 1e-9);
  EXPECT_NEAR(area_of(net, net.outside), 20.0 * 20.0 - 76.0, 1e-6);
}

TEST(Triangulate, KeepsFixedEdgesThroughACloudOfPoints) {
  for (unsigned seed = 1; seed < 30; ++seed) {
    std::vector<Vec2> points = random_points(300, seed);
    const auto first = static_cast<std::uint32_t>(points.size());
    for (int i = 0; i < 12; ++i) {
      const double angle = 0.5235987755982988 * i;
      const double radius = i % 2 == 0 ? 30.0 : 9.0;
      points.push_back({radius * std::cos(angle), radius * std::sin(angle)});
    }
    const Triangulation net = triangulate(points, ring(first, 12), 5.0);
    double twice = 0.0;
    for (std::uint32_t i = 0; i < 12; ++i) twice += cross(points[first + i], points[first + (i + 1) % 12]);
    EXPECT_NEAR(area_of(net, net.inside), 0.5 * twice, 1e-6) << seed;
    const auto edges = edges_of(net);
    for (const FixedEdge& edge : ring(first, 12))
      EXPECT_TRUE(edges.contains(std::minmax(edge.from, edge.to)));
  }
}

TEST(Triangulate, PointsOnARasterAndOnFixedEdgesAreNoTrouble) {
  std::vector<Vec2> points;
  for (int x = 0; x <= 20; ++x) {
    for (int y = 0; y <= 20; ++y) points.push_back({0.5 * x, 0.5 * y});
  }
  const auto first = static_cast<std::uint32_t>(points.size());
  for (const Vec2 p : {Vec2{1, 1}, {9, 1}, {9, 9}, {1, 9}}) points.push_back(p);  // doubles of raster points
  const Triangulation net = triangulate(points, ring(first, 4), 3.0);
  EXPECT_NEAR(area_of(net, net.inside), 64.0, 1e-9);
  EXPECT_NEAR(area_of(net, net.inside) + area_of(net, net.outside), 16.0 * 16.0, 1e-9);
}

TEST(Triangulate, ACreaseIsAnEdgeUnlessABorderIsInItsWay) {
  const std::vector<Vec2> points = {{0, 0}, {10, 0}, {10, 6}, {0, 6}, {2, 3},
                                    {8, 3}, {12, 3}, {1, 5},  {9, 1}};
  std::vector<FixedEdge> edges = ring(0, 4);
  edges.push_back({4, 5, FixedEdge::Kind::kCrease});
  edges.push_back({5, 6, FixedEdge::Kind::kCrease});
  const Triangulation net = triangulate(points, edges, 5.0);
  EXPECT_TRUE(edges_of(net).contains({4, 5}));
  EXPECT_FALSE(edges_of(net).contains({5, 6}));
  EXPECT_NEAR(area_of(net, net.inside), 60.0, 1e-9);
}

TEST(Triangulate, RefusesBordersThatCrossAndWorldsTooWide) {
  const std::vector<Vec2> points = {{0, 0}, {10, 10}, {10, 0}, {0, 10}};
  EXPECT_THROW((void)triangulate(points, ring(0, 4), 1.0), std::invalid_argument);
  EXPECT_THROW((void)triangulate(points, {}, 3000.0), std::invalid_argument);
}

}  // namespace
}  // namespace verge::sim
