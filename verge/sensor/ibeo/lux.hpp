// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "verge/scan/organise.hpp"
#include "verge/sensor/ibeo/scan2202.hpp"

namespace verge::sensor::ibeo {

/// One of the rates that the mirror can turn at, and the horizontal step that comes with it.
struct ScanRate {
  double rate_hz = 0.0;         ///< Scans a second.
  std::int16_t step_ticks = 0;  ///< Between two pulses of one pair of layers.
};

/// How far apart the pulses of one pair of layers are, up to an angle to either side of straight ahead.
struct LuxZone {
  std::int16_t within_ticks = 0;
  std::int16_t step_ticks = 0;
};

/// The facts of a LUX or LD-MRS that decoder, encoder and simulator share.
struct LuxModel {
  std::string name;
  std::vector<double> layer_elevation_rad;  ///< By layer, 0 = the lowest; up is positive. At most 8.
  /// Tilt of the mirror's two sides against each other, radians: each then sees its own four layers. 0 with
  /// four layers. Parameter 0x3302 of the sensor.
  double beam_tilt_rad = 0.0;
  std::uint16_t ticks_per_turn = 11520;
  std::int16_t start_angle_ticks = 0;        ///< Leftmost pulse of the lower pair of layers.
  std::int16_t upper_start_angle_ticks = 0;  ///< Leftmost pulse of the upper pair of layers.
  std::int16_t end_angle_ticks = 0;          ///< Rightmost pulse.
  double range_min_m = 0.0;
  double range_max_m = 0.0;
  std::vector<ScanRate> rates;
};

/// ibeo LUX (2010), the same hardware as SICK LD-MRS with four layers.
///
/// Sources: paper 2 (Duan, Valentyna), table I: 100 degrees, 200 m, four layers over 2.4 degrees, 12.5, 25
/// or 50 Hz, steps of 0.125, 0.25 and 0.5 degrees. Layers at -1.2, -0.4, +0.4, +1.2 degrees, 0 the lowest:
/// SICK's driver for the LD-MRS and ViSP (paper 2's printed coordinates lie 0.4 degrees higher: a sensor that
/// is mounted so, docs/formats_ibeo.md). Lower pair from +50, upper pair from 34.75 degrees, to -50: a public
/// recording of an LD-MRS at 12.5 Hz.
[[nodiscard]] LuxModel lux();

/// Height of a layer's beam over the sensor's horizontal plane at a horizontal angle, radians. The layer is
/// one of the model's. With a tilted mirror it depends on the angle and on the mirror's side: 2 x tilt below
/// the layer's elevation on the rear side and as much above it on the front side, where
///
///     tilt = beam_tilt_rad / 2 x sqrt(2) x sin(angle / 2 - pi / 4)
///
/// (SICK's driver for the LD-MRS with eight layers).
[[nodiscard]] double elevation_rad(const LuxModel& model, std::size_t layer, double angle_rad,
                                   bool rear_mirror);

/// What became of the points of a scan: received = used + the rest.
struct PointCounts {
  std::uint64_t received = 0;
  std::uint64_t used = 0;
  std::uint64_t no_return = 0;  ///< Range 0.
  std::uint64_t bad_layer = 0;  ///< A layer that the model does not have.
  std::uint64_t bad_echo = 0;   ///< An echo beyond 3.
  std::uint64_t invalid = 0;    ///< Which the sensor calls so (ALASCA XT).

  friend bool operator==(const PointCounts&, const PointCounts&) = default;
};

/// The points of a message.
struct MessageCloud {
  Cloud cloud;
  std::optional<std::int64_t>
      stamp_ns;  ///< Of the earliest point; none where the sensor was not told the time.
  PointCounts counts;
};

/// The points of a scan in the sensor's frame, in the order of the message.
///
///     x = r cos(v) cos(h),   y = r cos(v) sin(h),   z = r sin(v)
///
/// with h = 2 pi ticks / ticks_per_turn and v the layer's elevation (the form of SICK's and ibeo's own
/// software: each layer is a cone about the vertical axis; ViSP turns the fan about the lateral axis instead
/// and is lower by cos h). Ring = layer, echo, pulse width in metres, flags = PointFlag. The mounting is not
/// applied. Times: the mirror turns evenly from start to end angle between start and end time, so that
///
///     t = (end - start) x (start angle - angle) / (start angle - end angle)
///
/// held inside the scan; 0 where the scan has no width. time_s counts from the earliest point. Points of
/// range 0, of a layer that the model lacks and of an echo beyond 3 are left out and counted.
[[nodiscard]] MessageCloud cloud_of(const LuxScan& scan, const LuxModel& model);

/// One pulse: two layers at once.
struct LuxPulse {
  std::int16_t angle_ticks = 0;
  std::uint8_t lower_layer = 0;  ///< 0 or 2; the other one is the next.
};

/// The pulses of one scan of a four-layer sensor from left to right: of the lower pair at whole multiples of
/// the zone's step, of the upper pair half a step between, each from its start angle on. The zones stand from
/// the middle outward; beyond the last one counts the last one's step.
[[nodiscard]] std::vector<LuxPulse> pulses_of(const LuxModel& model, std::span<const LuxZone> zones);

/// The sensor's two kinds of angular resolution (its parameter 0x1104).
///
/// Focused, at 12.5 Hz: a pulse every 0.125 degrees up to 10 degrees, 0.25 to 30, 0.5 beyond, so that each
/// pair has one every 0.25, 0.5 and 1 degree. Source: paper 2, table I (the three steps) and its table of
/// points (beyond 30 degrees whole degrees for the lower pair and half ones for the upper, from 30 on 29.75,
/// 29.25, ...); that two pairs take turns, so that a pair's step is twice the sensor's: LD-MRS operating
/// instructions, "Angular resolution". The inner border of 10 degrees is not printed in either: ours.
[[nodiscard]] std::vector<LuxZone> focused_zones();
/// Constant: each pair every 0.5 degrees (as a public recording of an LD-MRS at 12.5 Hz has it), at 50 Hz
/// every degree.
[[nodiscard]] std::vector<LuxZone> constant_zones(double rate_hz);

}  // namespace verge::sensor::ibeo
