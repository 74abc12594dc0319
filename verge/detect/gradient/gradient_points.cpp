// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/detect/gradient/gradient_points.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace verge::detect::gradient {
namespace {

/// A road's own slope along a scan line is never more.
constexpr double kSlopeMax = 0.15;
constexpr std::size_t kLeastBefore = 5;  // returns that make a line with an error of its own
constexpr std::size_t kLeastAfter = 3;
constexpr double kClimbShare = 0.25;    // of the rise must be a climb from the last returns before it
constexpr double kLeastBefore_m = 0.3;  // shorter lines say nothing of a slope

/// Sums over a stretch of a layer: lengths s along it and heights z.
struct Sums {
  double s = 0.0, z = 0.0, ss = 0.0, sz = 0.0, zz = 0.0;
};

/// Sums over prefixes of a layer, so that a line fit over any stretch of it is O(1). Most returns are asked
/// for heights alone; the other sums are made as far as a stretch that is asked for.
class Prefix {
 public:
  Prefix(const std::vector<double>& arc, const std::vector<Vec3>& points)
      : arc_(arc), points_(points), heights_(points.size() + 1), sums_(1) {
    double height = 0.0;
    auto next = heights_.begin();
    for (const Vec3& p : points) {
      height += p.z;
      *++next = height;
    }
  }

  /// Over the returns [begin, end).
  [[nodiscard]] double height(std::size_t begin, std::size_t end) const {
    return heights_[end] - heights_[begin];
  }
  [[nodiscard]] Sums over(std::size_t begin, std::size_t end) {
    extend(end);
    const Sums& a = sums_[begin];
    const Sums& b = sums_[end];
    return {b.s - a.s, b.z - a.z, b.ss - a.ss, b.sz - a.sz, b.zz - a.zz};
  }

 private:
  void extend(std::size_t end) {
    if (end < sums_.size()) return;
    sums_.reserve(points_.size() + 1);
    Sums sum = sums_.back();
    for (std::size_t i = sums_.size() - 1; i < end; ++i) {
      const double s = arc_[i];
      const double z = points_[i].z;
      sum = {sum.s + s, sum.z + z, sum.ss + s * s, sum.sz + s * z, sum.zz + z * z};
      sums_.push_back(sum);
    }
  }

  const std::vector<double>& arc_;
  const std::vector<Vec3>& points_;
  std::vector<double> heights_;
  std::vector<Sums> sums_;
};

/// Height over arc length on the road's side of a return, as a straight line with its uncertainty.
struct RoadSlope {
  double arc_mean, height_mean, arc_spread, slope = 0.0, variance = 0.0;

  RoadSlope(const Sums& a, double n)
      : arc_mean(a.s / n), height_mean(a.z / n), arc_spread(std::max(a.ss - n * arc_mean * arc_mean, 0.0)) {
    const double cov = a.sz - n * arc_mean * height_mean;
    const double var = a.zz - n * height_mean * height_mean;
    slope = arc_spread > 0.0 ? std::clamp(cov / arc_spread, -kSlopeMax, kSlopeMax) : 0.0;
    variance = std::max(var - 2.0 * slope * cov + slope * slope * arc_spread, 0.0) / (n - 2.0);
  }
  [[nodiscard]] double height_at(double arc) const { return height_mean + slope * (arc - arc_mean); }
  /// Standard error of the mean of n heights around `arc`, held against the extrapolated line.
  [[nodiscard]] double error_at(double arc, double n, double n_before) const {
    const double lever = arc_spread > 0.0 ? (arc - arc_mean) * (arc - arc_mean) / arc_spread : 0.0;
    return std::sqrt(variance * (1.0 / n + 1.0 / n_before + lever));
  }
};

/// Whether what follows return i, up to `after`, climbs from the last returns before it: where a step down
/// ends, what follows lies above the slope of what came before as well.
bool climbs(const Prefix& prefix, std::size_t i, std::size_t after, double rise) {
  constexpr auto kNear = static_cast<double>(kLeastBefore);
  const auto n_after = static_cast<double>(after - i);
  const double before = n_after / kNear * prefix.height(i - kLeastBefore, i);
  // n_after times the climb, since most returns end here: they are of the road.
  return prefix.height(i, after) - before > n_after * (kClimbShare * rise);
}

/// The stretches before and after return i.
struct Windows {
  std::size_t before = 0;  ///< [before, i)
  std::size_t after = 0;   ///< [i, after)
};

/// How much what follows return i stands above the slope of what came before; none where it does not by
/// enough, or does not climb by it.
std::optional<double> rise_at(Prefix& prefix, std::size_t i, const Windows& w, const GradientConfig& config) {
  const auto n_before = static_cast<double>(i - w.before);
  const auto n_after = static_cast<double>(w.after - i);
  const RoadSlope road(prefix.over(w.before, i), n_before);
  const Sums after = prefix.over(i, w.after);
  const double arc_after = after.s / n_after;
  const double rise = after.z / n_after - road.height_at(arc_after);
  if (!(rise > config.rise_min_m) || !climbs(prefix, i, w.after, rise)) return std::nullopt;
  const double error = road.error_at(arc_after, n_after, n_before);
  return rise > config.noise_factor * error ? std::optional(rise) : std::nullopt;
}

/// Whether the piece before return i ends there: a gap across the beams (returns are missing), or one along
/// them over which the height changes too much (a shadow, an obstacle).
bool is_gap(const Layer& layer, std::size_t i, double across, const GradientConfig& config) {
  const Vec3 step = layer.points[i] - layer.points[i - 1];
  const bool climbs = std::abs(step.z) > config.climb_m;
  if (!climbs && across <= config.gap_min_m) return false;  // most returns
  const double spacing = norm(layer.points[i].xy()) * layer.spacing_rad;
  const double widest = std::max(config.gap_min_m, config.gap_factor * spacing);
  return across > widest || (climbs && norm(step.xy()) > widest);
}

}  // namespace

std::vector<double> arc_of(const Layer& layer, const GradientConfig& config) {
  const double apart = config.before_m + config.after_m;
  std::vector<double> arc(layer.points.size(), 0.0);
  for (std::size_t i = 1; i < arc.size(); ++i) {
    const double across = across_beams(layer.points[i - 1], layer.points[i]);
    arc[i] = arc[i - 1] + (is_gap(layer, i, across, config) ? across + apart : across);
  }
  return arc;
}

GradientPoints gradient_points(const Layer& layer, const GradientConfig& config) {
  const std::vector<double> arc = arc_of(layer, config);
  Prefix prefix(arc, layer.points);
  GradientPoints out;
  Windows w;
  for (std::size_t i = kLeastBefore; i < arc.size(); ++i) {
    while (w.after < arc.size() && arc[w.after] <= arc[i] + config.after_m) ++w.after;
    if (w.after - i < kLeastAfter || !climbs(prefix, i, w.after, config.rise_min_m)) continue;
    while (arc[w.before] < arc[i] - config.before_m) ++w.before;
    if (i - w.before < kLeastBefore || arc[i] - arc[w.before] < kLeastBefore_m) continue;
    if (const auto rise = rise_at(prefix, i, w, config)) {
      out.index.push_back(i);
      out.rise_m.push_back(*rise);
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
