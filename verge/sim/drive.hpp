// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "verge/model/scene.hpp"
#include "verge/scan/mount.hpp"
#include "verge/scan/scan.hpp"
#include "verge/sensor/beam_model.hpp"
#include "verge/sensor/hdl32e.hpp"
#include "verge/sim/caster.hpp"
#include "verge/sim/lidar.hpp"
#include "verge/sim/road.hpp"
#include "verge/sim/truth.hpp"

namespace verge::sim {

/// How the vehicle goes along the road.
struct Course {
  double start_m = 100.0;           ///< Station of the sensor's foot at time 0.
  double speed_mps = 8.0;           ///< Along the centre line.
  double lateral_m = 0.0;           ///< To the left of the centre line.
  double heading_offset_rad = 0.0;  ///< Of the vehicle against the road, counter-clockwise (crab angle).
  std::int64_t stamp_begin_ns = 0;  ///< Stamp of time 0, ns since the Unix epoch.
};

/// A vehicle with one sensor on one road.
struct DriveConfig {
  RoadConfig road;
  Course course;
  /// How the sensor stands on the vehicle; forward_rad is the vehicle's +x in the sensor's levelled frame.
  Mount mount = {.height_m = 1.9, .pitch_rad = 0.01, .roll_rad = -0.008, .forward_rad = 0.0};
  sensor::BeamModel sensor = sensor::hdl32e();
  NoiseConfig noise;
  double truth_radius_m = 30.0;
};

/// One scan and all that is true of it.
struct Simulated {
  Scan scan;              ///< As the sensor gives it: not deskewed, without a mount.
  Scene truth;            ///< Boundaries in the sensor frame at the time of the scan's first point.
  Mount mount;            ///< Against the ground under the wheels; forward_rad is the road's direction there.
  bool straight = false;  ///< All of the road within 15 m (along it) of the vehicle is straight.
};

// Ready drives with an HDL-32E on the roof at 1.9 m of a road of 8 m with kerbs of 0.12 m. Each road is long
// enough for a vehicle that goes `travel_m` metres from its start. Throw std::invalid_argument where that is
// negative or not finite.

/// In the middle of a straight road without houses, which begins 100 m behind the vehicle and ends 100 m
/// before it at the end of its travel.
[[nodiscard]] DriveConfig straight_road(double travel_m = 0.0);

/// In the middle of a winding road without houses: quarter turns of 30 m radius, left and right in turn,
/// between straights of 60 m at both ends. The vehicle begins in the middle of the first turn.
[[nodiscard]] DriveConfig curved_road(double travel_m = 0.0);

/// The demo's drive: 60 m of straight road ahead, then a left turn of 30 m radius, and so on, turns and
/// straights of 60 m in turn; houses on both sides; the vehicle keeps to the right-hand lane.
[[nodiscard]] DriveConfig demo_drive(double travel_m = 0.0);

/// A drive that can be asked for any of its scans, in any order and from several threads.
class Drive {
 public:
  /// Throws std::invalid_argument for a configuration that makes no sense.
  explicit Drive(DriveConfig config);

  [[nodiscard]] const DriveConfig& config() const { return config_; }
  [[nodiscard]] const Road& road() const { return road_; }

  /// The sensor's pose so many ns after the start. The vehicle stands level on its four wheels: at the mean
  /// height of the road under the left and the right ones, rolled with their difference.
  [[nodiscard]] Pose T_world_sensor(std::int64_t time_ns) const;

  /// Scan `index` (0, 1, ...) with its truth.
  [[nodiscard]] Simulated scan(std::uint64_t index) const;

 private:
  [[nodiscard]] double station_at(std::int64_t time_ns) const;

  DriveConfig config_;
  Road road_;
  CurbFeet curbs_;
  Caster world_;
};

}  // namespace verge::sim
