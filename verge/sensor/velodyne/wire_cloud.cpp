// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/sensor/velodyne/wire_cloud.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <vector>

#include "verge/core/angle.hpp"
#include "verge/sensor/velodyne/unprojector.hpp"

namespace verge::sensor::velodyne {
namespace {

constexpr double kOffConeRad = deg_to_rad(0.5);
constexpr std::int64_t kNoRing = -1;

Vec3 point_of(const Cloud& cloud, std::size_t i) { return {cloud.x[i], cloud.y[i], cloud.z[i]}; }

/// Some points of each ring, evenly spread.
std::map<std::int64_t, std::vector<std::size_t>> samples_of(const Cloud& cloud) {
  constexpr std::size_t kSamples = 15;
  std::map<std::int64_t, std::vector<std::size_t>> points;
  for (std::size_t i = 0; i < cloud.ring.size(); ++i) points[cloud.ring[i]].push_back(i);
  for (auto& [ring, indices] : points) {
    std::vector<std::size_t> some;
    const std::size_t stride = indices.size() / kSamples + 1;
    for (std::size_t k = 0; k < indices.size(); k += stride) some.push_back(indices[k]);
    indices = std::move(some);
  }
  return points;
}

double median_off_cone(const Cloud& cloud, const std::vector<std::size_t>& points,
                       const LaserCorrection& laser) {
  std::vector<double> off;
  for (const std::size_t i : points) off.push_back(std::abs(elevation_over(laser, point_of(cloud, i))));
  const auto middle = off.begin() + static_cast<std::ptrdiff_t>(off.size() / 2);
  std::nth_element(off.begin(), middle, off.end());
  return *middle;
}

std::size_t nearest_laser(const Cloud& cloud, const std::vector<std::size_t>& points,
                          const Calibration& calibration) {
  std::size_t best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t laser = 0; laser < calibration.size(); ++laser) {
    const double off = median_off_cone(cloud, points, calibration[laser]);
    if (off < least) best = laser;
    least = std::min(least, off);
  }
  return best;
}

std::vector<std::size_t> lasers_by_ring(const Calibration& calibration) {
  const std::vector<std::int64_t> rings = rings_of(calibration);
  std::vector<std::size_t> lasers(rings.size());
  for (std::size_t laser = 0; laser < rings.size(); ++laser) {
    lasers[static_cast<std::size_t>(rings[laser])] = laser;
  }
  return lasers;
}

}  // namespace

void set_rings_of_model(Cloud& cloud, const Facts& facts, const Calibration& calibration) {
  const std::vector<std::int64_t> ring_of_laser = rings_of(calibration);
  std::map<std::int64_t, std::size_t> laser_of;
  for (const auto& [ring, points] : samples_of(cloud)) {
    laser_of[ring] = nearest_laser(cloud, points, calibration);
  }
  for (std::size_t i = 0; i < cloud.ring.size(); ++i) {
    const std::size_t laser = laser_of[cloud.ring[i]];
    const bool on_cone = std::abs(elevation_over(calibration[laser], point_of(cloud, i))) <= kOffConeRad;
    cloud.ring[i] = on_cone ? ring_of_laser[laser % facts.lasers] : kNoRing;
  }
}

void set_times_by_azimuth(Cloud& cloud, const Facts& facts, const Calibration& calibration, double rate_hz) {
  const std::vector<std::size_t> laser_of_ring = lasers_by_ring(calibration);
  const double firing_ns =
      facts.step_ns * static_cast<double>(facts.lasers_per_firing) / static_cast<double>(kSlotsPerBlock);
  cloud.time_s.assign(cloud.x.size(), 0.0);
  for (std::size_t i = 0; i < cloud.ring.size(); ++i) {
    if (cloud.ring[i] == kNoRing) continue;
    const std::size_t laser = laser_of_ring[static_cast<std::size_t>(cloud.ring[i])];
    const auto seen = unproject(calibration[laser], facts.range_step_m, point_of(cloud, i));
    if (!seen) continue;
    const double slot_ns = facts.slot_time_ns[laser % kSlotsPerBlock];
    const double from_rear = std::fmod(seen->azimuth + 0.5 * kTurn, kTurn) / kTurn;
    const double firing = std::max(0.0, std::round((1e9 * from_rear / rate_hz - slot_ns) / firing_ns));
    cloud.time_s[i] = 1e-9 * (firing * firing_ns + slot_ns);
  }
}

}  // namespace verge::sensor::velodyne
