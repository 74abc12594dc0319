// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/sim/lidar_model.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "verge/sensor/ibeo/alasca_scan.hpp"
#include "verge/sensor/velodyne/facts.hpp"

namespace verge::sim {
namespace {

namespace ibeo = sensor::ibeo;

constexpr std::size_t kIbeoEchoes = 3;

bool positive(double value) { return std::isfinite(value) && value > 0.0; }

void check(const sensor::BeamModel& facts) {
  const bool turns = positive(facts.rate_hz) && facts.firing_period_ns > 0 && facts.block_ns > 0;
  const bool ranges = positive(facts.range_max_m) && std::isfinite(facts.range_resolution_m) &&
                      facts.range_resolution_m >= 0.0;
  if (facts.lasers.empty() || !turns || !ranges) {
    throw std::invalid_argument("the sensor's model is not complete");
  }
}

Vec3 direction_of(double azimuth_rad, double elevation_rad) {
  const double level = std::cos(elevation_rad);
  return {level * std::cos(azimuth_rad), level * std::sin(azimuth_rad), std::sin(elevation_rad)};
}

std::int64_t period_of(double rate_hz) { return std::llround(1e9 / rate_hz); }

/// A head that turns evenly, as its packets tell it: its azimuth at the start of each block in whole
/// hundredths of a degree, and between two blocks in proportion to the time.
class Head {
 public:
  explicit Head(const sensor::BeamModel& facts) : facts_(facts), period_ns_(sensor::revolution_ns(facts)) {}

  /// Number of the first block that begins in that revolution.
  [[nodiscard]] std::int64_t first_block(std::uint64_t revolution) const {
    const std::int64_t begin = static_cast<std::int64_t>(revolution) * kTurn;
    std::int64_t block = static_cast<std::int64_t>(revolution) * period_ns_ / facts_.block_ns;
    while (turned(block) < begin) ++block;
    return block;
  }

  /// Counter-clockwise; pi is the rear, where a revolution begins.
  [[nodiscard]] double azimuth(std::int64_t time_ns) const {
    const std::int64_t block = time_ns / facts_.block_ns;
    const double share =
        static_cast<double>(time_ns % facts_.block_ns) / static_cast<double>(facts_.block_ns);
    const std::int64_t begin = turned(block);
    const auto step = static_cast<double>(turned(block + 1) - begin);
    const double turn = (static_cast<double>(begin % kTurn) + share * step) / static_cast<double>(kTurn);
    const double from_rear = 2.0 * std::numbers::pi * turn;
    return facts_.clockwise ? std::numbers::pi - from_rear : from_rear - std::numbers::pi;
  }

 private:
  static constexpr std::int64_t kTurn = sensor::velodyne::kTurn;

  // Hundredths of a degree since the start of the drive.
  [[nodiscard]] std::int64_t turned(std::int64_t block) const {
    const std::int64_t time_ns = block * facts_.block_ns;
    return time_ns / period_ns_ * kTurn + (time_ns % period_ns_ * kTurn + period_ns_ / 2) / period_ns_;
  }

  const sensor::BeamModel& facts_;
  std::int64_t period_ns_;
};

Shot shot_of(const sensor::Laser& laser, std::int64_t time_ns, double head_rad) {
  const double azimuth = head_rad - laser.azimuth_rad;
  const Vec3 left = {-std::sin(azimuth), std::cos(azimuth), 0.0};
  return {.time_ns = time_ns,
          .origin = laser.left_m * left + Vec3{0.0, 0.0, laser.up_m},
          .direction = direction_of(azimuth, laser.elevation_rad),
          .ring = static_cast<std::uint32_t>(laser.ring)};
}

ShotPlan revolution(const sensor::BeamModel& facts, std::uint64_t index) {
  const Head head(facts);
  ShotPlan plan{head.first_block(index) * facts.block_ns, head.first_block(index + 1) * facts.block_ns, {}};
  const std::int64_t first = plan.begin_ns / facts.firing_period_ns;
  const std::int64_t last = (plan.end_ns - 1) / facts.firing_period_ns;
  plan.shots.reserve(static_cast<std::size_t>(last - first + 1) * facts.lasers.size());
  for (std::int64_t firing = first; firing <= last; ++firing) {
    for (const sensor::Laser& laser : facts.lasers) {
      const std::int64_t time_ns = firing * facts.firing_period_ns + laser.time_ns;
      if (time_ns < plan.begin_ns || time_ns >= plan.end_ns) continue;  // of another revolution's block
      plan.shots.push_back(shot_of(laser, time_ns, head.azimuth(time_ns)));
    }
  }
  return plan;
}

/// A sweep of a mirror that turns evenly, `turn_ns` for a whole turn.
struct Sweep {
  std::int64_t begin_ns = 0;
  double left_rad = 0.0;  // where it begins
  double turn_ns = 0.0;

  [[nodiscard]] std::int64_t time_at(double angle_rad) const {
    return begin_ns + std::llround(turn_ns * (left_rad - angle_rad) / (2.0 * std::numbers::pi));
  }
};

ShotPlan lux_scan(const ibeo::LuxModel& facts, std::int64_t period_ns,
                  const std::vector<ibeo::LuxZone>& zones, std::uint64_t index) {
  const auto angle_of = [&](int ticks) { return 2.0 * std::numbers::pi * ticks / facts.ticks_per_turn; };
  const Sweep sweep{static_cast<std::int64_t>(index) * period_ns, angle_of(facts.start_angle_ticks),
                    static_cast<double>(period_ns)};
  const bool rear_mirror = index % 2 == 1;
  ShotPlan plan{sweep.begin_ns, sweep.time_at(angle_of(facts.end_angle_ticks)), {}};
  for (const ibeo::LuxPulse& pulse : ibeo::pulses_of(facts, zones)) {
    const double angle = angle_of(pulse.angle_ticks);
    for (std::uint32_t layer = pulse.lower_layer; layer < pulse.lower_layer + 2U; ++layer) {
      const double elevation = ibeo::elevation_rad(facts, layer, angle, rear_mirror);
      plan.shots.push_back({sweep.time_at(angle), {}, direction_of(angle, elevation), layer});
    }
  }
  return plan;
}

ShotPlan alasca_scan(const ibeo::AlascaModel& facts, std::uint64_t index) {
  const std::int64_t period_ns = period_of(facts.rate_hz);
  const Sweep sweep{static_cast<std::int64_t>(index) * period_ns, facts.side_rad,
                    static_cast<double>(period_ns)};
  ShotPlan plan{sweep.begin_ns, sweep.time_at(-facts.side_rad), {}};
  const auto steps = std::llround(facts.side_rad / facts.step_rad);
  for (std::int64_t step = steps; step >= -steps; --step) {
    const double angle = static_cast<double>(step) * facts.step_rad;
    for (std::uint32_t layer = 0; layer < facts.layer_elevation_rad.size(); ++layer) {
      plan.shots.push_back(
          {sweep.time_at(angle), {}, direction_of(angle, facts.layer_elevation_rad[layer]), layer});
    }
  }
  return plan;
}

}  // namespace

LidarModel spinning_lidar(sensor::BeamModel facts, const Optics& optics) {
  check(facts);
  LidarModel model{.name = facts.name,
                   .period_ns = sensor::revolution_ns(facts),
                   .range_min_m = facts.range_min_m,
                   .range_max_m = facts.range_max_m,
                   .range_resolution_m = facts.range_resolution_m,
                   .optics = optics};
  for (const sensor::Laser& laser : facts.lasers) model.rings = std::max(model.rings, laser.ring + 1);
  model.shots = [facts = std::move(facts)](std::uint64_t scan) { return revolution(facts, scan); };
  return model;
}

LidarModel lux_lidar(ibeo::LuxModel facts, double rate_hz, std::vector<ibeo::LuxZone> zones,
                     const Optics& optics) {
  if (!positive(rate_hz)) throw std::invalid_argument("the sensor's rate must be positive");
  constexpr std::uint32_t kClutter = 0x02;
  constexpr std::uint32_t kDirt = 0x08;
  LidarModel model{
      .name = facts.name,
      .rings = facts.layer_elevation_rad.size(),
      .period_ns = period_of(rate_hz),
      .range_min_m = facts.range_min_m,
      .range_max_m = facts.range_max_m,
      .range_resolution_m = 0.01,
      .echoes = kIbeoEchoes,
      .optics = optics,
      .reports = {.intensity = false, .pulse_units_per_m = 1.0, .rain_flag = kClutter, .dirt_flag = kDirt}};
  model.shots = [facts = std::move(facts), zones = std::move(zones), period_ns = model.period_ns](
                    std::uint64_t scan) { return lux_scan(facts, period_ns, zones, scan); };
  return model;
}

LidarModel alasca_lidar(ibeo::AlascaModel facts, const Optics& optics) {
  constexpr double kCentimetres = 100.0;
  LidarModel model{.name = facts.name,
                   .rings = facts.layer_elevation_rad.size(),
                   .period_ns = period_of(facts.rate_hz),
                   .range_min_m = facts.range_min_m,
                   .range_max_m = facts.range_max_m,
                   .range_resolution_m = 0.0,  // its wire rounds coordinates, not ranges
                   .echoes = kIbeoEchoes,
                   .optics = optics,
                   .reports = {.intensity = false,
                               .pulse_units_per_m = kCentimetres,
                               .rain_flag = static_cast<std::uint32_t>(ibeo::AlascaStatus::kRain),
                               .dirt_flag = static_cast<std::uint32_t>(ibeo::AlascaStatus::kDirt)}};
  model.shots = [facts = std::move(facts)](std::uint64_t scan) { return alasca_scan(facts, scan); };
  return model;
}

}  // namespace verge::sim
