// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/eval/scene_match.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "verge/eval/clip.hpp"
#include "verge/eval/sides.hpp"

namespace verge::eval {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// A stretch of a boundary between two of its points; both ends alike for a boundary of one point.
struct Piece {
  Segment segment;
  Side side = Side::kOther;
};

Vec2 middle(const Segment& segment) { return 0.5 * (segment.a + segment.b); }

Vec2 nearest_of(const Segment& segment, Vec2 p) {
  const Vec2 d = segment.b - segment.a;
  const double squared = dot(d, d);
  const double t = squared > 0.0 ? std::clamp(dot(p - segment.a, d) / squared, 0.0, 1.0) : 0.0;
  return segment.a + t * d;
}

/// Pieces in order of x, so that a search ends where x alone is farther than what was found.
class Pieces {
 public:
  void add(const Piece& piece) {
    half_width_ = std::max(half_width_, 0.5 * std::fabs(piece.segment.a.x - piece.segment.b.x));
    pieces_.push_back(piece);
  }
  void sort() { std::stable_sort(pieces_.begin(), pieces_.end(), is_left); }

  /// Null where there is none. Of equally near ones that with the least x.
  [[nodiscard]] const Piece* nearest(Vec2 p) const {
    const Piece at{{p, p}, Side::kOther};
    const auto begin = std::lower_bound(pieces_.begin(), pieces_.end(), at, is_left);
    const Piece* best = nullptr;
    double least = kInfinity;
    const auto consider = [&](const Piece& piece) {
      if (std::fabs(middle(piece.segment).x - p.x) - half_width_ > least) return false;
      const double away = distance(nearest_of(piece.segment, p), p);
      if (away < least) {
        least = away;
        best = &piece;
      }
      return true;
    };
    for (auto it = begin; it != pieces_.end() && consider(*it); ++it) {
    }
    for (auto it = begin; it != pieces_.begin() && consider(*std::prev(it)); --it) {
    }
    return best;
  }

 private:
  static bool is_left(const Piece& a, const Piece& b) { return middle(a.segment).x < middle(b.segment).x; }
  std::vector<Piece> pieces_;
  double half_width_ = 0.0;
};

/// The pieces that boundaries of a side are compared with.
Pieces pieces_for(Side side, const Scene& scene, bool any_side) {
  Pieces pieces;
  for (const Boundary& boundary : scene.boundaries) {
    if (!any_side && !goes_with(boundary.side, side)) continue;
    const auto& points = boundary.points;
    if (points.size() == 1) pieces.add({{points[0].xy(), points[0].xy()}, boundary.side});
    for (std::size_t i = 1; i < points.size(); ++i)
      pieces.add({{points[i - 1].xy(), points[i].xy()}, boundary.side});
  }
  pieces.sort();
  return pieces;
}

/// The angle between two lines, in [-pi/2, pi/2].
double line_angle(Vec2 a, Vec2 b) {
  return std::remainder(std::atan2(cross(b, a), dot(b, a)), std::numbers::pi);
}

MatchedSample matched(Vec2 place, const Segment& along, PointState state, const Pieces& others) {
  MatchedSample sample{.place = place, .range_m = norm(place), .state = state, .heading_rad = std::nullopt};
  const Piece* other = others.nearest(place);
  if (other == nullptr) {
    sample.distance_m = sample.outward_m = kInfinity;
    return sample;
  }
  const Segment& line = other->segment;
  sample.distance_m = distance(nearest_of(line, place), place);
  const bool lies_left = cross(line.b - line.a, place - line.a) >= 0.0;
  sample.outward_m = lies_left == (other->side != Side::kRight) ? sample.distance_m : -sample.distance_m;
  if (along.a != along.b && line.a != line.b)
    sample.heading_rad = line_angle(along.b - along.a, line.b - line.a);
  return sample;
}

PointState state_at(const Boundary& boundary, std::size_t vertex) {
  return boundary.state.empty() ? PointState::kVisible : boundary.state[vertex];
}

/// The samples of one boundary: each part inside the range is sampled from its first point on.
void sample_boundary(const Boundary& boundary, const MatchConfig& config, const Pieces& others,
                     std::vector<MatchedSample>& samples) {
  constexpr double kSlack_m = 1e-9;  // a station that rounding pushed just past the end still counts
  if (boundary.points.size() == 1) {
    const Vec2 place = boundary.points[0].xy();
    if (norm(place) <= config.range_m)
      samples.push_back(matched(place, {place, place}, state_at(boundary, 0), others));
  }
  double ahead_m = 0.0;  // from the segment's entry to the next sample
  bool goes_on = false;
  for (std::size_t i = 1; i < boundary.points.size(); ++i) {
    const Segment segment{boundary.points[i - 1].xy(), boundary.points[i].xy()};
    const auto inside = share_inside(segment, config.range_m);
    if (inside) {
      if (!goes_on || inside->first > 0.0) ahead_m = 0.0;
      const double length_m = distance(segment.a, segment.b);
      const double from_m = inside->first * length_m;
      const double reach_m = (inside->second - inside->first) * length_m;
      std::size_t count = 0;
      const auto next_m = [&] { return ahead_m + static_cast<double>(count) * config.step_m; };
      while (next_m() <= reach_m + kSlack_m) {
        const double t = length_m > 0.0 ? std::min(1.0, (from_m + next_m()) / length_m) : 0.0;
        samples.push_back(matched(segment.a + t * (segment.b - segment.a), segment,
                                  state_at(boundary, t < 0.5 ? i - 1 : i), others));
        ++count;
      }
      ahead_m = next_m() - reach_m;
    }
    goes_on = inside && inside->second >= 1.0;
  }
}

std::vector<MatchedSample> samples_of(const Scene& scene, const Scene& other, const MatchConfig& config) {
  std::vector<MatchedSample> samples;
  for (const Side side : {Side::kLeft, Side::kRight, Side::kIsland, Side::kOther}) {
    const Pieces others = pieces_for(side, other, config.any_side);
    for (const Boundary& boundary : scene.boundaries) {
      if (boundary.side == side) sample_boundary(boundary, config, others, samples);
    }
  }
  return samples;
}

}  // namespace

SceneMatch match_boundaries(const Scene& prediction, const Scene& truth, const MatchConfig& config) {
  return {samples_of(prediction, truth, config), samples_of(truth, prediction, config)};
}

}  // namespace verge::eval
