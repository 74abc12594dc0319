// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/sim/seen_edges.hpp"

#include <algorithm>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "verge/sim/world.hpp"

namespace verge::sim {
namespace {

struct Return {
  float x = 0.0F;
  float y = 0.0F;
  Surface surface = Surface::kCurb;
};

Scan scan_of(const std::vector<Return>& returns) {
  Scan scan;
  for (const Return& each : returns) {
    scan.x.push_back(each.x);
    scan.y.push_back(each.y);
    scan.z.push_back(-0.4F);
    scan.label.push_back((7U << 16U) | static_cast<std::uint32_t>(each.surface));
  }
  return scan;
}

/// Along y = 3 from x = 0 to 20, a vertex every 0.1 m.
std::vector<Boundary> straight_edge() {
  Boundary edge;
  for (int i = 0; i <= 200; ++i) edge.points.push_back({0.1 * i, 3.0, -0.5});
  edge.state.assign(edge.points.size(), PointState::kVisible);
  return {edge};
}

/// How much of the edge is visible, metres.
double visible_m(const std::vector<Return>& returns) {
  auto edges = straight_edge();
  tell_seen_edges(edges, scan_of(returns));
  return 0.1 * static_cast<double>(std::ranges::count(edges.front().state, PointState::kVisible) - 1);
}

constexpr double kNothing = -0.1;

}  // namespace

TEST(SeenEdges, AreVisibleFromTheFirstToTheLastOfThreeReturns) {
  EXPECT_NEAR(visible_m({{5.0F, 3.05F}, {6.0F, 2.95F}, {7.5F, 3.0F}}), 2.5, 1e-9);
  EXPECT_NEAR(visible_m({{5.0F, 3.0F}, {6.0F, 3.0F}}), kNothing, 1e-9);
}

TEST(SeenEdges, AreNotVisibleAcrossGaps) {
  EXPECT_NEAR(visible_m({{2.0F, 3.0F}, {3.0F, 3.0F}, {3.5F, 3.0F}, {9.0F, 3.0F}, {10.0F, 3.0F}}), 1.5, 1e-9);
}

TEST(SeenEdges, AreShownByReturnsOfTheKerbAlone) {
  EXPECT_NEAR(visible_m({{5.0F, 3.0F, Surface::kRoad}, {6.0F, 3.0F}, {7.0F, 3.0F}}), kNothing, 1e-9);
  EXPECT_NEAR(visible_m({{5.0F, 3.5F}, {6.0F, 3.0F}, {7.0F, 3.0F}}), kNothing, 1e-9);
}

}  // namespace verge::sim
