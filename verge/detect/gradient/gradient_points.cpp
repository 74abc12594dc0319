// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/detect/gradient/gradient_points.hpp"

#include <algorithm>
#include <cmath>

namespace verge::detect::gradient {
namespace {

/// A road's own slope along a scan line is never more.
constexpr double kSlopeMax = 0.15;
constexpr std::size_t kLeastBefore = 5;  // returns that make a line with an error of its own
constexpr std::size_t kLeastAfter = 3;
constexpr double kClimbShare = 0.25;    // of the rise must be a climb from the last returns before it
constexpr double kLeastBefore_m = 0.3;  // shorter lines say nothing of a slope

/// Sums over prefixes of a layer, so that a line fit over any stretch of it is O(1).
struct Prefix {
  struct Sums {
    double n = 0.0, s = 0.0, z = 0.0, ss = 0.0, sz = 0.0, zz = 0.0;
  };
  std::vector<Sums> sums;

  Prefix(const std::vector<double>& arc, const std::vector<Vec3>& points) : sums(points.size() + 1) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double s = arc[i];
      const double z = points[i].z;
      const Sums& b = sums[i];
      sums[i + 1] = {b.n + 1.0, b.s + s, b.z + z, b.ss + s * s, b.sz + s * z, b.zz + z * z};
    }
  }
  [[nodiscard]] Sums over(std::size_t begin, std::size_t end) const {
    const Sums& a = sums[begin];
    const Sums& b = sums[end];
    return {b.n - a.n, b.s - a.s, b.z - a.z, b.ss - a.ss, b.sz - a.sz, b.zz - a.zz};
  }
};

/// Height over arc length on the road's side of a return, as a straight line with its uncertainty.
struct RoadSlope {
  double arc_mean, height_mean, arc_spread, slope = 0.0, variance = 0.0;

  explicit RoadSlope(const Prefix::Sums& a)
      : arc_mean(a.s / a.n),
        height_mean(a.z / a.n),
        arc_spread(std::max(a.ss - a.n * arc_mean * arc_mean, 0.0)) {
    const double cov = a.sz - a.n * arc_mean * height_mean;
    const double var = a.zz - a.n * height_mean * height_mean;
    slope = arc_spread > 0.0 ? std::clamp(cov / arc_spread, -kSlopeMax, kSlopeMax) : 0.0;
    variance = std::max(var - 2.0 * slope * cov + slope * slope * arc_spread, 0.0) / (a.n - 2.0);
  }
  [[nodiscard]] double height_at(double arc) const { return height_mean + slope * (arc - arc_mean); }
  /// Standard error of the mean of n heights around `arc`, held against the extrapolated line.
  [[nodiscard]] double error_at(double arc, double n, double n_before) const {
    const double lever = arc_spread > 0.0 ? (arc - arc_mean) * (arc - arc_mean) / arc_spread : 0.0;
    return std::sqrt(variance * (1.0 / n + 1.0 / n_before + lever));
  }
};

/// Mean height of the last returns before i: where a step down ends, what follows lies above the extrapolated
/// slope but not above these.
double height_before(const Prefix& prefix, std::size_t before, std::size_t i) {
  const std::size_t near = i - before > kLeastBefore ? i - kLeastBefore : before;
  const Prefix::Sums last = prefix.over(near, i);
  return last.z / last.n;
}

/// The stretches before and after return i, within its piece.
struct Windows {
  std::size_t before = 0;  ///< [before, i)
  std::size_t after = 0;   ///< [i, after)
};

}  // namespace

std::vector<double> arc_of(const Layer& layer) {
  std::vector<double> arc(layer.points.size(), 0.0);
  for (std::size_t i = 1; i < arc.size(); ++i) {
    arc[i] = arc[i - 1] + across_beams(layer.points[i - 1], layer.points[i]);
  }
  return arc;
}

std::vector<std::size_t> pieces_of(const Layer& layer, const std::vector<double>& arc,
                                   const GradientConfig& config) {
  std::vector<std::size_t> piece(arc.size(), 0);
  for (std::size_t i = 1; i < arc.size(); ++i) {
    const double spacing = norm(layer.points[i].xy()) * layer.spacing_rad;
    const double widest = std::max(config.gap_min_m, config.gap_factor * spacing);
    const Vec3 step = layer.points[i] - layer.points[i - 1];
    const bool jumps = norm(step.xy()) > widest && std::abs(step.z) > config.climb_m;
    const bool gap = arc[i] - arc[i - 1] > widest || jumps;
    piece[i] = piece[i - 1] + (gap ? 1 : 0);
  }
  return piece;
}

GradientPoints gradient_points(const Layer& layer, const GradientConfig& config) {
  const std::vector<double> arc = arc_of(layer);
  const std::vector<std::size_t> piece = pieces_of(layer, arc, config);
  const Prefix prefix(arc, layer.points);
  GradientPoints out;
  Windows w;
  for (std::size_t i = 0; i < arc.size(); ++i) {
    while (piece[w.before] != piece[i] || arc[w.before] < arc[i] - config.before_m) ++w.before;
    w.after = std::max(w.after, i);
    while (w.after < arc.size() && piece[w.after] == piece[i] && arc[w.after] <= arc[i] + config.after_m)
      ++w.after;
    if (i - w.before < kLeastBefore || w.after - i < kLeastAfter || arc[i] - arc[w.before] < kLeastBefore_m)
      continue;
    const Prefix::Sums before = prefix.over(w.before, i);
    const Prefix::Sums after = prefix.over(i, w.after);
    const RoadSlope road(before);
    const double arc_after = after.s / after.n;
    const double rise = after.z / after.n - road.height_at(arc_after);
    const double error = road.error_at(arc_after, after.n, before.n);
    const bool climbs = after.z / after.n - height_before(prefix, w.before, i) > kClimbShare * rise;
    if (climbs && rise > std::max(config.rise_min_m, config.noise_factor * error)) {
      out.index.push_back(i);
      out.rise_m.push_back(rise);
    }
  }
  return out;
}

GradientPoints gradient_points_as_printed(const Layer& layer, const GradientConfig& config) {
  constexpr double kFallingShare = 0.3;
  const std::vector<Vec3>& p = layer.points;
  GradientPoints out;
  const auto accept = [&](std::size_t begin, std::size_t end) {
    const double rise = p[end - 1].z - p[begin].z;
    const bool enough = static_cast<std::int64_t>(end - begin) >= config.points_min;
    if (!enough || rise < config.rise_min_m || rise > config.rise_max_m) return;
    for (std::size_t i = begin; i < end; ++i) {
      out.index.push_back(i);
      out.rise_m.push_back(rise);
    }
  };
  std::size_t begin = 0;
  std::size_t falls = 0;
  for (std::size_t i = 1; i < p.size(); ++i) {
    if (p[i].z <= p[i - 1].z) ++falls;
    if (static_cast<double>(falls) <= kFallingShare * static_cast<double>(i - begin)) continue;
    accept(begin, i);
    begin = i;
    falls = 0;
  }
  if (!p.empty()) accept(begin, p.size());
  return out;
}

}  // namespace verge::detect::gradient
