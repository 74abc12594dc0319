// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/sensor/ibeo/lux.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdlib>
#include <numbers>

#include "verge/core/angle.hpp"
#include "verge/sensor/ibeo/ntp.hpp"

namespace verge::sensor::ibeo {
namespace {

constexpr unsigned kEchoMost = 3;
constexpr double kMetresPerCm = 0.01;

/// Which count a point goes to.
std::uint64_t PointCounts::*fate_of(const LuxPoint& point, const LuxModel& model) {
  if (point.layer >= model.layer_elevation_rad.size()) return &PointCounts::bad_layer;
  if (point.echo > kEchoMost) return &PointCounts::bad_echo;
  if (point.range_cm == 0) return &PointCounts::no_return;
  return &PointCounts::used;
}

void add_point(Cloud& cloud, const LuxScan& scan, const LuxPoint& point, const LuxModel& model) {
  const double angle = 2.0 * std::numbers::pi * point.angle_ticks / scan.ticks_per_turn;
  const double up = elevation_rad(model, point.layer, angle, (scan.flags & kRearMirror) != 0);
  const double range = point.range_cm * kMetresPerCm;
  cloud.x.push_back(static_cast<float>(range * std::cos(up) * std::cos(angle)));
  cloud.y.push_back(static_cast<float>(range * std::cos(up) * std::sin(angle)));
  cloud.z.push_back(static_cast<float>(range * std::sin(up)));
  cloud.ring.push_back(point.layer);
  cloud.echo.push_back(point.echo);
  cloud.flags.push_back(point.flags);
  cloud.pulse_width.push_back(static_cast<float>(point.pulse_width_cm * kMetresPerCm));
}

/// Seconds from the start of the scan to this angle.
double time_s(const LuxScan& scan, std::int16_t angle_ticks) {
  const int width = scan.start_angle_ticks - scan.end_angle_ticks;
  if (width == 0) return 0.0;
  const double share = static_cast<double>(scan.start_angle_ticks - angle_ticks) / width;
  return seconds_between(scan.start_ntp, scan.end_ntp) * std::min(std::max(0.0, share), 1.0);  // never -0
}

/// Counts times from the earliest; the time of that.
double rebase(std::vector<double>& times_s) {
  if (times_s.empty()) return 0.0;
  const double first = *std::min_element(times_s.begin(), times_s.end());
  for (double& time : times_s) time -= first;
  return first;
}

}  // namespace

LuxModel lux() {
  LuxModel model{.name = "lux",
                 .layer_elevation_rad = {},
                 .beam_tilt_rad = 0.0,
                 .ticks_per_turn = 11520,
                 .start_angle_ticks = 1600,
                 .upper_start_angle_ticks = 1112,
                 .end_angle_ticks = -1600,
                 .range_min_m = 0.3,
                 .range_max_m = 200.0,
                 .rates = {{12.5, 4}, {25.0, 8}, {50.0, 16}}};
  for (const double elevation_deg : {-1.2, -0.4, 0.4, 1.2}) {
    model.layer_elevation_rad.push_back(deg_to_rad(elevation_deg));
  }
  return model;
}

double elevation_rad(const LuxModel& model, std::size_t layer, double angle_rad, bool rear_mirror) {
  const double flat = model.layer_elevation_rad[layer];
  if (model.beam_tilt_rad == 0.0) return flat;
  const double tilt =
      0.5 * model.beam_tilt_rad * std::numbers::sqrt2 * std::sin(0.5 * angle_rad - 0.25 * std::numbers::pi);
  return rear_mirror ? flat - 2.0 * tilt : flat + 2.0 * tilt;
}

MessageCloud cloud_of(const LuxScan& scan, const LuxModel& model) {
  MessageCloud out;
  out.counts.received = scan.points.size();
  for (const LuxPoint& point : scan.points) {
    std::uint64_t PointCounts::*const fate = fate_of(point, model);
    ++(out.counts.*fate);
    if (fate != &PointCounts::used) continue;
    add_point(out.cloud, scan, point, model);
    out.cloud.time_s.push_back(time_s(scan, point.angle_ticks));
  }
  const double first_s = rebase(out.cloud.time_s);
  out.stamp_ns = unix_ns_of(scan.start_ntp);
  if (out.stamp_ns) *out.stamp_ns += std::llround(first_s * 1e9);
  return out;
}

std::vector<LuxZone> focused_zones() { return {{320, 8}, {960, 16}, {5760, 32}}; }

std::vector<LuxZone> constant_zones(double rate_hz) {
  const std::int16_t step_ticks = rate_hz > 25.0 ? 32 : 16;
  return {{5760, step_ticks}};
}

std::vector<LuxPulse> pulses_of(const LuxModel& model, std::span<const LuxZone> zones) {
  assert(!zones.empty());
  const auto step_at = [&](int ticks) {
    const auto zone = std::find_if(zones.begin(), zones.end(),
                                   [&](const LuxZone& z) { return std::abs(ticks) <= z.within_ticks; });
    return static_cast<int>(zone == zones.end() ? zones.back().step_ticks : zone->step_ticks);
  };
  std::vector<LuxPulse> pulses;
  for (int ticks = model.start_angle_ticks; ticks >= model.end_angle_ticks; --ticks) {
    const int step = step_at(ticks);
    const int phase = (ticks % step + step) % step;
    const auto angle = static_cast<std::int16_t>(ticks);
    if (phase == 0) pulses.push_back({angle, 0});
    if (2 * phase == step && ticks <= model.upper_start_angle_ticks) pulses.push_back({angle, 2});
  }
  return pulses;
}

}  // namespace verge::sensor::ibeo
