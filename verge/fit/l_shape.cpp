// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/fit/l_shape.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "verge/fit/finite.hpp"

namespace verge::fit {
namespace {

constexpr double kQuarterTurn = 0.5 * std::numbers::pi;

/// Axes at a heading: `along` points to it, `across` to its left.
struct Axes {
  explicit Axes(double heading_rad)
      : along{std::cos(heading_rad), std::sin(heading_rad)}, across{-along.y, along.x} {}

  [[nodiscard]] Vec2 place(Vec2 p) const { return {dot(along, p), dot(across, p)}; }
  [[nodiscard]] Vec2 point(Vec2 place) const { return place.x * along + place.y * across; }

  Vec2 along;
  Vec2 across;
};

/// The rectangle around points, in the axes: which sides look towards the viewer, and where they are.
struct Sides {
  double along = 0.0;   ///< Place, along, of the edge that runs across.
  double across = 0.0;  ///< Place, across, of the edge that runs along.
};

Sides nearest_sides(std::span<const Vec2> places, Vec2 viewer) {
  Vec2 low = places.front();
  Vec2 high = places.front();
  for (const Vec2 p : places) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  return {2.0 * viewer.x < low.x + high.x ? low.x : high.x, 2.0 * viewer.y < low.y + high.y ? low.y : high.y};
}

/// Distances of a point in the axes from both edges.
struct Off {
  double along_edge_m = 0.0;   ///< From the edge that runs along.
  double across_edge_m = 0.0;  ///< From the edge that runs across.
};

Off off(const Sides& sides, Vec2 place) {
  return {std::fabs(place.y - sides.across), std::fabs(place.x - sides.along)};
}

double closeness(std::span<const Vec2> places, const Sides& sides, double nearest_m) {
  double sum = 0.0;
  for (const Vec2 place : places) {
    const Off from = off(sides, place);
    sum += 1.0 / std::max(std::min(from.along_edge_m, from.across_edge_m), nearest_m);
  }
  return sum;
}

/// Running mean of squares about the mean.
class Variance {
 public:
  void add(double value) {
    ++count_;
    sum_ += value;
    squares_ += value * value;
  }
  [[nodiscard]] double value() const {
    if (count_ == 0) return 0.0;
    const auto n = static_cast<double>(count_);
    return squares_ / n - (sum_ / n) * (sum_ / n);
  }

 private:
  std::size_t count_ = 0;
  double sum_ = 0.0;
  double squares_ = 0.0;
};

double variance(std::span<const Vec2> places, const Sides& sides) {
  Variance along;
  Variance across;
  for (const Vec2 place : places) {
    const Off from = off(sides, place);
    if (from.along_edge_m < from.across_edge_m) {
      along.add(from.along_edge_m);
    } else {
      across.add(from.across_edge_m);
    }
  }
  return -along.value() - across.value();
}

/// Points and viewer turned into axes; its storage serves many headings.
class Turned {
 public:
  Turned(std::span<const Vec2> points, Vec2 viewer)
      : points_(points), viewer_(viewer), places_(points.size()) {}

  double score(double heading_rad, const LShapeOptions& options) {
    const Axes axes(heading_rad);
    std::ranges::transform(points_, places_.begin(), [&](Vec2 p) { return axes.place(p); });
    const Sides sides = nearest_sides(places_, axes.place(viewer_));
    return options.criterion == LShapeCriterion::kCloseness ? closeness(places_, sides, options.nearest_m)
                                                            : variance(places_, sides);
  }

 private:
  std::span<const Vec2> points_;
  Vec2 viewer_;
  std::vector<Vec2> places_;
};

/// The best of `steps` headings from begin_rad on.
double best_heading(Turned& turned, double begin_rad, double step_rad, int steps,
                    const LShapeOptions& options) {
  double best_rad = begin_rad;
  double best = -std::numeric_limits<double>::infinity();
  for (int i = 0; i < steps; ++i) {
    const double heading_rad = begin_rad + i * step_rad;
    const double score = turned.score(heading_rad, options);
    if (score > best) best_rad = heading_rad;
    best = std::max(best, score);
  }
  return best_rad;
}

double searched_heading(std::span<const Vec2> points, Vec2 viewer, const LShapeOptions& options) {
  Turned turned(points, viewer);
  const int coarse = static_cast<int>(std::lround(kQuarterTurn / options.step_rad));
  const double near_rad = best_heading(turned, 0.0, options.step_rad, coarse, options);
  const int fine = static_cast<int>(std::lround(options.step_rad / options.refine_rad));
  return best_heading(turned, near_rad - fine * options.refine_rad, options.refine_rad, 2 * fine + 1,
                      options);
}

/// Which of the points belong to the edge that runs along, which to the other.
struct Parts {
  std::vector<std::size_t> along{};
  std::vector<std::size_t> across{};
};

Parts parts_of(std::span<const Vec2> places, const Sides& sides) {
  Parts parts;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Off from = off(sides, places[i]);
    (from.along_edge_m <= from.across_edge_m ? parts.along : parts.across).push_back(i);
  }
  return parts;
}

Vec2 mean_of(std::span<const Vec2> places, std::span<const std::size_t> part) {
  Vec2 sum;
  for (const std::size_t i : part) sum = sum + places[i];
  return (1.0 / static_cast<double>(part.size())) * sum;
}

Sides mean_sides(std::span<const Vec2> places, const Parts& parts, Sides sides) {
  if (!parts.along.empty()) sides.across = mean_of(places, parts.along).y;
  if (!parts.across.empty()) sides.along = mean_of(places, parts.across).x;
  return sides;
}

/// Second moments about the mean, summed.
struct Moments {
  double xx = 0.0;
  double xy = 0.0;
  double yy = 0.0;
};

Moments moments(std::span<const Vec2> points, std::span<const std::size_t> part) {
  Moments m;
  if (part.empty()) return m;
  const Vec2 mean = mean_of(points, part);
  for (const std::size_t i : part) {
    const Vec2 d = points[i] - mean;
    m.xx += d.x * d.x;
    m.xy += d.x * d.y;
    m.yy += d.y * d.y;
  }
  return m;
}

/// The heading of the edge that runs along which makes the squared distances from both edges least: what lies
/// on the other edge counts turned by a quarter. `otherwise` where no heading is better than another.
double least_squares_heading(std::span<const Vec2> points, const Parts& parts, double otherwise) {
  const Moments along = moments(points, parts.along);
  const Moments across = moments(points, parts.across);
  const double difference = along.xx + across.yy - along.yy - across.xx;
  const double twice_xy = 2.0 * (along.xy - across.xy);
  if (!(std::hypot(difference, twice_xy) > 0.0)) return otherwise;
  return 0.5 * std::atan2(twice_xy, difference);
}

std::vector<Vec2> places_in(const Axes& axes, std::span<const Vec2> points) {
  std::vector<Vec2> places(points.size());
  std::ranges::transform(points, places.begin(), [&](Vec2 p) { return axes.place(p); });
  return places;
}

/// The edge that holds that part of the places.
LEdge edge_of(std::span<const Vec2> places, std::vector<std::size_t> part, const Axes& axes,
              const Sides& sides, bool runs_along) {
  const Vec2 corner{sides.along, sides.across};
  LEdge edge{std::move(part), axes.point(corner), axes.point(corner), 0.0};
  double nearest_m = std::numeric_limits<double>::infinity();
  double farthest_m = -1.0;
  double squares = 0.0;
  for (const std::size_t i : edge.points) {
    const Vec2 foot = runs_along ? Vec2{places[i].x, corner.y} : Vec2{corner.x, places[i].y};
    const double from_corner_m = distance(foot, corner);
    if (from_corner_m < nearest_m) edge.begin = axes.point(foot);
    if (from_corner_m > farthest_m) edge.end = axes.point(foot);
    nearest_m = std::min(nearest_m, from_corner_m);
    farthest_m = std::max(farthest_m, from_corner_m);
    squares += dot(places[i] - foot, places[i] - foot);
  }
  if (!edge.points.empty()) edge.rms_m = std::sqrt(squares / static_cast<double>(edge.points.size()));
  return edge;
}

bool can_be_fitted(std::span<const Vec2> points) {
  return all_finite(points) && std::ranges::any_of(points, [&](Vec2 p) { return p != points.front(); });
}

/// A heading and what of the points follows from it.
struct Assigned {
  Axes axes;
  std::vector<Vec2> places;
  Parts parts;
  Sides sides;
};

Assigned assigned(std::span<const Vec2> points, Vec2 viewer, double heading_rad) {
  const Axes axes(heading_rad);
  std::vector<Vec2> places = places_in(axes, points);
  const Sides outermost = nearest_sides(places, axes.place(viewer));
  const Sides first = mean_sides(places, parts_of(places, outermost), outermost);
  Parts parts = parts_of(places, first);
  const Sides sides = mean_sides(places, parts, outermost);
  return {axes, std::move(places), std::move(parts), sides};
}

/// The same heading, of either edge, in [0, pi / 2).
double within_quarter(double heading_rad) {
  const double within = heading_rad - kQuarterTurn * std::floor(heading_rad / kQuarterTurn);
  return within < kQuarterTurn ? within : 0.0;
}

}  // namespace

double l_shape_score(std::span<const Vec2> points, Vec2 viewer, double heading_rad,
                     const LShapeOptions& options) {
  return Turned(points, viewer).score(heading_rad, options);
}

std::optional<LShape> l_shape_along(std::span<const Vec2> points, Vec2 viewer, double heading_rad) {
  if (!can_be_fitted(points)) return std::nullopt;
  const double heading = within_quarter(heading_rad);
  Assigned fit = assigned(points, viewer, heading);
  LShape shape{fit.axes.point({fit.sides.along, fit.sides.across}), heading, {}};
  shape.edges[0] = edge_of(fit.places, std::move(fit.parts.along), fit.axes, fit.sides, true);
  shape.edges[1] = edge_of(fit.places, std::move(fit.parts.across), fit.axes, fit.sides, false);
  return shape;
}

std::optional<LShape> fit_l_shape(std::span<const Vec2> points, Vec2 viewer, const LShapeOptions& options) {
  if (!can_be_fitted(points)) return std::nullopt;
  constexpr int kRounds = 3;
  double heading_rad = searched_heading(points, viewer, options);
  for (int i = 0; i < kRounds; ++i)
    heading_rad = least_squares_heading(points, assigned(points, viewer, heading_rad).parts, heading_rad);
  return l_shape_along(points, viewer, heading_rad);
}

}  // namespace verge::fit
