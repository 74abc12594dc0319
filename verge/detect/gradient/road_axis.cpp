// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/detect/gradient/road_axis.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <utility>

namespace verge::detect::gradient {
namespace {

/// Direction in which the last metres of a boundary run; none while it is too short to tell.
std::optional<Vec2> last_direction(const std::vector<Vec2>& feet) {
  constexpr double kBase = 3.0;  // metres: feet jitter by some 0.05
  for (std::size_t k = feet.size(); k-- > 0;) {
    const double length = distance(feet[k], feet.back());
    if (length >= kBase) return (1.0 / length) * (feet.back() - feet[k]);
  }
  return std::nullopt;
}

/// The returns of a ring ahead, counter-clockwise, or those behind, which the seam parts in two.
std::vector<std::span<const Vec3>> half_of(const LowRing& ring, bool front) {
  const std::span<const Vec3> all(ring.points);
  const auto index_of = [&](auto&& is_before) {
    return static_cast<std::size_t>(std::ranges::partition_point(all, is_before) - all.begin());
  };
  const std::size_t begin = index_of([](Vec3 p) { return p.y < 0.0 && p.x < 0.0; });
  const std::size_t end = index_of([](Vec3 p) { return p.y < 0.0 || p.x >= 0.0; });
  if (front) return {all.subspan(begin, end - begin)};
  return {all.subspan(end), all.first(begin)};
}

}  // namespace

void RoadAxis::advance(const LowRing& ring) {
  constexpr double kOnRoad = 0.3;  // metres over the road: what lies higher is an obstacle
  constexpr double kAside = 1.0;   // metres: farther off the scan line does not cross the axis
  double nearest = kAside;
  std::optional<Vec2> crossing;
  for (const std::span<const Vec3> part : half_of(ring, front_)) {
    for (const Vec3 p : part) {
      const Vec2 step = p.xy() - place_;
      const double aside = std::abs(cross(heading_, step));
      if (aside >= nearest || p.z >= kOnRoad || dot(heading_, step) <= 0.0) continue;
      nearest = aside;
      crossing = place_ + dot(heading_, step) * heading_;
    }
  }
  if (crossing) place_ = *crossing;
}

void RoadAxis::follow(std::optional<Vec2> left, std::optional<Vec2> right) {
  extend(sides_[0], left);
  extend(sides_[1], right);
  turn();
  keep_clear();
}

void RoadAxis::extend(Side& side, std::optional<Vec2> foot) {
  constexpr double kAside = 0.3;     // metres
  constexpr double kPerMetre = 0.2;  // a boundary may bend
  constexpr double kBack = -0.1;     // metres: noise may take a step back
  side.runs_on = false;
  if (!foot) return;
  if (!side.feet.empty()) {
    const Vec2 step = *foot - side.feet.back();
    const double along = dot(heading_, step);
    side.runs_on =
        along > kBack && std::abs(cross(heading_, step)) < kAside + kPerMetre * std::max(along, 0.0);
    if (!side.runs_on) side.feet.clear();
  }
  side.feet.push_back(*foot);
}

void RoadAxis::turn() {
  constexpr double kMost = 0.94;  // cosine of 20 degrees, a scan line
  const auto left = last_direction(sides_[0].feet);
  const auto right = last_direction(sides_[1].feet);
  if (left && right && dot(*left, *right) < kMost) return;  // the road forks: neither way is known
  Vec2 sum{};
  for (const auto& direction : {left, right}) {
    if (direction && dot(*direction, heading_) > kMost) sum = sum + *direction;
  }
  if (norm(sum) > 0.0) heading_ = (1.0 / norm(sum)) * sum;
}

void RoadAxis::keep_clear() {
  constexpr double kClear = 1.5;  // metres: the next scan line is to start on the road
  const Vec2 left{-heading_.y, heading_.x};
  double most = std::numeric_limits<double>::infinity();  // shift to the left of the heading
  double least = -most;
  for (const Side& side : sides_) {
    if (!side.runs_on) continue;
    const double aside = dot(left, side.feet.back() - place_);
    if (aside > 0.0) {
      most = std::min(most, aside - kClear);
    } else {
      least = std::max(least, aside + kClear);
    }
  }
  const double shift = least > most ? 0.5 * (least + most) : std::clamp(0.0, least, most);
  place_ = place_ + shift * left;
}

std::array<QuadrantRing, 2> parts_of(const LowRing& ring, bool front, Vec2 axis) {
  const auto empty_part = [&](Quadrant region) {
    return QuadrantRing{ring.ring, region, ring.elevation_rad, ring.spacing_rad, {}};
  };
  QuadrantRing left = empty_part(front ? Quadrant::kB : Quadrant::kD);
  QuadrantRing right = empty_part(front ? Quadrant::kA : Quadrant::kC);
  std::vector<Vec3>& first = (front ? right : left).points;  // counter-clockwise
  std::vector<Vec3>& second = (front ? left : right).points;
  for (const std::span<const Vec3> half : half_of(ring, front)) {
    const auto split = std::ranges::partition_point(half, [&](Vec3 p) { return cross(axis, p.xy()) < 0.0; });
    first.insert(first.end(), half.begin(), split);
    second.insert(second.end(), split, half.end());
  }
  std::ranges::reverse(first);  // from the axis outward
  return {std::move(left), std::move(right)};
}

}  // namespace verge::detect::gradient
