// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/sim/outline.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "verge/sim/mouth.hpp"

namespace verge::sim {
namespace {

constexpr double kHalfChordError_m = 0.5 * kChordErrorMax_m;  // the middle of a chord is not always farthest

/// Walks along the edges with the carriageway on its left, and leaves vertices behind.
class Walk {
 public:
  Walk(const std::vector<Road>& roads, const std::vector<Mouth>& mouths, double step_m)
      : roads_(roads), mouths_(mouths), step_m_(step_m) {}

  [[nodiscard]] std::vector<OutlineLoop> around(std::size_t road);
  [[nodiscard]] OutlineLoop around(std::size_t road, const Island& island);

 private:
  void put(OutlineVertex vertex);
  void put_edge(std::size_t road, RoadSide side, double station);
  void edge(std::size_t road, RoadSide side, double from, double to);
  void chords(std::size_t road, RoadSide side, double from, double to, int depth);
  void arc(Vec2 center, Vec2 from, Vec2 to, const OutlineVertex& first, double last_step_m);
  void forward(std::size_t road, double from);
  void backward(std::size_t road, double to);
  void end_of(std::size_t road, bool at_start);
  void out_and_back(const Mouth& mouth);
  [[nodiscard]] std::vector<Mouth> mouths_on(std::size_t road, RoadSide side) const;
  [[nodiscard]] OutlineVertex vertex_at(std::size_t road, RoadSide side, double station) const;
  [[nodiscard]] OutlineLoop take(bool island);

  const std::vector<Road>& roads_;
  const std::vector<Mouth>& mouths_;
  double step_m_;
  std::vector<OutlineVertex> vertices_;
};

OutlineVertex Walk::vertex_at(std::size_t road, RoadSide side, double station) const {
  const Road& r = roads_[road];
  return {r.edge_point(side, station).position,
          r.step_height(side, station),
          r.edge(side),
          Part::kEdge,
          road,
          side};
}

void Walk::put(OutlineVertex vertex) {
  constexpr double kSame_m = 1e-5;
  if (!vertices_.empty() && distance(vertices_.back().position, vertex.position) < kSame_m) {
    vertices_.back() = vertex;
    return;
  }
  vertices_.push_back(vertex);
}

void Walk::put_edge(std::size_t road, RoadSide side, double station) { put(vertex_at(road, side, station)); }

// Halves the stretch until its chord is near enough to its middle; puts all vertices but the first.
void Walk::chords(std::size_t road, RoadSide side, double from, double to, int depth) {
  const Road& r = roads_[road];
  const double half = 0.5 * (from + to);
  const Vec2 a = r.edge_point(side, from).position;
  const Vec2 b = r.edge_point(side, to).position;
  const Vec2 middle = r.edge_point(side, half).position;
  const bool near = distance(0.5 * (a + b), middle) <= kHalfChordError_m && distance(a, b) <= step_m_;
  if (near || depth > 20) return put_edge(road, side, to);
  chords(road, side, from, half, depth + 1);
  chords(road, side, half, to, depth + 1);
}

void Walk::edge(std::size_t road, RoadSide side, double from, double to) {
  put_edge(road, side, from);
  std::vector<double> breaks = roads_[road].breaks(side);
  if (from > to) std::reverse(breaks.begin(), breaks.end());
  double at = from;
  for (const double s : breaks) {
    if (s <= std::min(from, to) || s >= std::max(from, to)) continue;
    chords(road, side, at, s, 0);
    at = s;
  }
  chords(road, side, at, to, 0);
}

// The arc turns right, away from the carriageway; its height changes evenly.
void Walk::arc(Vec2 center, Vec2 from, Vec2 to, const OutlineVertex& first, double last_step_m) {
  const double radius = distance(center, from);
  const Vec2 a = from - center;
  const double begin = std::atan2(a.y, a.x);
  const double turn = std::atan2(cross(a, to - center), dot(a, to - center));
  const double most =
      std::min(2.0 * std::acos(1.0 - std::min(0.5, kHalfChordError_m / radius)), step_m_ / radius);
  const int count = std::max(1, static_cast<int>(std::ceil(std::fabs(turn) / most)));
  for (int i = 0; i <= count; ++i) {
    const double share = static_cast<double>(i) / count;
    OutlineVertex vertex = first;
    vertex.part = first.part == Part::kIsland ? Part::kIsland : Part::kReturn;
    vertex.position = i == count ? to : center + radius * along(begin + share * turn);
    vertex.step_m = first.step_m + share * (last_step_m - first.step_m);
    put(vertex);
  }
}

std::vector<Mouth> Walk::mouths_on(std::size_t road, RoadSide side) const {
  std::vector<Mouth> found;
  for (const Mouth& mouth : mouths_) {
    if (mouth.road == road && mouth.side == side) found.push_back(mouth);
  }
  std::sort(found.begin(), found.end(), [](const Mouth& a, const Mouth& b) { return a.begin_m < b.begin_m; });
  for (std::size_t i = 1; i < found.size(); ++i) {
    if (found[i].begin_m >= found[i - 1].end_m) continue;
    throw std::invalid_argument(
        fmt::format("the mouths of roads {} and {} overlap", found[i - 1].branch + 1, found[i].branch + 1));
  }
  return found;
}

// From the road's edge into a branch, round its end, and back to the road's edge.
void Walk::out_and_back(const Mouth& mouth) {
  const bool right = mouth.side == RoadSide::kRight;
  const double first = right ? mouth.begin_m : mouth.end_m;
  const double last = right ? mouth.end_m : mouth.begin_m;
  const double first_branch = right ? mouth.begin_branch_m : mouth.end_branch_m;
  const double last_branch = right ? mouth.end_branch_m : mouth.begin_branch_m;
  const OutlineVertex leave = vertex_at(mouth.road, mouth.side, first);
  const OutlineVertex enter = vertex_at(mouth.branch, RoadSide::kRight, first_branch);
  OutlineVertex tag = enter;
  tag.step_m = leave.step_m;
  arc(right ? mouth.begin_center : mouth.end_center, leave.position, enter.position, tag, enter.step_m);
  forward(mouth.branch, first_branch);
  end_of(mouth.branch, false);
  backward(mouth.branch, last_branch);
  const OutlineVertex from = vertex_at(mouth.branch, RoadSide::kLeft, last_branch);
  const OutlineVertex to = vertex_at(mouth.road, mouth.side, last);
  arc(right ? mouth.end_center : mouth.begin_center, from.position, to.position, from, to.step_m);
}

void Walk::forward(std::size_t road, double from) {
  double at = from;
  for (const Mouth& mouth : mouths_on(road, RoadSide::kRight)) {
    if (mouth.begin_m < at) throw std::invalid_argument("a branch begins in the mouth of another");
    edge(road, RoadSide::kRight, at, mouth.begin_m);
    out_and_back(mouth);
    at = mouth.end_m;
  }
  edge(road, RoadSide::kRight, at, roads_[road].length_m());
}

void Walk::backward(std::size_t road, double to) {
  double at = roads_[road].length_m();
  std::vector<Mouth> mouths = mouths_on(road, RoadSide::kLeft);
  std::reverse(mouths.begin(), mouths.end());
  for (const Mouth& mouth : mouths) {
    if (mouth.begin_m < to) throw std::invalid_argument("a branch begins in the mouth of another");
    edge(road, RoadSide::kLeft, at, mouth.end_m);
    out_and_back(mouth);
    at = mouth.begin_m;
  }
  edge(road, RoadSide::kLeft, at, to);
}

// Across the end of a road, from one edge to the other; the step of the edges ends within 0.3 m.
void Walk::end_of(std::size_t road, bool at_start) {
  constexpr double kRamp_m = 0.3;
  const Road& r = roads_[road];
  const double station = at_start ? 0.0 : r.length_m();
  const RoadSide from = at_start ? RoadSide::kLeft : RoadSide::kRight;
  OutlineVertex vertex = vertex_at(road, from, station);
  const bool closed = r.config().dead_end && !at_start;
  vertices_.back().part = vertex.part = closed ? Part::kEdge : Part::kEnd;
  const double sign = sign_of(from);
  const double near = r.edge_offset(from, station) - kRamp_m;
  const double far = r.edge_offset(opposite(from), station) - kRamp_m;
  if (!closed) vertex.step_m = 0.0;
  for (const double lateral : {sign * near, 0.0, -sign * far}) {  // 0: the crown's crease ends there
    vertex.position = r.line().point(station, lateral);
    put(vertex);
  }
}

OutlineLoop Walk::take(bool island) {
  constexpr double kSame_m = 1e-5;
  if (distance(vertices_.front().position, vertices_.back().position) < kSame_m) vertices_.pop_back();
  return {std::exchange(vertices_, {}), island};
}

std::vector<OutlineLoop> Walk::around(std::size_t road) {
  std::vector<OutlineLoop> loops;
  forward(road, 0.0);
  if (roads_[road].line().closed()) {
    loops.push_back(take(false));
  } else {
    end_of(road, false);
  }
  backward(road, 0.0);
  if (!roads_[road].line().closed()) end_of(road, true);
  loops.push_back(take(false));
  return loops;
}

// Counter-clockwise around the island, then turned round.
OutlineLoop Walk::around(std::size_t road, const Island& island) {
  const Road& r = roads_[road];
  const double half = 0.5 * island.width_m;
  const double begin = island.at_m + half;
  const double end = island.at_m + island.length_m - half;
  const auto side_point = [&](double s, double sign) {
    return r.line().point(s, island.lateral_m + sign * half);
  };
  OutlineVertex tag{{}, r.config().kerb_m, Edge::kKerb, Part::kIsland, road, RoadSide::kLeft};
  const auto side = [&](double sign) {
    const int count = std::max(1, static_cast<int>(std::ceil((end - begin) / std::min(0.5, step_m_))));
    for (int i = 0; i <= count; ++i) {
      const double s = sign < 0.0 ? begin + (end - begin) * i / count : end - (end - begin) * i / count;
      tag.position = side_point(s, sign);
      put(tag);
    }
  };
  const auto cap = [&](double s, double sign) {
    const Vec2 center = r.line().point(s, island.lateral_m);
    const Vec2 tip = center - sign * half * along(r.line().at(s).heading_rad);
    arc(center, side_point(s, sign), tip, tag, tag.step_m);
    arc(center, tip, side_point(s, -sign), tag, tag.step_m);
  };
  side(-1.0);
  cap(end, -1.0);
  side(1.0);
  cap(begin, 1.0);
  OutlineLoop loop = take(true);
  std::reverse(loop.vertices.begin(), loop.vertices.end());
  return loop;
}

void check_island(const Road& road, const Island& island) {
  for (const double s : {island.at_m, island.at_m + island.length_m}) {
    const bool inside = s <= road.length_m() &&
                        island.lateral_m + 0.5 * island.width_m < road.half_width(s) &&
                        island.lateral_m - 0.5 * island.width_m > -road.half_width(s);
    if (!inside) throw std::invalid_argument("an island leaves its road");
  }
}

}  // namespace

Outline make_outline(const std::vector<Road>& roads, double step_m) {
  Outline outline;
  outline.mouths = make_mouths(roads);
  Walk walk(roads, outline.mouths, step_m);
  for (std::size_t i = 0; i < roads.size(); ++i) {
    if (roads[i].config().branch_of == 0) {
      for (OutlineLoop& loop : walk.around(i)) outline.loops.push_back(std::move(loop));
    }
    for (const Island& island : roads[i].config().islands) {
      check_island(roads[i], island);
      outline.loops.push_back(walk.around(i, island));
    }
  }
  return outline;
}

bool in_mouth(const Outline& outline, std::size_t road, RoadSide side, double from_m, double to_m) {
  return std::any_of(outline.mouths.begin(), outline.mouths.end(), [&](const Mouth& mouth) {
    return mouth.road == road && mouth.side == side && from_m < mouth.end_m && to_m > mouth.begin_m;
  });
}

}  // namespace verge::sim
