// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/detect/road_width/kerb_profile.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "verge/core/statistics.hpp"

namespace verge::detect::road_width {
namespace {

bool is_before(const KerbSight& sight, double along_m) { return sight.along_m < along_m; }

/// Those of the points within `within_m` of the straight line through all of them that runs in `heading`, or
/// of `line`.
template <class Distance>
std::vector<Vec2> near_ones(std::span<const Vec2> points, double within_m, Distance&& distance_m) {
  std::vector<Vec2> near;
  for (const Vec2 p : points) {
    if (std::fabs(distance_m(p)) <= within_m) near.push_back(p);
  }
  return near;
}

/// How much the road has moved out on this side because it bends: as much as it moved in on the other.
double bend_m(const KerbSight& sight, const StraightKerb* other) {
  constexpr double kMost_m = 0.5;  // more is something that stands on the road
  if (other == nullptr || sight.opposite_kind != SightKind::kKerb) return 0.0;
  const double inward_m = -other->outward_m(sight.opposite);
  return inward_m > 0.0 && inward_m < kMost_m ? inward_m : 0.0;
}

}  // namespace

void KerbProfile::see(const KerbSight& sight) {
  const auto behind =
      std::upper_bound(sights_.begin(), sights_.end(), sight.along_m,
                       [](double along_m, const KerbSight& other) { return along_m < other.along_m; });
  sights_.insert(behind, sight);
}

void KerbProfile::forget_before(double along_m) {
  sights_.erase(sights_.begin(), std::lower_bound(sights_.begin(), sights_.end(), along_m, is_before));
}

std::optional<StraightKerb> KerbProfile::straight(double from_m, double to_m, Vec2 heading, bool left) const {
  constexpr std::size_t kLeast = 8;
  constexpr double kLeast_m = 3.0;
  constexpr double kCoarse_m = 0.3;  // about the median, along the heading
  constexpr double kFine_m = 0.12;   // about the line through those
  std::vector<Vec2> points;
  std::vector<double> across;
  for (auto it = std::lower_bound(sights_.begin(), sights_.end(), from_m, is_before);
       it != sights_.end() && it->along_m <= to_m; ++it) {
    if (it->kind != SightKind::kKerb) continue;
    points.push_back(it->end);
    across.push_back(cross(heading, it->end - points.front()));
  }
  const auto middle_m = median(across);
  if (!middle_m) return std::nullopt;
  const Vec2 origin = points.front();
  const auto coarse =
      near_ones(points, kCoarse_m, [&](Vec2 p) { return cross(heading, p - origin) - *middle_m; });
  const auto line = fit::orthogonal_line(coarse);
  if (!line) return std::nullopt;
  const auto fine = near_ones(coarse, kFine_m, [&](Vec2 p) { return fit::signed_distance(*line, p); });
  const auto fit = fit::fit_line(fine);
  if (!fit || fine.size() < kLeast || distance(fine.front(), fine.back()) < kLeast_m) return std::nullopt;
  const double along = dot(fit->line.direction, heading) < 0.0 ? -1.0 : 1.0;
  return StraightKerb{fit->line, left ? along : -along, fit->residuals.rms_m};
}

std::vector<KerbPoint> KerbProfile::against(const StraightKerb& kerb, const StraightKerb* other,
                                            double from_m) const {
  constexpr double kSetback_m = 0.6;
  constexpr double kOpen_m = 4.0;
  std::vector<KerbPoint> points;
  for (auto it = std::lower_bound(sights_.begin(), sights_.end(), from_m, is_before); it != sights_.end();
       ++it) {
    const double outward_m = kerb.outward_m(it->end) - bend_m(*it, other);
    const bool on_kerb = it->kind == SightKind::kThing && outward_m < kSetback_m;
    const bool seen_through = it->kind == SightKind::kOpen && outward_m > 0.0;
    points.push_back({.along_m = it->along_m,
                      .outward_m = on_kerb        ? std::min(outward_m, 0.0)
                                   : seen_through ? std::max(outward_m, kOpen_m)
                                                  : outward_m});
    if (seen_through) points.back().open = Vec2{it->ahead_m, -kerb.outward_m(it->from)};
  }
  return points;
}

}  // namespace verge::detect::road_width
