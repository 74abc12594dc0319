// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/cluster/breakpoints.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace verge::cluster {
namespace {

using Clusters = std::vector<std::vector<std::size_t>>;

/// Whether b can only be of the surface along x that a is of.
bool runs_along_x(Vec2 a, Vec2 b, const BreakpointOptions& options) {
  const bool is_flat = std::fabs(a.y) <= norm(a) * std::sin(options.incidence_rad);
  return is_flat && std::fabs(b.y - a.y) <= options.beside_m;
}

/// Whether c goes on where a and b point to.
bool goes_straight_on(Vec2 a, Vec2 b, Vec2 c, double straight_m) {
  const Vec2 before = b - a;
  return dot(before, c - b) > 0.0 && std::fabs(cross(before, c - b)) <= straight_m * norm(before);
}

double step_rad(Vec2 a, Vec2 b) { return std::fabs(std::atan2(cross(a, b), dot(a, b))); }

/// For each point the one before it in its cluster; itself where it is the first.
using Chain = std::vector<std::size_t>;

double lambda_rad(std::span<const Vec2> points, const Chain& before, std::size_t k, std::size_t i,
                  const BreakpointOptions& options) {
  const bool is_flat =
      runs_along_x(points[k], points[i], options) ||
      (before[k] != k && goes_straight_on(points[before[k]], points[k], points[i], options.straight_m));
  return is_flat ? options.flat_rad : options.incidence_rad;
}

/// The point before point i that is its surface's last one; i where a breakpoint separates all.
std::size_t joined_to(std::span<const Vec2> points, const Chain& before, std::size_t i,
                      const BreakpointOptions& options) {
  constexpr double kSameShot_rad = 1e-5;
  std::size_t nearest = i;
  double least_m = std::numeric_limits<double>::infinity();
  std::size_t directions = 0;
  for (std::size_t k = i; k-- > 0;) {
    const double from_rad = step_rad(points[k], points[i]);
    if (from_rad > kSameShot_rad && (directions == 0 || step_rad(points[k], points[k + 1]) > kSameShot_rad))
      ++directions;
    if (directions > options.look_back || from_rad > options.step_max_rad) break;
    const double gap_m = distance(points[k], points[i]);
    const double lambda = lambda_rad(points, before, k, i, options);
    if (gap_m >= least_m || gap_m > breakpoint_gap_m(norm(points[k]), from_rad, lambda, options.sigma_m))
      continue;
    nearest = k;
    least_m = gap_m;
  }
  return nearest;
}

/// Which of many are together: each group is known by its first one.
class Groups {
 public:
  explicit Groups(std::size_t size) : parent_(size) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  }

  [[nodiscard]] std::size_t first_of(std::size_t i) const {
    while (parent_[i] != i) i = parent_[i];
    return i;
  }
  void join(std::size_t a, std::size_t b) {
    const std::size_t of_a = first_of(a);
    const std::size_t of_b = first_of(b);
    parent_[std::max(of_a, of_b)] = std::min(of_a, of_b);
  }

 private:
  std::vector<std::size_t> parent_;
};

Chain chain_of(std::span<const Vec2> points, const BreakpointOptions& options) {
  Chain before;
  for (std::size_t i = 0; i < points.size(); ++i) before.push_back(joined_to(points, before, i, options));
  return before;
}

/// The members of each group, in the order of the groups' first ones.
Clusters members_of(const Groups& groups, std::size_t size) {
  Clusters members(size);
  for (std::size_t i = 0; i < size; ++i) members[groups.first_of(i)].push_back(i);
  std::erase_if(members, [](const auto& group) { return group.empty(); });
  return members;
}

struct Box {
  Vec2 low{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  Vec2 high{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
};

Box box_of(std::span<const Vec2> points, const std::vector<std::size_t>& cluster) {
  Box box;
  for (const std::size_t i : cluster) {
    box.low = {std::min(box.low.x, points[i].x), std::min(box.low.y, points[i].y)};
    box.high = {std::max(box.high.x, points[i].x), std::max(box.high.y, points[i].y)};
  }
  return box;
}

bool are_apart(const Box& a, const Box& b, double gap_m) {
  return a.low.x > b.high.x + gap_m || b.low.x > a.high.x + gap_m || a.low.y > b.high.y + gap_m ||
         b.low.y > a.high.y + gap_m;
}

bool touch(std::span<const Vec2> points, const std::vector<std::size_t>& a, const std::vector<std::size_t>& b,
           double gap_m) {
  return std::ranges::any_of(a, [&](std::size_t i) {
    return std::ranges::any_of(b, [&](std::size_t k) { return distance(points[i], points[k]) <= gap_m; });
  });
}

}  // namespace

double breakpoint_gap_m(double range_m, double step_rad, double incidence_rad, double sigma_m) {
  const double noise_m = 3.0 * sigma_m;
  if (step_rad >= incidence_rad) return noise_m;
  return range_m * std::sin(step_rad) / std::sin(incidence_rad - step_rad) + noise_m;
}

Clusters breakpoint_clusters(std::span<const Vec2> points, const BreakpointOptions& options) {
  const std::vector<Vec2> reversed(points.rbegin(), points.rend());
  const Chain forth = chain_of(points, options);
  const Chain back = chain_of(reversed, options);
  Groups groups(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    groups.join(i, forth[i]);
    groups.join(points.size() - 1 - i, points.size() - 1 - back[i]);
  }
  return members_of(groups, points.size());
}

Clusters merge_near(std::span<const Vec2> points, std::span<const std::vector<std::size_t>> clusters,
                    double gap_m) {
  std::vector<Box> boxes;
  for (const auto& cluster : clusters) boxes.push_back(box_of(points, cluster));
  Groups groups(clusters.size());
  for (std::size_t b = 0; b < clusters.size(); ++b) {
    for (std::size_t a = 0; a < b; ++a) {
      if (groups.first_of(a) == groups.first_of(b) || are_apart(boxes[a], boxes[b], gap_m)) continue;
      if (touch(points, clusters[a], clusters[b], gap_m)) groups.join(a, b);
    }
  }
  Clusters merged;
  for (const auto& group : members_of(groups, clusters.size())) {
    auto& all = merged.emplace_back();
    for (const std::size_t i : group) all.insert(all.end(), clusters[i].begin(), clusters[i].end());
    std::ranges::sort(all);
  }
  std::ranges::sort(merged, {}, [](const auto& cluster) { return cluster.front(); });
  return merged;
}

}  // namespace verge::cluster
