// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/eval/label_edges.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

#include "verge/core/statistics.hpp"
#include "verge/eval/join_points.hpp"

namespace verge::eval {
namespace {

/// What is asked of a ring again and again.
struct Ring {
  std::span<const Vec3> points;
  std::vector<Surface> kind;

  [[nodiscard]] bool tells() const { return points.size() > 2; }
};

struct Found {
  LabelledTruth truth;
  std::vector<RingPoint> edges;
  std::vector<RingPoint> parking_edges;
};

double distance_in_plane(Vec3 a, Vec3 b) { return std::hypot(a.x - b.x, a.y - b.y); }

Vec3 midpoint(Vec3 a, Vec3 b) { return {(a.x + b.x) / 2.0, (a.y + b.y) / 2.0, (a.z + b.z) / 2.0}; }

bool is_change(Surface a, Surface b, Surface one, Surface other) {
  return (a == one && b == other) || (a == other && b == one);
}

/// Gives runs of under 4 values between two of one other kind that kind, front to back.
void remove_flicker(std::vector<Surface>& kind) {
  constexpr std::size_t kShortestRun = 4;
  std::vector<std::size_t> cuts{0};
  for (std::size_t i = 1; i < kind.size(); ++i) {
    if (kind[i] != kind[i - 1]) cuts.push_back(i);
  }
  for (std::size_t run = 1; run + 1 < cuts.size(); ++run) {
    const std::size_t begin = cuts[run];
    const std::size_t end = cuts[run + 1];
    if (end - begin >= kShortestRun || kind[begin - 1] != kind[end]) continue;
    std::fill(kind.begin() + static_cast<std::ptrdiff_t>(begin),
              kind.begin() + static_cast<std::ptrdiff_t>(end), kind[end]);
  }
}

Ring ring_of(const LabelledRing& labelled, LabelScheme scheme) {
  Ring ring{labelled.points, {}};
  for (const std::uint32_t label : labelled.labels) ring.kind.push_back(surface_of(scheme, label));
  remove_flicker(ring.kind);
  return ring;
}

/// Median height of `count` points of the ring from `first` on that lie 0.1 to 0.5 m from `middle`.
std::optional<double> height_beside(std::span<const Vec3> ring, std::size_t first, std::size_t count,
                                    Vec3 middle) {
  std::vector<double> heights;
  for (std::size_t k = 0; k < count; ++k) {
    const Vec3 p = ring[(first + k) % ring.size()];
    const double away = distance_in_plane(p, middle);
    if (away > 0.1 && away < 0.5) heights.push_back(p.z);
  }
  return median(heights);
}

/// Height difference of the ground before and after the gap between points i and i + 1.
std::optional<double> step_at(std::span<const Vec3> ring, std::size_t i) {
  constexpr std::size_t kBeside = 25;
  const Vec3 middle = midpoint(ring[i], ring[(i + 1) % ring.size()]);
  // i - 24 to i, kept above zero by whole turns.
  const std::size_t before = i + ring.size() * kBeside - (kBeside - 1);
  const auto a = height_beside(ring, before, kBeside, middle);
  const auto b = height_beside(ring, i + 1, kBeside, middle);
  return a && b ? std::optional(std::fabs(*a - *b)) : std::nullopt;
}

/// Along one ring: true points, stretches in which the label changes unseen, edges of parking areas.
void look_along(const Ring& ring, std::size_t number, double gap_m, Found& found) {
  constexpr double kWidest_m = 3.0;
  for (std::size_t i = 0; i < ring.points.size(); ++i) {
    const std::size_t next = (i + 1) % ring.points.size();
    const Vec3 p = ring.points[i];
    const Vec3 q = ring.points[next];
    const double width = distance_in_plane(p, q);
    const Surface a = ring.kind[i];
    const Surface b = ring.kind[next];
    const bool is_edge = is_change(a, b, Surface::kDrivable, Surface::kOff);
    const bool is_parking_edge = is_change(a, b, Surface::kDrivable, Surface::kEither) ||
                                 is_change(a, b, Surface::kEither, Surface::kOff);
    if (is_edge && width < gap_m) {
      const Vec2 place = midpoint(p, q).xy();
      found.truth.points.push_back({place, step_at(ring.points, i)});
      found.edges.push_back({place, number});
    } else if ((is_edge || is_parking_edge) && width < kWidest_m) {
      found.truth.hidden.push_back({p.xy(), q.xy()});
    }
    if (is_parking_edge && width < kWidest_m) found.parking_edges.push_back({midpoint(p, q).xy(), number});
  }
}

std::vector<double> azimuths_of(std::span<const Vec3> points) {
  std::vector<double> azimuths;
  azimuths.reserve(points.size());
  for (const Vec3 p : points) azimuths.push_back(std::atan2(p.y, p.x));
  return azimuths;
}

/// From a ring to the next one: stretches along one azimuth whose ends differ in kind.
void look_across(const Ring& ring, const Ring& next, Found& found) {
  constexpr double kSameAzimuth_rad = 0.01;
  constexpr double kWidest_m = 6.0;
  const std::vector<double> from = azimuths_of(ring.points);
  const std::vector<double> to = azimuths_of(next.points);
  std::vector<std::size_t> order(to.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return to[a] < to[b]; });
  for (std::size_t i = 0; i < from.size(); ++i) {
    if (ring.kind[i] == Surface::kUnknown) continue;
    const auto at = std::lower_bound(order.begin(), order.end(), from[i],
                                     [&](std::size_t j, double azimuth) { return to[j] < azimuth; });
    const std::size_t j = at == order.end() ? order.back() : *at;
    const bool differs = next.kind[j] != Surface::kUnknown && next.kind[j] != ring.kind[i];
    if (!differs || std::fabs(to[j] - from[i]) >= kSameAzimuth_rad) continue;
    if (distance_in_plane(ring.points[i], next.points[j]) < kWidest_m)
      found.truth.hidden.push_back({ring.points[i].xy(), next.points[j].xy()});
  }
}

std::vector<Vec2> ground_of(std::span<const LabelledRing> rings, LabelScheme scheme) {
  std::vector<Vec2> ground;
  for (const LabelledRing& ring : rings) {
    for (std::size_t i = 0; i < ring.points.size(); ++i) {
      if (is_ground(scheme, ring.labels[i])) ground.push_back(ring.points[i].xy());
    }
  }
  return ground;
}

}  // namespace

LabelledTruth find_label_edges(std::span<const LabelledRing> labelled, LabelScheme scheme, double gap_m) {
  std::vector<Ring> rings;
  rings.reserve(labelled.size());
  for (const LabelledRing& ring : labelled) rings.push_back(ring_of(ring, scheme));
  Found found;
  for (std::size_t r = 0; r < rings.size(); ++r) {
    if (!rings[r].tells()) continue;
    look_along(rings[r], r, gap_m, found);
    if (r + 1 < rings.size() && rings[r + 1].tells()) look_across(rings[r], rings[r + 1], found);
  }
  const std::vector<Segment> parking = join_rings(found.parking_edges);
  found.truth.hidden.insert(found.truth.hidden.end(), parking.begin(), parking.end());
  found.truth.segments = join_rings(found.edges);
  found.truth.ground = ground_of(labelled, scheme);
  return std::move(found.truth);
}

}  // namespace verge::eval
