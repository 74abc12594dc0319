// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/sim/road.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

namespace verge::sim {
namespace {

// The verge falls at this slope from the sidewalk to the flat ground, which lies this far below the gutter.
constexpr double kVergeSlope = 0.05;
constexpr double kGroundBelowGutter_m = 0.1;

void require(bool holds, const char* what) {
  if (!holds) throw std::invalid_argument(std::string("road: ") + what);
}

bool positive(double value) { return std::isfinite(value) && value > 0.0; }
bool not_negative(double value) { return std::isfinite(value) && value >= 0.0; }

void check(const Houses& houses) {
  require(not_negative(houses.setback_m) && not_negative(houses.gap_m),
          "setback and gap must not be negative");
  require(positive(houses.length_m) && positive(houses.depth_m) && positive(houses.height_m),
          "a house needs a length, a depth and a height");
}

void check(const RoadConfig& config) {
  require(!config.pieces.empty(), "it needs a piece");
  for (const Piece& piece : config.pieces) {
    require(positive(piece.length_m) && std::isfinite(piece.curvature_1pm),
            "each piece needs a positive length and a finite curvature");
  }
  require(positive(config.width_m), "the width must be positive");
  require(not_negative(config.cross_fall) && config.cross_fall <= 0.2, "the cross-fall must be 0 to 0.2");
  require(not_negative(config.curb_height_m), "the kerb's height must not be negative");
  require(not_negative(config.sidewalk_width_m), "the sidewalk's width must not be negative");
  if (config.houses) check(*config.houses);
}

std::vector<SectionPoint> make_section(const RoadConfig& config) {
  const double half = 0.5 * config.width_m;
  const double gutter = -config.cross_fall * half;
  std::vector<SectionPoint> section = {{0.0, 0.0, Surface::kRoad}, {half, gutter, Surface::kCurb}};
  if (config.curb_height_m > 0.0)
    section.push_back({half, gutter + config.curb_height_m, Surface::kSidewalk});
  section.back().outward = Surface::kSidewalk;
  if (config.sidewalk_width_m > 0.0) {
    section.push_back({half + config.sidewalk_width_m,
                       section.back().height_m + config.cross_fall * config.sidewalk_width_m,
                       Surface::kGround});
  }
  section.back().outward = Surface::kGround;
  const double ground = gutter - kGroundBelowGutter_m;
  const double fall = section.back().height_m - ground;
  section.push_back({section.back().lateral_m + fall / kVergeSlope, ground, Surface::kGround});
  return section;
}

// How far the built-up strip reaches from the centre line.
double reach(const RoadConfig& config, const std::vector<SectionPoint>& section) {
  const double strip = section.back().lateral_m;
  if (!config.houses) return strip;
  const double houses =
      0.5 * config.width_m + config.sidewalk_width_m + config.houses->setback_m + config.houses->depth_m;
  return std::max(strip, houses);
}

// Where one comes to from `from` after `length` metres along a line of that curvature.
Station advance(const Station& from, double length, double curvature) {
  const double turn = curvature * length;
  // Chord of the arc; sin(x)/x is 1 at 0.
  const double half = 0.5 * turn;
  const double chord = std::fabs(half) < 1e-12 ? length : length * std::sin(half) / half;
  const double toward = from.heading_rad + half;
  return {from.position + chord * Vec2{std::cos(toward), std::sin(toward)}, from.heading_rad + turn};
}

}  // namespace

Road::Road(RoadConfig config) : config_(std::move(config)) {
  check(config_);
  section_ = make_section(config_);
  Station place;
  for (const Piece& piece : config_.pieces) {
    require(std::fabs(piece.curvature_1pm) * reach(config_, section_) < 1.0,
            "a curve is tighter than what stands beside the road is wide");
    joints_.push_back({length_m_, place, piece.curvature_1pm});
    place = advance(place, piece.length_m, piece.curvature_1pm);
    length_m_ += piece.length_m;
  }
  joints_.push_back({length_m_, place, 0.0});
}

Station Road::at(double station) const {
  if (station < 0.0) return advance(joints_.front().place, station, 0.0);
  const auto after = std::upper_bound(joints_.begin(), joints_.end(), station,
                                      [](double s, const Joint& joint) { return s < joint.station; });
  const Joint& joint = *std::prev(after);
  return advance(joint.place, station - joint.station, joint.curvature_1pm);
}

bool Road::is_straight(double from, double to) const {
  for (std::size_t i = 0; i + 1 < joints_.size(); ++i) {
    const bool touches = joints_[i].station < to && joints_[i + 1].station > from;
    if (touches && joints_[i].curvature_1pm != 0.0) return false;
  }
  return true;
}

double Road::height_at(double lateral) const {
  const double outward = std::fabs(lateral);
  for (std::size_t i = 0; i + 1 < section_.size(); ++i) {
    const SectionPoint& a = section_[i];
    const SectionPoint& b = section_[i + 1];
    if (outward > b.lateral_m || b.lateral_m == a.lateral_m) continue;
    return a.height_m + (b.height_m - a.height_m) * (outward - a.lateral_m) / (b.lateral_m - a.lateral_m);
  }
  return section_.back().height_m;
}

Vec3 Road::point(double station, double lateral) const {
  const Station place = at(station);
  const Vec2 left = {-std::sin(place.heading_rad), std::cos(place.heading_rad)};
  const Vec2 position = place.position + lateral * left;
  return {position.x, position.y, height_at(lateral)};
}

std::vector<Vec3> Road::curb_foot(Side side, double step_m) const {
  require(positive(step_m), "the step along the kerb must be positive");
  require(side == Side::kLeft || side == Side::kRight, "a kerb stands on the left or on the right");
  const double lateral = (side == Side::kLeft ? 0.5 : -0.5) * config_.width_m;
  std::vector<Vec3> foot;
  const auto steps = static_cast<std::size_t>(std::ceil(length_m_ / step_m - 1e-9));
  for (std::size_t i = 0; i < steps; ++i) foot.push_back(point(static_cast<double>(i) * step_m, lateral));
  foot.push_back(point(length_m_, lateral));
  return foot;
}

}  // namespace verge::sim
