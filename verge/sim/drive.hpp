// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "verge/model/scene.hpp"
#include "verge/scan/mount.hpp"
#include "verge/scan/scan.hpp"
#include "verge/sim/caster.hpp"
#include "verge/sim/furniture.hpp"
#include "verge/sim/land.hpp"
#include "verge/sim/lidar.hpp"
#include "verge/sim/scenario.hpp"
#include "verge/sim/sensors.hpp"
#include "verge/sim/truth.hpp"

namespace verge::sim {

/// A vehicle with one sensor in a scenario.
struct DriveConfig {
  Scenario scenario;
  LidarModel sensor = sensor_named("hdl32e");
  NoiseConfig noise;
  std::int64_t stamp_begin_ns = 0;  ///< Stamp of time 0, ns since the Unix epoch.
  double truth_radius_m = 30.0;
  bool truth_lines = true;  ///< TruthView::lines.
};

/// One scan and all that is true of it.
struct Simulated {
  Scan scan;  ///< As the sensor gives it: not deskewed, without a mount; see label_of() for labels.
  Scene
      truth;  ///< In the sensor frame at the time of the scan's first point; objects as tell_seen() has them.
  Mount mount;  ///< Against the ground under the wheels; forward_rad is the course's direction there.
  bool straight = false;  ///< All of the road within 15 m (along it) of the vehicle is straight.
};

/// A drive that can be asked for any of its scans, in any order and from several threads.
class Drive {
 public:
  /// Throws std::invalid_argument for a configuration that makes no sense.
  explicit Drive(DriveConfig config);

  [[nodiscard]] const DriveConfig& config() const { return config_; }
  [[nodiscard]] const Land& land() const { return land_; }
  [[nodiscard]] const std::vector<Placed>& things() const { return furniture_.things(); }

  /// How far the vehicle can go; none where it stands or its road is a loop.
  [[nodiscard]] std::optional<double> way_m() const;

  /// The sensor's pose so many ns after the start. The vehicle stands on its four wheels (2.7 m and 1.6 m
  /// apart): at the mean height of the ground under them, pitched and rolled with its differences.
  [[nodiscard]] Pose T_world_sensor(std::int64_t time_ns) const;

  /// Scan `index` (0, 1, ...) with its truth. Within it the sensor's pose is interpolated between poses 2 ms
  /// apart, and what moves stands where it is in the middle of the scan.
  [[nodiscard]] Simulated scan(std::uint64_t index) const;

 private:
  [[nodiscard]] Station course_at(double way_m) const;
  [[nodiscard]] double way_at(std::int64_t time_ns) const;

  DriveConfig config_;
  Land land_;
  Furniture furniture_;
  Truth truth_;
  Caster world_;
  std::optional<CenterLine> own_line_;
};

}  // namespace verge::sim
