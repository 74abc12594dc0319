// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/detect/gradient/candidates.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "verge/cluster/kmeans.hpp"
#include "verge/cluster/runs.hpp"
#include "verge/fit/line.hpp"

namespace verge::detect::gradient {
namespace {

std::vector<Vec2> positions(const Layer& layer, const GradientPoints& points) {
  std::vector<Vec2> p;
  p.reserve(points.index.size());
  for (const std::size_t i : points.index) p.push_back(layer.points[i].xy());
  return p;
}

/// m for each adjacent pair: the spacing of a scan line's points grows with range.
std::vector<double> gap_thresholds(const Layer& layer, const std::vector<Vec2>& p,
                                   const GradientConfig& config) {
  std::vector<double> m;
  for (std::size_t i = 1; i < p.size(); ++i) {
    m.push_back(std::max(config.gap_min_m, config.gap_factor * norm(p[i]) * layer.spacing_rad));
  }
  return m;
}

std::vector<std::vector<std::size_t>> members_of(std::span<const cluster::PointRun> runs) {
  std::vector<std::vector<std::size_t>> members;
  for (const cluster::PointRun& run : runs) {
    members.emplace_back();
    for (std::size_t i = run.begin; i < run.end; ++i) members.back().push_back(i);
  }
  return members;
}

std::vector<std::vector<std::size_t>> kmeans_clusters(const std::vector<Vec2>& p,
                                                      const std::vector<Vec2>& start) {
  const auto result = cluster::kmeans(p, start);
  return cluster::clusters_of(result.label, result.centres.size());
}

/// Clusters of at least `least` points, from the road outward.
std::vector<std::vector<std::size_t>> large_ones(std::vector<std::vector<std::size_t>> clusters,
                                                 std::int64_t least) {
  auto kept = cluster::keep_larger_than(clusters, static_cast<std::size_t>(least - 1));
  std::sort(kept.begin(), kept.end(), [](const auto& a, const auto& b) { return a.front() < b.front(); });
  return kept;
}

/// How high the step is over its foot: the scan line is followed outward from `begin` while it climbs. The
/// greatest rise alone says less where the line runs up the face over more than after_m.
double height_over(const Layer& layer, std::size_t begin, Vec3 foot, const GradientConfig& config) {
  constexpr double kReach = 2.0;  // metres: what climbs on is a slope behind the step
  const std::vector<Vec3>& p = layer.points;
  double top = foot.z;
  double since_top = 0.0;
  double walked = 0.0;
  for (std::size_t i = begin + 1; i + 1 < p.size() && since_top <= config.after_m && walked < kReach; ++i) {
    const double step = across_beams(p[i - 1], p[i]);
    const double z = (p[i - 1].z + p[i].z + p[i + 1].z) / 3.0;
    since_top = z > top ? 0.0 : since_top + step;
    walked += step;
    top = std::max(top, z);
  }
  return top - foot.z;
}

/// Root mean square of the points' distances from the line.
double deviation(const fit::Line& line, std::span<const Vec2> points) {
  double squares = 0.0;
  for (const Vec2 p : points) {
    const double d = fit::signed_distance(line, p);
    squares += d * d;
  }
  return std::sqrt(squares / static_cast<double>(points.size()));
}

/// The foot of a step by its own evidence: along the ring, the straight line of the road before the step, and
/// the place where the heights leave it for good. Without it, boundaries sit some 0.1 m up the ramp.
class FootFinder {
 public:
  FootFinder(const Layer& layer, std::size_t begin, std::size_t end) : layer_(layer), first_(begin) {
    constexpr double kFar = 1.25;  // metres of the road before the step
    double before = 0.0;
    for (; first_ > 0; --first_) {
      before += spacing(first_ - 1);
      if (before > kFar) break;
      profile_.push_back({-before, layer.points[first_ - 1].z});
    }
    std::ranges::reverse(profile_);
    step_ = profile_.size();
    double after = 0.0;
    for (std::size_t i = begin; i < end; ++i) {
      profile_.push_back({after, layer.points[i].z});
      after += i + 1 < end ? spacing(i) : 0.0;
    }
  }

  [[nodiscard]] std::optional<Vec3> find() const {
    constexpr std::size_t kLeast = 4;
    for (const double near : {0.35, 0.1}) {
      const std::span<const Vec2> road = road_before(near);
      if (road.size() < kLeast) continue;
      if (const auto line = fit::ordinary_line(road)) return departure(*line, road);
    }
    return std::nullopt;
  }

 private:
  /// From return i to the next one.
  [[nodiscard]] double spacing(std::size_t i) const {
    return across_beams(layer_.points[i], layer_.points[i + 1]);
  }

  /// The returns of the road before the step that are not nearer to it than `near`.
  [[nodiscard]] std::span<const Vec2> road_before(double near) const {
    std::size_t size = 0;
    while (size < step_ && profile_[size].x <= -near) ++size;
    return std::span(profile_).first(size);
  }

  /// Where the heights leave the line of the road for good, looked for from the end of `road` on.
  [[nodiscard]] std::optional<Vec3> departure(const fit::Line& line, std::span<const Vec2> road) const {
    const double on_road = std::max(0.014, 2.5 * deviation(line, road));
    const double off_road = std::max(0.04, 1.5 * on_road);
    const auto height = [&](std::size_t k) { return fit::signed_distance(line, profile_[k]); };
    std::size_t k = road.size();
    while (k < profile_.size() && !(height(k) > off_road)) ++k;
    if (k >= profile_.size()) return std::nullopt;
    while (k > road.size() && height(k) > on_road) --k;
    const std::size_t next = std::min(k + 1, profile_.size() - 1);
    return 0.5 * (layer_.points[first_ + k] + layer_.points[first_ + next]);
  }

  const Layer& layer_;
  std::size_t first_;          ///< Return of the layer where the profile begins.
  std::size_t step_ = 0;       ///< Of the profile, where the step begins.
  std::vector<Vec2> profile_;  ///< (length across the beams from the step, height) of each return.
};

}  // namespace

LayerClusters cluster_layer(const Layer& layer, const GradientPoints& points, const GradientConfig& config) {
  const std::vector<Vec2> p = positions(layer, points);
  if (p.empty()) return {};
  const std::vector<double> d = cluster::adjacent_distances(p);
  if (config.reading == Reading::kPaper) {
    const std::size_t K = cluster::cluster_count_as_printed(d, config.gap_min_m);
    return {K, large_ones(kmeans_clusters(p, cluster::farthest_first(p, K)), config.points_min)};
  }
  const std::vector<cluster::PointRun> runs =
      cluster::gap_separated_runs(p.size(), d, gap_thresholds(layer, p, config));
  const bool by_kmeans = config.clustering == Clustering::kKMeans && runs.size() > 1;
  auto clusters = by_kmeans ? kmeans_clusters(p, cluster::run_means(p, runs)) : members_of(runs);
  return {runs.size(), large_ones(std::move(clusters), config.points_min)};
}

std::optional<Candidate> first_outward(const Layer& layer, const GradientPoints& points,
                                       const LayerClusters& clusters, const Obstacles& obstacles,
                                       const GradientConfig& config) {
  if (clusters.clusters.empty()) return std::nullopt;
  const std::vector<std::size_t>& first = clusters.clusters.front();
  const auto peak = *std::max_element(first.begin(), first.end(), [&](std::size_t a, std::size_t b) {
    return points.rise_m[a] < points.rise_m[b];
  });
  if (points.rise_m[peak] > config.rise_max_m) return std::nullopt;
  const std::size_t begin = points.index[first.front()];
  const std::size_t end = std::min(std::max(points.index[peak], begin + 1) + 1, layer.points.size());
  const Vec3 foot = FootFinder(layer, begin, end).find().value_or(layer.points[begin]);
  const double height = std::max(points.rise_m[peak], height_over(layer, begin, foot, config));
  return Candidate{layer.ring, layer.elevation_rad, foot, height, obstacles.stand_above(foot, layer.region)};
}

}  // namespace verge::detect::gradient
