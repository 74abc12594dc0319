// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/sensor/velodyne/unprojector.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "verge/sensor/velodyne/correction.hpp"

namespace verge::sensor::velodyne {
namespace {

constexpr double kUnitsPerRad = 18'000.0 / std::numbers::pi;

/// Distance before its corrections, and azimuth of the beam.
struct Beam {
  double measured_m = 0.0;
  double azimuth_rad = 0.0;
};

/// Horizontal distance of the point along its own beam, which starts `left_m` beside the axis.
double along_beam_m(const LaserCorrection& laser, const Vec3& p) {
  return std::sqrt(std::max(0.0, p.x * p.x + p.y * p.y - laser.left_m * laser.left_m));
}

/// With one correction for all distances: in closed form.
Beam far_beam(const LaserCorrection& laser, const Vec3& p) {
  const double along_m = along_beam_m(laser, p);
  return {along_m / std::cos(laser.elevation_rad) - laser.distance_m,
          std::atan2(-p.y, p.x) + std::atan2(laser.left_m, along_m)};
}

/// With the corrections of near points, which depend on what is looked for: a fixed point, each turn of which
/// is nearer by the ratio of a few centimetres to metres.
Beam near_beam(const LaserCorrection& laser, const Vec3& p) {
  constexpr int kMostTurns = 32;
  constexpr double kSettledM = 1e-9;
  const double level = std::cos(laser.elevation_rad);
  Beam beam = far_beam(laser, p);
  for (int turn = 0; turn < kMostTurns; ++turn) {
    const double level_cos = level * std::cos(beam.azimuth_rad);
    const double level_sin = level * std::sin(beam.azimuth_rad);
    const CorrectedDistance near = corrected(laser, beam.measured_m, true, level_cos, level_sin);
    // What the corrections differ by from that of far points is small; the whole correction is not.
    const double far_m = beam.measured_m + laser.distance_m;
    const double ahead = p.x - laser.left_m * std::sin(beam.azimuth_rad) - (near.ahead_m - far_m) * level_cos;
    const double aside = -p.y + laser.left_m * std::cos(beam.azimuth_rad) - (near.side_m - far_m) * level_sin;
    const Beam next{std::hypot(ahead, aside) / level - laser.distance_m, std::atan2(aside, ahead)};
    const bool settled = std::abs(next.measured_m - beam.measured_m) < kSettledM;
    beam = next;
    if (settled) break;
  }
  return beam;
}

/// How far the point's height is from the beam's.
double height_error_m(const LaserCorrection& laser, const Beam& beam, bool near, double z) {
  const double level = std::cos(laser.elevation_rad);
  const CorrectedDistance far = corrected(laser, beam.measured_m, near, level * std::cos(beam.azimuth_rad),
                                          level * std::sin(beam.azimuth_rad));
  return std::abs(0.5 * (far.ahead_m + far.side_m) * std::sin(laser.elevation_rad) + laser.up_m - z);
}

/// Near and far corrections do not meet where they change: there both may explain a point, and its height
/// tells.
Beam beam_of(const LaserCorrection& laser, const Vec3& p) {
  const Beam far = far_beam(laser, p);
  if (!laser.near) return far;
  const Beam near = near_beam(laser, p);
  const bool may_be_near = near.measured_m < kFarM;
  const bool may_be_far = far.measured_m > kFarM - 1e-4;  // half a count, less the step of floats
  if (may_be_near != may_be_far) return may_be_near ? near : far;
  return height_error_m(laser, near, true, p.z) <= height_error_m(laser, far, false, p.z) ? near : far;
}

bool starts_in_origin(const LaserCorrection& laser) {
  return laser.up_m == 0.0 && laser.left_m == 0.0 && !laser.near;
}

}  // namespace

std::optional<Measurement> unproject(const LaserCorrection& laser, double range_step_m, const Vec3& point) {
  constexpr double kMostCount = 65'535.0;
  Beam beam = beam_of(laser, point);
  // Where the beam starts in the origin the range is known even of points that are off its cone.
  if (starts_in_origin(laser)) beam.measured_m = norm(point) - laser.distance_m;
  const double count = std::round(beam.measured_m / range_step_m);
  if (!(count >= 1.0) || count > kMostCount || !std::isfinite(beam.azimuth_rad)) return std::nullopt;
  const double azimuth = (beam.azimuth_rad - laser.azimuth_rad) * kUnitsPerRad;
  const double wrapped = azimuth - kTurn * std::floor(azimuth / kTurn);
  return Measurement{static_cast<std::uint16_t>(count), wrapped < kTurn ? wrapped : 0.0};
}

double elevation_over(const LaserCorrection& laser, const Vec3& point) {
  return std::atan2(point.z - laser.up_m, along_beam_m(laser, point)) - laser.elevation_rad;
}

}  // namespace verge::sensor::velodyne
