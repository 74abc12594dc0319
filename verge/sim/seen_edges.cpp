// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/sim/seen_edges.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "verge/core/vec.hpp"
#include "verge/sim/seen.hpp"
#include "verge/sim/world.hpp"

namespace verge::sim {
namespace {

constexpr double kOnFace_m = 0.2;   // a kerb leans back, and ranges have noise
constexpr double kFollows_m = 2.0;  // flatly seen, returns are far apart

/// The vertex nearest to the place, if it is near.
struct Nearest {
  std::size_t vertex = 0;
  double away_m = std::numeric_limits<double>::infinity();
};
Nearest nearest_vertex(const Boundary& boundary, Vec2 place) {
  Nearest nearest;
  for (std::size_t i = 0; i < boundary.points.size(); ++i) {
    const double away_m = distance(boundary.points[i].xy(), place);
    if (away_m < nearest.away_m) nearest = {i, away_m};
  }
  return nearest;
}

/// Vertices that a kerb's returns are nearest to, ascending, one for each return.
std::vector<std::size_t> hit_vertices(const Boundary& boundary, const std::vector<Vec2>& returns) {
  std::vector<std::size_t> hit;
  for (const Vec2 place : returns) {
    const Nearest nearest = nearest_vertex(boundary, place);
    if (nearest.away_m <= kOnFace_m) hit.push_back(nearest.vertex);
  }
  std::ranges::sort(hit);
  return hit;
}

void tell(Boundary& boundary, const std::vector<std::size_t>& hit) {
  boundary.state.assign(boundary.points.size(), PointState::kOccluded);
  for (std::size_t begin = 0, end = 0; begin < hit.size(); begin = end) {
    end = begin + 1;
    while (end < hit.size() &&
           distance(boundary.points[hit[end - 1]].xy(), boundary.points[hit[end]].xy()) <= kFollows_m) {
      ++end;
    }
    if (end - begin < kSeenReturns) continue;
    for (std::size_t i = hit[begin]; i <= hit[end - 1]; ++i) boundary.state[i] = PointState::kVisible;
  }
}

}  // namespace

void tell_seen_edges(std::vector<Boundary>& boundaries, const Scan& scan) {
  std::vector<Vec2> returns;
  for (std::size_t i = 0; i < scan.size(); ++i) {
    if ((scan.label[i] & 0xFFFFU) == static_cast<std::uint32_t>(Surface::kCurb))
      returns.push_back(scan.point(i).xy());
  }
  for (Boundary& boundary : boundaries) tell(boundary, hit_vertices(boundary, returns));
}

}  // namespace verge::sim
