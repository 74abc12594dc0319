// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/detect/line_fit/edge_ends.hpp"

#include <algorithm>
#include <cmath>

#include "verge/core/angle.hpp"

namespace verge::detect::line_fit {
namespace {

constexpr double kNext_rad = deg_to_rad(1.5);  // more than the coarsest step

/// The next return of the layer, from point `from` on in steps of +1 or -1; none within
/// kNext_rad.
void add_next(std::span<const LayerPoint> points, std::size_t from, std::ptrdiff_t step,
              std::vector<Vec3>& to) {
  constexpr double kSameShot_rad = 1e-4;
  const auto is_of_layer = [&](std::ptrdiff_t i) {
    return i >= 0 && i < std::ssize(points) &&
           points[static_cast<std::size_t>(i)].layer == points[from].layer;
  };
  for (auto i = static_cast<std::ptrdiff_t>(from) + step; is_of_layer(i); i += step) {
    const LayerPoint& p = points[static_cast<std::size_t>(i)];
    const double step_rad = std::fabs(p.azimuth_rad - points[from].azimuth_rad);
    if (step_rad > kNext_rad) return;
    if (step_rad < kSameShot_rad) continue;
    to.push_back(p.place);
    return;
  }
}

/// Whether the scan has nothing more to that side because the scanner looks no farther. An empty road leaves
/// nothing there as well, but no field ends so near to straight ahead: a LUX's upper layers do at 35 degrees.
bool is_edge_of_field(double azimuth_rad, double outermost_rad) {
  constexpr double kField_rad = deg_to_rad(34.0);
  return std::fabs(azimuth_rad) > kField_rad && std::fabs(outermost_rad - azimuth_rad) < kNext_rad;
}

}  // namespace

Beside::Beside(std::span<const LayerPoint> points, const std::vector<std::size_t>& cluster, double height_m,
               double low_m)
    : height_m_(height_m), low_m_(low_m) {
  struct Ends {
    std::size_t layer = 0;
    std::size_t first = 0;
    std::size_t last = 0;
  };
  std::vector<Ends> layers;
  for (const std::size_t i : cluster) {
    const auto known = std::ranges::find(layers, points[i].layer, &Ends::layer);
    if (known == layers.end()) {
      layers.push_back({points[i].layer, i, i});
      continue;
    }
    known->first = std::min(known->first, i);
    known->last = std::max(known->last, i);
  }
  const auto [rightmost, leftmost] = std::ranges::minmax(points, {}, &LayerPoint::azimuth_rad);
  for (const Ends& ends : layers) {
    left_is_cut_ = left_is_cut_ || is_edge_of_field(points[ends.first].azimuth_rad, leftmost.azimuth_rad);
    right_is_cut_ = right_is_cut_ || is_edge_of_field(points[ends.last].azimuth_rad, rightmost.azimuth_rad);
    add_next(points, ends.first, -1, left_);
    add_next(points, ends.last, 1, right_);
  }
}

EdgeEnd Beside::after(Vec2 end, Vec2 onward) const {
  constexpr double kNearer_m = 0.3;
  constexpr double kNoise_m = 0.15;
  const bool is_left = cross(end, onward) > 0.0;
  EdgeEnd known{.is_cut = is_left ? left_is_cut_ : right_is_cut_};
  for (const Vec3& next : is_left ? left_ : right_) {
    const double across = cross(onward, next.xy());
    if (across == 0.0) continue;
    const double on_m = -cross(end, next.xy()) / across;  // where the ray meets the edge, if that goes on
    const double reach_m = norm(next.xy());
    const double share = dot(end + on_m * onward, next.xy()) / (reach_m * reach_m);  // of its way
    if (on_m < -kNoise_m || share <= 0.0) continue;  // before the end: another layer saw more
    const double beyond_m = (1.0 - share) * reach_m;
    const bool stands = next.z >= low_m_;
    const bool passed_high = beyond_m > kNearer_m && height_m_ + share * (next.z - height_m_) >= low_m_;
    if (beyond_m < -kNearer_m) {
      known.is_hidden = known.is_hidden || stands;
    } else if (stands || passed_high) {
      known.unseen_m = std::min(known.unseen_m, std::max(on_m, 0.0));
    }
  }
  known.is_hidden = known.is_hidden && std::isinf(known.unseen_m);
  return known;
}

}  // namespace verge::detect::line_fit
