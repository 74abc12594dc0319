// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/sim/center_line.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "verge/core/angle.hpp"

namespace verge::sim {
namespace {

constexpr double kMilestone_m = 1.0;

void require(bool holds, const char* what) {
  if (!holds) throw std::invalid_argument(what);
}

void check(const Piece& piece) {
  require(std::isfinite(piece.length_m) && piece.length_m > 0.0, "a piece of a line needs a length");
  require(std::isfinite(piece.curvature_1pm) && std::isfinite(piece.curvature_change_1pm),
          "the curvature of a line must be finite");
}

// Chord of an arc of this length and curvature, from a place; sin(x)/x is 1 at 0.
Vec2 arc_chord(double heading, double curvature, double length) {
  const double half = 0.5 * curvature * length;
  const double chord = std::fabs(half) < 1e-12 ? length : length * std::sin(half) / half;
  return chord * along(heading + half);
}

// Integral of (cos, sin)(h + k u + c u^2 / 2) over u = 0..length by Gauss and Legendre's eight points. The
// caller keeps the turn below half a radian, where the error is below rounding.
Vec2 gauss_chord(double h, double k, double c, double length) {
  static constexpr std::array<std::pair<double, double>, 4> kNodes = {
      {{0.18343464249564980494, 0.36268378337836198297},
       {0.52553240991632898582, 0.31370664587788728734},
       {0.79666647741362673959, 0.22238103445337447054},
       {0.96028985649753623168, 0.10122853629037625915}}};
  Vec2 sum;
  for (const auto& [node, weight] : kNodes) {
    for (const double sign : {-1.0, 1.0}) {
      const double u = 0.5 * length * (1.0 + sign * node);
      sum = sum + 0.5 * length * weight * along(h + u * (k + 0.5 * c * u));
    }
  }
  return sum;
}

Vec2 clothoid_chord(const Station& from, double change, double length) {
  const double steepest = std::fabs(from.curvature_1pm) + std::fabs(change * length);
  const double count = std::max(1.0, std::ceil(steepest * std::fabs(length) / 0.5));
  const double step = length / count;
  Vec2 sum;
  double heading = from.heading_rad;
  double curvature = from.curvature_1pm;
  for (int i = 0; i < static_cast<int>(count); ++i) {
    sum = sum + gauss_chord(heading, curvature, change, step);
    heading += step * (curvature + 0.5 * change * step);
    curvature += change * step;
  }
  return sum;
}

// Where one comes to from `from` after `length` metres; the curvature changes by `change` a metre.
Station advance(const Station& from, double change, double length) {
  const Vec2 chord = change == 0.0 ? arc_chord(from.heading_rad, from.curvature_1pm, length)
                                   : clothoid_chord(from, change, length);
  return {from.position + chord, from.heading_rad + length * (from.curvature_1pm + 0.5 * change * length),
          from.curvature_1pm + change * length};
}

}  // namespace

Vec2 along(double heading_rad) { return {std::cos(heading_rad), std::sin(heading_rad)}; }
Vec2 left_of(double heading_rad) { return {-std::sin(heading_rad), std::cos(heading_rad)}; }

CenterLine::CenterLine(std::vector<Piece> pieces, const Station& start, bool closed) : closed_(closed) {
  require(!pieces.empty(), "a line needs a piece");
  Station place = start;
  double station = 0.0;
  for (const Piece& piece : pieces) {
    check(piece);
    place.curvature_1pm = piece.curvature_1pm;
    const double change = piece.curvature_change_1pm / piece.length_m;
    joints_.push_back({station, place, change});
    place = advance(place, change, piece.length_m);
    station += piece.length_m;
  }
  place.curvature_1pm = 0.0;
  joints_.push_back({station, place, 0.0});
  const bool comes_back = distance(place.position, start.position) < 1e-3 &&
                          std::fabs(wrap_pi(place.heading_rad - start.heading_rad)) < 1e-3;
  require(!closed || comes_back, "a closed line must come back to its start");
  for (double s = 0.0; s < station; s += kMilestone_m) milestones_.push_back(at(s).position);
  low_ = high_ = start.position;
  for (const Vec2 p : milestones_) {
    low_ = {std::min(low_.x, p.x - kMilestone_m), std::min(low_.y, p.y - kMilestone_m)};
    high_ = {std::max(high_.x, p.x + kMilestone_m), std::max(high_.y, p.y + kMilestone_m)};
  }
}

double CenterLine::wrapped(double station_m) const {
  return closed_ ? station_m - length_m() * std::floor(station_m / length_m()) : station_m;
}

Station CenterLine::at(double station_m) const {
  const double station = wrapped(station_m);
  if (station < 0.0) {
    const Station straight{joints_.front().place.position, joints_.front().place.heading_rad, 0.0};
    return advance(straight, 0.0, station);
  }
  const auto after = std::upper_bound(joints_.begin(), joints_.end(), station,
                                      [](double s, const Joint& joint) { return s < joint.station_m; });
  const Joint& joint = *std::prev(after);
  return advance(joint.place, joint.change_1pm2, station - joint.station_m);
}

Vec2 CenterLine::point(double station_m, double lateral_m) const {
  const Station place = at(station_m);
  return place.position + lateral_m * left_of(place.heading_rad);
}

bool CenterLine::is_straight(double from, double to) const {
  for (std::size_t i = 0; i + 1 < joints_.size(); ++i) {
    const bool touches = joints_[i].station_m < to && joints_[i + 1].station_m > from;
    const bool bends = joints_[i].place.curvature_1pm != 0.0 || joints_[i].change_1pm2 != 0.0;
    if (touches && bends) return false;
  }
  return true;
}

std::vector<double> CenterLine::joints() const {
  std::vector<double> stations;
  for (const Joint& joint : joints_) stations.push_back(joint.station_m);
  return stations;
}

double CenterLine::at_least_m(Vec2 p) const {
  return norm(
      Vec2{std::max({low_.x - p.x, p.x - high_.x, 0.0}), std::max({low_.y - p.y, p.y - high_.y, 0.0})});
}

Beside CenterLine::nearest(Vec2 p) const {
  std::size_t best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < milestones_.size();) {
    const double away = distance(p, milestones_[i]);
    if (away < least) {
      least = away;
      best = i;
    }
    // No milestone is nearer than the way to it is long.
    i += 1 + static_cast<std::size_t>(std::max(0.0, away - least) / kMilestone_m);
  }
  // The station moves by what remains along the line, until nothing does.
  double station = kMilestone_m * static_cast<double>(best);
  Station place = at(station);
  for (int i = 0; i < 30; ++i) {
    const Vec2 to = p - place.position;
    const double stretch = 1.0 - place.curvature_1pm * dot(to, left_of(place.heading_rad));
    const double step = dot(to, along(place.heading_rad)) / std::max(stretch, 0.2);
    const double next = std::clamp(station + std::clamp(step, -1.0, 1.0), 0.0, length_m());
    const bool arrived = std::fabs(next - station) < 1e-10;
    station = next;
    place = at(station);
    if (arrived) break;
  }
  const Vec2 to = p - place.position;
  return {station, std::copysign(norm(to), cross(along(place.heading_rad), to))};
}

}  // namespace verge::sim
