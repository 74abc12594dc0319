// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "verge/core/vec.hpp"
#include "verge/sensor/beam_model.hpp"
#include "verge/sensor/ibeo/alasca_xt.hpp"
#include "verge/sensor/ibeo/lux.hpp"

namespace verge::sim {

/// One shot of a laser, in the sensor frame.
struct Shot {
  std::int64_t time_ns = 0;  ///< After the start of the drive.
  Vec3 origin;               ///< Of its beam.
  Vec3 direction;            ///< Unit vector.
  std::uint32_t ring = 0;    ///< 0 = the lowest.
};

/// All shots of one scan, in the order in which the sensor reports them.
struct ShotPlan {
  std::int64_t begin_ns = 0;  ///< After the start of the drive; time of the first shot.
  std::int64_t end_ns = 0;    ///< When the scan is over.
  std::vector<Shot> shots{};
};

/// How a sensor sends and receives.
struct Optics {
  double across_rad = 0.0;  ///< Divergence of a beam along the rings, from edge to edge.
  double up_rad = 0.0;      ///< Divergence upright.
  double pulse_m = 0.0;     ///< Half the length of a pulse: what is nearer together is one echo.
  /// Farthest distance at which a tenth of the light that a matt surface throws straight back suffices for a
  /// return, as often as not.
  double reach_m = 0.0;
};

/// What a sensor says of an echo besides its place.
struct Reports {
  bool intensity = true;  ///< Reflectivity as Velodyne scales it: per cent, above 100 retro-reflectors.
  double pulse_units_per_m = 0.0;  ///< Unit of its pulse widths; 0 = says none.
  std::uint32_t rain_flag = 0;     ///< Flags of an echo of a drop, of dirt on the window.
  std::uint32_t dirt_flag = 0;
};

/// A sensor as the simulator fires it.
struct LidarModel {
  std::string name;  ///< As Scan::sensor.
  std::size_t rings = 0;
  std::int64_t period_ns = 0;       ///< From one scan to the next.
  double range_min_m = 0.0;         ///< Nearer returns are not reported.
  double range_max_m = 0.0;         ///< Farther returns are not reported.
  double range_resolution_m = 0.0;  ///< Step of the ranges on the wire; 0 = as exact as a double.
  std::size_t echoes = 1;           ///< Most echoes of a shot: the first ones; of one alone the strongest.
  Optics optics{};
  Reports reports{};
  /// The shots of scan 0, 1, ... Must be callable from several threads at once.
  std::function<ShotPlan(std::uint64_t scan)> shots{};
};

/// A head that turns all the time: scan i holds the blocks that start in [i, i + 1) revolutions after the
/// start of the drive; a revolution begins at the rear (azimuth pi). At the start of each block the head
/// stands at a whole hundredth of a degree, so that its packets tell the whole truth. Throws
/// std::invalid_argument where the facts have no lasers, or a rate, period or range that is not positive.
[[nodiscard]] LidarModel spinning_lidar(sensor::BeamModel facts, const Optics& optics);

/// A mirror that sweeps from left to right once a scan, two layers at a time, at one of the model's rates.
/// Throws std::invalid_argument for a rate that is not positive.
[[nodiscard]] LidarModel lux_lidar(sensor::ibeo::LuxModel facts, double rate_hz,
                                   std::vector<sensor::ibeo::LuxZone> zones, const Optics& optics);

/// Likewise, all layers at a time.
[[nodiscard]] LidarModel alasca_lidar(sensor::ibeo::AlascaModel facts, const Optics& optics);

}  // namespace verge::sim
