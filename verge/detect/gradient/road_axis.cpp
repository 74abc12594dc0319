// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/detect/gradient/road_axis.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

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

}  // namespace

void RoadAxis::advance(std::span<const Vec3> half) {
  constexpr double kOnRoad = 0.3;  // metres over the road: what lies higher is an obstacle
  constexpr double kAside = 1.0;   // metres: farther off the scan line does not cross the axis
  double nearest = kAside;
  std::optional<Vec2> crossing;
  for (const Vec3 p : half) {
    const Vec2 step = p.xy() - place_;
    const double aside = std::abs(cross(heading_, step));
    if (p.z < kOnRoad && dot(heading_, step) > 0.0 && aside < nearest) {
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
  Vec2 sum{};
  for (const Side& side : sides_) {
    const auto direction = last_direction(side.feet);
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

std::vector<Vec3> half_of(const LowRing& ring, bool front) {
  std::vector<Vec3> half;
  const auto& p = ring.points;
  if (front) {
    std::copy_if(p.begin(), p.end(), std::back_inserter(half), [](Vec3 q) { return q.x >= 0.0; });
    return half;
  }
  // The seam lies behind: its left comes first.
  std::copy_if(p.begin(), p.end(), std::back_inserter(half), [](Vec3 q) { return q.x < 0.0 && q.y >= 0.0; });
  std::copy_if(p.begin(), p.end(), std::back_inserter(half), [](Vec3 q) { return q.x < 0.0 && q.y < 0.0; });
  return half;
}

QuadrantRing part_of(const LowRing& ring, std::span<const Vec3> half, bool front, bool right, Vec2 axis) {
  const Quadrant region =
      front ? (right ? Quadrant::kA : Quadrant::kB) : (right ? Quadrant::kC : Quadrant::kD);
  QuadrantRing part{ring.ring, region, ring.elevation_rad, ring.spacing_rad, {}};
  std::copy_if(half.begin(), half.end(), std::back_inserter(part.points),
               [&](Vec3 p) { return (cross(axis, p.xy()) >= 0.0) == (front != right); });
  if (outward_sign(region) < 0) std::reverse(part.points.begin(), part.points.end());
  return part;
}

}  // namespace verge::detect::gradient
