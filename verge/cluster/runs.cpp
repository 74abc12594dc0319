// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/cluster/runs.hpp"

#include <algorithm>
#include <cassert>
#include <iterator>

namespace verge::cluster {
namespace {

template <class Point>
std::vector<double> distances(std::span<const Point> points) {
  std::vector<double> d;
  if (!points.empty()) d.reserve(points.size() - 1);
  for (std::size_t i = 1; i < points.size(); ++i) d.push_back(norm(points[i - 1] - points[i]));
  return d;
}

template <class Point>
std::vector<Point> means(std::span<const Point> points, std::span<const PointRun> runs) {
  std::vector<Point> out;
  out.reserve(runs.size());
  for (const PointRun& run : runs) {
    assert(run.size() > 0);
    Point sum;
    for (const Point& p : points.subspan(run.begin, run.size())) sum = sum + p;
    out.push_back((1.0 / static_cast<double>(run.size())) * sum);
  }
  return out;
}

}  // namespace

std::vector<double> adjacent_distances(std::span<const Vec2> points) { return distances(points); }
std::vector<double> adjacent_distances(std::span<const Vec3> points) { return distances(points); }

std::vector<PointRun> gap_separated_runs(std::size_t points, std::span<const double> d,
                                         std::span<const double> m) {
  assert(d.size() == m.size() && (points == 0 ? d.empty() : d.size() == points - 1));
  std::vector<PointRun> runs;
  std::size_t begin = 0;
  for (std::size_t i = 0; i < d.size(); ++i) {
    if (!(d[i] > m[i])) continue;
    runs.push_back({begin, i + 1});
    begin = i + 1;
  }
  if (points > 0) runs.push_back({begin, points});
  return runs;
}

std::vector<PointRun> gap_separated_runs(std::size_t points, std::span<const double> d, double m) {
  return gap_separated_runs(points, d, std::vector<double>(d.size(), m));
}

std::size_t cluster_count_as_printed(std::span<const double> d, std::span<const double> m) {
  assert(d.size() == m.size());
  std::size_t k = 1;
  for (std::size_t i = 1; i <= d.size(); ++i) {
    if (d[i - 1] > m[i - 1]) k = i;
  }
  return k;
}

std::size_t cluster_count_as_printed(std::span<const double> d, double m) {
  return cluster_count_as_printed(d, std::vector<double>(d.size(), m));
}

std::vector<PointRun> keep_larger_than(std::span<const PointRun> runs, std::size_t threshold) {
  std::vector<PointRun> kept;
  std::ranges::copy_if(runs, std::back_inserter(kept),
                       [=](const PointRun& run) { return run.size() > threshold; });
  return kept;
}

std::vector<Vec2> run_means(std::span<const Vec2> points, std::span<const PointRun> runs) {
  return means(points, runs);
}
std::vector<Vec3> run_means(std::span<const Vec3> points, std::span<const PointRun> runs) {
  return means(points, runs);
}

}  // namespace verge::cluster
