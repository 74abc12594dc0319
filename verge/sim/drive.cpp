// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/sim/drive.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "verge/core/angle.hpp"
#include "verge/sim/road_mesh.hpp"

namespace verge::sim {
namespace {

constexpr double kTrack_m = 1.6;            // between the left and the right wheels
constexpr double kStraightWithin_m = 15.0;  // how far a straight road must be so

constexpr double kCurveRadius_m = 30.0;
constexpr double kQuarterTurn_m = 0.5 * std::numbers::pi * kCurveRadius_m;
constexpr double kBetweenTurns_m = 60.0;

Piece left_turn() { return {kQuarterTurn_m, 1.0 / kCurveRadius_m}; }
Piece other_way(const Piece& turn) { return {turn.length_m, -turn.curvature_1pm}; }

void check_travel(double travel_m) {
  if (!std::isfinite(travel_m) || travel_m < 0.0) {
    throw std::invalid_argument("the travel must not be negative");
  }
}

void check(const DriveConfig& config) {
  if (!(config.mount.height_m > 0.0)) throw std::invalid_argument("the sensor must stand above the road");
  const Course& course = config.course;
  if (!std::isfinite(course.start_m) || !std::isfinite(course.speed_mps) ||
      !std::isfinite(course.lateral_m) || !std::isfinite(course.heading_offset_rad)) {
    throw std::invalid_argument("the vehicle's course must be finite");
  }
  if (!(config.truth_radius_m > 0.0)) throw std::invalid_argument("the truth needs a positive radius");
}

DriveConfig checked(DriveConfig config) {
  check(config);
  return config;
}

Pose T_vehicle_sensor(const Mount& mount) {
  return {from_yaw_pitch_roll(-mount.forward_rad, mount.pitch_rad, mount.roll_rad),
          {0.0, 0.0, mount.height_m}};
}

}  // namespace

DriveConfig straight_road(double travel_m) {
  check_travel(travel_m);
  DriveConfig config;
  config.road.pieces = {{200.0 + travel_m, 0.0}};
  config.course.start_m = 100.0;
  return config;
}

DriveConfig curved_road(double travel_m) {
  check_travel(travel_m);
  DriveConfig config;
  config.road.pieces = {{kBetweenTurns_m, 0.0}, left_turn()};
  double ahead = 0.5 * kQuarterTurn_m;
  while (ahead < travel_m) {
    config.road.pieces.push_back(other_way(config.road.pieces.back()));
    ahead += kQuarterTurn_m;
  }
  config.road.pieces.push_back({kBetweenTurns_m, 0.0});
  config.course.start_m = kBetweenTurns_m + 0.5 * kQuarterTurn_m;
  return config;
}

DriveConfig demo_drive(double travel_m) {
  check_travel(travel_m);
  DriveConfig config;
  config.course.start_m = 40.0;
  config.course.lateral_m = -0.25 * config.road.width_m;
  config.road.houses = Houses{};
  config.road.pieces = {{config.course.start_m + kBetweenTurns_m, 0.0}};
  Piece turn = left_turn();
  double ahead = 0.0;
  while (ahead <= travel_m) {
    config.road.pieces.push_back(turn);
    config.road.pieces.push_back({kBetweenTurns_m, 0.0});
    turn = other_way(turn);
    ahead += kQuarterTurn_m + kBetweenTurns_m;
  }
  return config;
}

Drive::Drive(DriveConfig config)
    : config_(checked(std::move(config))),
      road_(config_.road),
      curbs_(curb_feet(road_)),
      world_(make_world(road_)) {}

double Drive::station_at(std::int64_t time_ns) const {
  return config_.course.start_m + config_.course.speed_mps * 1e-9 * static_cast<double>(time_ns);
}

Pose Drive::T_world_sensor(std::int64_t time_ns) const {
  const Course& course = config_.course;
  const double station = station_at(time_ns);
  const double left = road_.height_at(course.lateral_m + 0.5 * kTrack_m);
  const double right = road_.height_at(course.lateral_m - 0.5 * kTrack_m);
  Pose T_world_vehicle;
  T_world_vehicle.translation = road_.point(station, course.lateral_m);
  T_world_vehicle.translation.z = 0.5 * (left + right);
  T_world_vehicle.rotation = from_yaw_pitch_roll(road_.at(station).heading_rad + course.heading_offset_rad,
                                                 0.0, std::asin((left - right) / kTrack_m));
  return T_world_vehicle * T_vehicle_sensor(config_.mount);
}

Simulated Drive::scan(std::uint64_t index) const {
  Simulated out;
  const Trajectory trajectory = [this](std::int64_t time_ns) { return T_world_sensor(time_ns); };
  out.scan = simulate_revolution(world_, config_.sensor, trajectory, index, config_.noise);
  const std::int64_t begin_ns = *out.scan.stamp_ns;
  out.scan.stamp_ns = config_.course.stamp_begin_ns + begin_ns;

  out.truth = truth_scene(curbs_, T_world_sensor(begin_ns), config_.truth_radius_m);
  out.truth.frame = out.scan.frame;
  out.truth.stamp_ns = out.scan.stamp_ns;
  out.mount = config_.mount;
  out.mount.forward_rad = wrap_pi(config_.mount.forward_rad - config_.course.heading_offset_rad);
  const double station = station_at(begin_ns);
  out.straight = road_.is_straight(station - kStraightWithin_m, station + kStraightWithin_m);
  return out;
}

}  // namespace verge::sim
