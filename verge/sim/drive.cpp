// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/sim/drive.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>
#include <vector>

#include "verge/core/angle.hpp"
#include "verge/core/field_io.hpp"
#include "verge/sim/seen.hpp"

namespace verge::sim {
namespace {

constexpr double kTrack_m = 1.6;            // between the left and the right wheels
constexpr double kWheelbase_m = 2.7;        // between the front and the rear wheels
constexpr double kStraightWithin_m = 15.0;  // how far a straight road must be so
constexpr std::int64_t kPoseStep_ns = 2'000'000;

DriveConfig checked(DriveConfig config) {
  check_fields(config.scenario.course);
  check_fields(config.scenario.stand);
  if (!(config.truth_radius_m > 0.0)) throw std::invalid_argument("the truth needs a positive radius");
  const auto road = static_cast<std::size_t>(config.scenario.course.road);
  if (config.scenario.roads.empty()) throw std::invalid_argument("a world needs a road");
  if (road > config.scenario.roads.size()) throw std::invalid_argument("the vehicle's road is not there");
  return config;
}

World still_world(const Land& land, const Furniture& furniture) {
  World world = land.mesh();
  furniture.add_still(world);
  return world;
}

Pose T_vehicle_sensor(const Stand& stand) {
  const Mount mount = mount_of(stand);
  return {from_yaw_pitch_roll(-mount.forward_rad, mount.pitch_rad, mount.roll_rad),
          {stand.ahead_m, 0.0, mount.height_m}};
}

// Angle of wheels that differ by `height_m`; not more than a vehicle could stand.
double lean(double height_m, double apart_m) { return std::asin(std::clamp(height_m / apart_m, -0.5, 0.5)); }

// Poses of a revolution, sampled, so that thousands of shots need not each ask the ground.
class SampledTrajectory {
 public:
  SampledTrajectory(const Drive& drive, std::int64_t begin_ns, std::int64_t end_ns) : begin_ns_(begin_ns) {
    for (std::int64_t t = begin_ns; t < end_ns + 2 * kPoseStep_ns; t += kPoseStep_ns) {
      poses_.push_back(drive.T_world_sensor(t));
    }
  }

  [[nodiscard]] Pose operator()(std::int64_t time_ns) const {
    const auto since = static_cast<std::size_t>(time_ns - begin_ns_);
    const std::size_t i = since / kPoseStep_ns;
    const double share = static_cast<double>(since % kPoseStep_ns) / static_cast<double>(kPoseStep_ns);
    return share == 0.0 ? poses_[i] : interpolate(poses_[i], poses_[i + 1], share);
  }

 private:
  std::int64_t begin_ns_;
  std::vector<Pose> poses_;
};

}  // namespace

Drive::Drive(DriveConfig config)
    : config_(checked(std::move(config))),
      land_(config_.scenario.roads, config_.scenario.ground),
      furniture_(land_),
      truth_(land_, furniture_),
      world_(still_world(land_, furniture_), furniture_.bodies()) {
  const Course& course = config_.scenario.course;
  if (course.pieces.empty()) return;
  for (const Piece& piece : course.pieces) check_fields(piece);
  own_line_.emplace(course.pieces, course_at(0.0));
}

std::optional<double> Drive::way_m() const {
  const Course& course = config_.scenario.course;
  if (course.speed_mps == 0.0) return std::nullopt;
  if (own_line_) return own_line_->length_m();
  const Road& road = land_.roads()[static_cast<std::size_t>(course.road - 1)];
  if (road.line().closed()) return std::nullopt;
  return course.against ? course.at_m : road.length_m() - course.at_m;
}

// Where the vehicle is after so many metres.
Station Drive::course_at(double way_m) const {
  if (own_line_) return own_line_->at(way_m);
  const Course& course = config_.scenario.course;
  const Road& road = land_.roads()[static_cast<std::size_t>(course.road - 1)];
  Station place = road.line().at(course.at_m + (course.against ? -way_m : way_m));
  place.position = place.position + course.lateral_m * left_of(place.heading_rad);
  if (course.against) place.heading_rad += std::numbers::pi;
  return place;
}

double Drive::way_at(std::int64_t time_ns) const {
  return config_.scenario.course.speed_mps * 1e-9 * static_cast<double>(time_ns);
}

Pose Drive::T_world_sensor(std::int64_t time_ns) const {
  const Station place = course_at(way_at(time_ns));
  const double heading = place.heading_rad + deg_to_rad(config_.scenario.course.crab_deg);
  const auto height = [&](double ahead, double left) {
    return land_.height(place.position + ahead * along(heading) + left * left_of(heading));
  };
  const double x = 0.5 * kWheelbase_m;
  const double y = 0.5 * kTrack_m;
  const double front_left = height(x, y);
  const double front_right = height(x, -y);
  const double rear_left = height(-x, y);
  const double rear_right = height(-x, -y);
  const double drop = 0.5 * (rear_left + rear_right - front_left - front_right);
  const double rise = 0.5 * (front_left + rear_left - front_right - rear_right);
  const Pose T_world_vehicle = {
      from_yaw_pitch_roll(heading, lean(drop, kWheelbase_m), lean(rise, kTrack_m)),
      {place.position.x, place.position.y, 0.25 * (front_left + front_right + rear_left + rear_right)}};
  return T_world_vehicle * T_vehicle_sensor(config_.scenario.stand);
}

Simulated Drive::scan(std::uint64_t index) const {
  const Course& course = config_.scenario.course;
  const std::int64_t period_ns = config_.sensor.period_ns;
  const std::int64_t from_ns = static_cast<std::int64_t>(index) * period_ns;
  const double middle_s = 1e-9 * (static_cast<double>(from_ns) + 0.5 * static_cast<double>(period_ns));
  const Caster world = world_.at(furniture_.poses_of_bodies(middle_s));
  const std::int64_t before_ns =
      std::max<std::int64_t>(0, from_ns - kPoseStep_ns);  // for the head's rounding
  const SampledTrajectory sampled(*this, before_ns, from_ns + period_ns + kPoseStep_ns);

  Simulated out;
  out.scan = simulate_scan(world, config_.sensor, sampled, index, config_.noise, config_.scenario.weather);
  const std::int64_t begin_ns = *out.scan.stamp_ns;
  out.scan.stamp_ns = config_.stamp_begin_ns + begin_ns;

  const Station place = course_at(way_at(begin_ns));
  out.truth = truth_.scene({.world = world,
                            .T_world_sensor = *out.scan.T_world_sensor,
                            .heading_rad = place.heading_rad,
                            .road = static_cast<std::size_t>(course.road - 1),
                            .time_s = middle_s,
                            .radius_m = config_.truth_radius_m,
                            .lines = config_.truth_lines});
  tell_seen(out.truth.objects, deskew(out.scan));
  out.truth.frame = out.scan.frame;
  out.truth.stamp_ns = out.scan.stamp_ns;
  out.mount = mount_of(config_.scenario.stand);
  out.mount.forward_rad = wrap_pi(out.mount.forward_rad - deg_to_rad(course.crab_deg));
  const auto where =
      truth_.whereabouts(place.position, place.heading_rad, static_cast<std::size_t>(course.road - 1));
  out.straight = land_.roads()[where.road].line().is_straight(where.station_m - kStraightWithin_m,
                                                              where.station_m + kStraightWithin_m);
  return out;
}

}  // namespace verge::sim
