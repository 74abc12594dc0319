// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/cluster/kmeans.hpp"

#include <algorithm>
#include <cassert>
#include <iterator>
#include <limits>

namespace verge::cluster {
namespace {

template <class Point>
double squared_distance(Point a, Point b) {
  const Point d = a - b;
  return dot(d, d);
}

bool before(Vec2 a, Vec2 b) { return a.x != b.x ? a.x < b.x : a.y < b.y; }
bool before(Vec3 a, Vec3 b) { return a.x != b.x || a.y != b.y ? before(a.xy(), b.xy()) : a.z < b.z; }

template <class Point>
std::size_t nearest_centre(std::span<const Point> centres, Point p) {
  const auto from_p = [p](const Point& c) { return squared_distance(c, p); };
  return static_cast<std::size_t>(std::ranges::min_element(centres, {}, from_p) - centres.begin());
}

template <class Point>
double sum_of_squares(std::span<const Point> points, const KMeansResult<Point>& result) {
  double sum = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i)
    sum += squared_distance(points[i], result.centres[result.label[i]]);
  return sum;
}

/// Whether any label changed.
template <class Point>
bool assign(std::span<const Point> points, KMeansResult<Point>& result) {
  bool changed = false;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::size_t label = nearest_centre(std::span<const Point>(result.centres), points[i]);
    changed = changed || label != result.label[i];
    result.label[i] = label;
  }
  return changed;
}

template <class Point>
void move_centres(std::span<const Point> points, KMeansResult<Point>& result) {
  std::vector<Point> sums(result.centres.size());
  std::vector<std::size_t> counts(result.centres.size(), 0);
  for (std::size_t i = 0; i < points.size(); ++i) {
    sums[result.label[i]] = sums[result.label[i]] + points[i];
    ++counts[result.label[i]];
  }
  for (std::size_t c = 0; c < sums.size(); ++c) {
    if (counts[c] > 0) result.centres[c] = (1.0 / static_cast<double>(counts[c])) * sums[c];
  }
}

template <class Point>
KMeansResult<Point> lloyd(std::span<const Point> points, std::span<const Point> initial,
                          const KMeansOptions& options) {
  assert(!initial.empty() || points.empty());
  KMeansResult<Point> result;
  result.label.assign(points.size(), initial.size());  // no cluster yet
  result.centres.assign(initial.begin(), initial.end());
  for (int i = 0;; ++i) {
    result.converged = !assign(points, result);
    result.objective.push_back(sum_of_squares(points, result));
    if (result.converged || i >= options.max_iterations) break;
    move_centres(points, result);
  }
  return result;
}

template <class Point>
Point mean_of(std::span<const Point> points) {
  Point sum;
  for (const Point& p : points) sum = sum + p;
  return (1.0 / static_cast<double>(points.size())) * sum;
}

/// The index of the least key; of equals the point that stands lowest.
template <class Point>
std::size_t least(std::span<const Point> points, std::span<const double> keys) {
  std::size_t best = 0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    if (keys[i] < keys[best] || (keys[i] == keys[best] && before(points[i], points[best]))) best = i;
  }
  return best;
}

template <class Point>
std::optional<Point> medoid_of_mean(std::span<const Point> points) {
  if (points.empty()) return std::nullopt;
  const Point mean = mean_of(points);
  std::vector<double> keys(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) keys[i] = squared_distance(points[i], mean);
  return points[least(points, std::span<const double>(keys))];
}

template <class Point>
std::vector<Point> spread(std::span<const Point> points, std::size_t k) {
  if (points.empty() || k == 0) return {};
  std::vector<Point> centres{*medoid_of_mean(points)};
  std::vector<double> keys(
      points.size(),
      -std::numeric_limits<double>::infinity());  // minus the squared distance from the centres
  while (centres.size() < k) {
    for (std::size_t i = 0; i < points.size(); ++i)
      keys[i] = std::max(keys[i], -squared_distance(points[i], centres.back()));
    const std::size_t farthest = least(points, std::span<const double>(keys));
    if (keys[farthest] == 0.0) break;  // every point is a centre
    centres.push_back(points[farthest]);
  }
  return centres;
}

}  // namespace

KMeansResult<Vec2> kmeans(std::span<const Vec2> points, std::span<const Vec2> initial,
                          const KMeansOptions& options) {
  return lloyd(points, initial, options);
}
KMeansResult<Vec3> kmeans(std::span<const Vec3> points, std::span<const Vec3> initial,
                          const KMeansOptions& options) {
  return lloyd(points, initial, options);
}

std::optional<Vec2> nearest_to_mean(std::span<const Vec2> points) { return medoid_of_mean(points); }
std::optional<Vec3> nearest_to_mean(std::span<const Vec3> points) { return medoid_of_mean(points); }

std::vector<Vec2> farthest_first(std::span<const Vec2> points, std::size_t k) { return spread(points, k); }
std::vector<Vec3> farthest_first(std::span<const Vec3> points, std::size_t k) { return spread(points, k); }

std::vector<std::vector<std::size_t>> clusters_of(std::span<const std::size_t> label, std::size_t k) {
  std::vector<std::vector<std::size_t>> clusters(k);
  for (std::size_t i = 0; i < label.size(); ++i) clusters[label[i]].push_back(i);
  return clusters;
}

std::vector<std::vector<std::size_t>> keep_larger_than(std::span<const std::vector<std::size_t>> clusters,
                                                       std::size_t threshold) {
  std::vector<std::vector<std::size_t>> kept;
  std::ranges::copy_if(clusters, std::back_inserter(kept),
                       [=](const auto& cluster) { return cluster.size() > threshold; });
  return kept;
}

}  // namespace verge::cluster
