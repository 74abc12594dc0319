// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/sim/lidar.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "verge/scan/organise.hpp"
#include "verge/sim/noise.hpp"

namespace verge::sim {
namespace {

/// One shot that came back.
struct Return {
  Vec3 p_sensor;
  float intensity = 0.0F;
  std::uint32_t label = 0;
};

/// Firings [begin, end) counted from the start of the drive.
struct Firings {
  std::int64_t begin = 0;
  std::int64_t end = 0;
};

bool positive(double value) { return std::isfinite(value) && value > 0.0; }
bool not_negative(double value) { return std::isfinite(value) && value >= 0.0; }

void check(const sensor::BeamModel& model, const NoiseConfig& noise) {
  const bool has_lasers = !model.lasers.empty();
  const bool turns = positive(model.rate_hz) && model.firing_period_ns > 0;
  const bool ranges = positive(model.range_max_m) && not_negative(model.range_resolution_m);
  if (!has_lasers || !turns || !ranges) throw std::invalid_argument("the sensor's model is not complete");
  if (!not_negative(noise.range_sigma_m)) {
    throw std::invalid_argument("the deviation of the noise must not be negative");
  }
  if (!not_negative(noise.dropout_at_range_max) || noise.dropout_at_range_max > 1.0) {
    throw std::invalid_argument("the share of lost returns must be 0 to 1");
  }
}

Firings firings_of(const sensor::BeamModel& model, std::uint64_t index) {
  const auto first_at_or_after = [&](std::int64_t revolution) {
    const std::int64_t time_ns = revolution * sensor::revolution_ns(model);
    return (time_ns + model.firing_period_ns - 1) / model.firing_period_ns;
  };
  const auto revolution = static_cast<std::int64_t>(index);
  return {first_at_or_after(revolution), first_at_or_after(revolution + 1)};
}

// Azimuth of the head: pi at the start of each revolution.
double azimuth_at(const sensor::BeamModel& model, std::int64_t time_ns) {
  const std::int64_t revolution_ns = sensor::revolution_ns(model);
  const double share = static_cast<double>(time_ns % revolution_ns) / static_cast<double>(revolution_ns);
  const double turned = 2.0 * std::numbers::pi * share;
  return model.clockwise ? std::numbers::pi - turned : turned - std::numbers::pi;
}

Vec3 direction_of(double azimuth_rad, double elevation_rad) {
  const double level = std::cos(elevation_rad);
  return {level * std::cos(azimuth_rad), level * std::sin(azimuth_rad), std::sin(elevation_rad)};
}

// Calibrated reflectivity in per cent of dry, clean surfaces: asphalt, concrete, paving, grass, plaster,
// galvanised steel, leaves, paint, clothes, orange plastic.
float reflectivity(Surface surface) {
  static constexpr std::array<float, enum_names<Surface>.size()> kPercent = {
      12.0F, 35.0F, 28.0F, 45.0F, 60.0F, 55.0F, 50.0F, 40.0F, 30.0F, 70.0F};
  return kPercent.at(static_cast<std::size_t>(surface));
}

bool is_lost(double distance, const sensor::BeamModel& model, const NoiseConfig& noise, const RayKey& key) {
  const double share = distance / model.range_max_m;
  return uniform(key, Draw::kDropout) < noise.dropout_at_range_max * share * share;
}

// The range that the sensor reports for a surface at that distance.
std::optional<double> measured_range(double distance, const sensor::BeamModel& model,
                                     const NoiseConfig& noise, const RayKey& key) {
  if (is_lost(distance, model, noise, key)) return std::nullopt;
  double range = distance;
  if (noise.range_sigma_m > 0.0) range += noise.range_sigma_m * gaussian(key, Draw::kRangeNoise);
  const double step = model.range_resolution_m;
  if (step > 0.0) range = step * std::round(range / step);
  if (range <= 0.0 || range < model.range_min_m || range > model.range_max_m) return std::nullopt;
  return range;
}

/// What the shots of a revolution need to know.
struct Shooter {
  const Caster& world;
  const sensor::BeamModel& model;
  const Trajectory& T_world_sensor_at;
  const NoiseConfig& noise;
  std::uint64_t index;

  [[nodiscard]] std::optional<Return> measure(const Hit& hit, Vec3 direction, std::uint64_t ray) const {
    const auto range = measured_range(hit.distance_m, model, noise, {noise.seed, index, ray});
    if (!range) return std::nullopt;
    return Return{*range * direction, reflectivity(hit.surface), label_of(hit.surface, hit.object)};
  }

  // Every laser once, each from where the sensor stands at its own time.
  void fire(std::int64_t start_ns, std::uint64_t first_ray, std::optional<Return>* returns) const {
    const std::size_t count = model.lasers.size();
    std::vector<Vec3> directions(count);
    std::vector<Ray> rays(count);
    std::vector<std::optional<Hit>> hits(count);
    for (std::size_t j = 0; j < count; ++j) {
      const std::int64_t time_ns = start_ns + model.lasers[j].time_ns;
      directions[j] = direction_of(azimuth_at(model, time_ns), model.lasers[j].elevation_rad);
      const Pose T_world_sensor = T_world_sensor_at(time_ns);
      rays[j] = {T_world_sensor.translation, rotate(T_world_sensor.rotation, directions[j])};
    }
    world.cast(rays, hits);
    for (std::size_t j = 0; j < count; ++j) {
      if (hits[j]) returns[j] = measure(*hits[j], directions[j], first_ray + j);
    }
  }
};

// One slot a shot, in the order of firing; each thread fills its own slots.
std::vector<std::optional<Return>> shoot_all(const Shooter& shooter, Firings firings) {
  const std::size_t lasers = shooter.model.lasers.size();
  const auto count = static_cast<std::size_t>(firings.end - firings.begin);
  std::vector<std::optional<Return>> returns(count * lasers);
  tbb::parallel_for(std::size_t{0}, count, [&](std::size_t firing) {
    const std::int64_t start_ns =
        (firings.begin + static_cast<std::int64_t>(firing)) * shooter.model.firing_period_ns;
    shooter.fire(start_ns, firing * lasers, returns.data() + firing * lasers);
  });
  return returns;
}

/// A cloud in the order of firing, and the exact time of each of its points.
struct TimedCloud {
  Cloud cloud;
  std::vector<std::uint32_t> time_offset_ns;
};

TimedCloud collect(const std::vector<std::optional<Return>>& returns, const sensor::BeamModel& model) {
  const std::vector<std::size_t> rings = sensor::rings_of(model);
  TimedCloud out;
  for (std::size_t ray = 0; ray < returns.size(); ++ray) {
    const auto& hit = returns[ray];
    if (!hit) continue;
    const std::size_t laser = ray % rings.size();
    const auto firing = static_cast<std::int64_t>(ray / rings.size());
    out.cloud.x.push_back(static_cast<float>(hit->p_sensor.x));
    out.cloud.y.push_back(static_cast<float>(hit->p_sensor.y));
    out.cloud.z.push_back(static_cast<float>(hit->p_sensor.z));
    out.cloud.intensity.push_back(hit->intensity);
    out.cloud.ring.push_back(static_cast<std::int64_t>(rings[laser]));
    out.cloud.label.push_back(hit->label);
    out.time_offset_ns.push_back(
        static_cast<std::uint32_t>(firing * model.firing_period_ns + model.lasers[laser].time_ns));
  }
  return out;
}

Scan to_scan(TimedCloud timed) {
  Scan scan = organise(std::move(timed.cloud)).scan;
  scan.time_offset_ns.clear();
  for (const std::uint32_t i : scan.input_index) scan.time_offset_ns.push_back(timed.time_offset_ns[i]);
  return scan;
}

}  // namespace

std::uint32_t label_of(Surface surface, std::uint32_t object) {
  return (object << 16U) | static_cast<std::uint32_t>(surface);
}

Scan simulate_revolution(const Caster& world, const sensor::BeamModel& model,
                         const Trajectory& T_world_sensor_at, std::uint64_t index, const NoiseConfig& noise) {
  check(model, noise);
  const Firings firings = firings_of(model, index);
  const auto returns = shoot_all({world, model, T_world_sensor_at, noise, index}, firings);
  Scan scan = to_scan(collect(returns, model));

  const std::int64_t begin_ns = firings.begin * model.firing_period_ns;
  const std::int64_t end_ns = firings.end * model.firing_period_ns;
  scan.frame = fmt::format("{:06}", index);
  scan.stamp_ns = begin_ns;
  scan.motion = Motion{T_world_sensor_at(begin_ns), T_world_sensor_at(end_ns), end_ns - begin_ns};
  scan.T_world_sensor = scan.motion->T_world_sensor_begin;
  return scan;
}

}  // namespace verge::sim
