// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/sensor/velodyne/encoder.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <utility>

namespace verge::sensor::velodyne {
namespace {

constexpr std::int64_t kHourNs = 3'600'000'000'000;

std::uint16_t wire_azimuth(double azimuth) {
  const auto whole = static_cast<std::int64_t>(std::llround(azimuth)) % kTurn;
  return static_cast<std::uint16_t>(whole < 0 ? whole + kTurn : whole);
}

std::uint8_t wire_intensity(float intensity) {
  if (!(intensity > 0.0F)) return 0;
  return static_cast<std::uint8_t>(std::min(255L, std::lround(intensity)));
}

/// A point's shot: which step, which slot of it.
struct Shot {
  std::size_t step = 0;
  std::size_t slot = 0;
};

std::optional<Shot> shot_of(const Facts& facts, std::size_t laser, std::int64_t after_ns, std::size_t steps) {
  const std::int64_t slack_ns = facts.step_ns / 8;  // stamps on the wire are whole microseconds
  for (std::size_t slot = laser; slot < kSlotsPerBlock; slot += facts.lasers_per_firing) {
    const std::int64_t begin_ns = after_ns - facts.slot_time_ns[slot] + slack_ns;
    if (begin_ns < 0 || begin_ns % facts.step_ns > 2 * slack_ns) continue;
    const auto step = static_cast<std::size_t>(begin_ns / facts.step_ns);
    if (step < steps) return Shot{step, slot};
  }
  return std::nullopt;
}

/// The count of distance; none where the wire cannot say it.
std::optional<std::uint16_t> wire_distance(const Cloud& cloud, std::size_t i, const LaserCorrection& laser,
                                           double step_m) {
  const double x = cloud.x[i];
  const double y = cloud.y[i];
  const double z = cloud.z[i];
  const double count = std::round((std::sqrt(x * x + y * y + z * z) - laser.distance_m) / step_m);
  if (!(count >= 1.0) || count > 65'535.0) return std::nullopt;
  return static_cast<std::uint16_t>(count);
}

}  // namespace

Encoder::Encoder(Model model) : facts_(facts_of(model)) {
  if (facts_.banks != 1) throw std::invalid_argument("sensors with two banks are not encoded");
  laser_of_ring_.resize(facts_.lasers);
  const std::vector<std::int64_t> rings = rings_of(facts_.calibration);
  for (std::size_t laser = 0; laser < rings.size(); ++laser) {
    laser_of_ring_[static_cast<std::size_t>(rings[laser])] = laser;
  }
  packet_.product = *facts_.product;
}

void Encoder::add(const Cloud& cloud, std::int64_t stamp_ns, const Turning& turning, std::int64_t end_ns) {
  const std::int64_t lasts_ns = std::max<std::int64_t>(0, end_ns - turning.begin_ns);
  const auto steps = static_cast<std::size_t>((lasts_ns + facts_.step_ns - 1) / facts_.step_ns);
  std::vector<RawBlock> blocks(steps);
  const bool timed = cloud.ring.size() == cloud.x.size() && cloud.time_s.size() == cloud.x.size();
  counters_.points += cloud.x.size();
  if (!timed) counters_.not_on_wire += cloud.x.size();
  for (std::size_t i = 0; timed && i < cloud.x.size(); ++i) {
    const std::int64_t after_ns = stamp_ns - turning.begin_ns + std::llround(1e9 * cloud.time_s[i]);
    const bool known = cloud.ring[i] >= 0 && cloud.ring[i] < static_cast<std::int64_t>(facts_.lasers);
    const std::size_t laser = known ? laser_of_ring_[static_cast<std::size_t>(cloud.ring[i])] : 0;
    const auto shot = known ? shot_of(facts_, laser, after_ns, steps) : std::nullopt;
    const auto distance = wire_distance(cloud, i, facts_.calibration[laser], facts_.range_step_m);
    if (!shot || !distance) {
      ++counters_.not_on_wire;
      continue;
    }
    RawBlock& block = blocks[shot->step];
    std::uint16_t& there = block.distance[shot->slot];
    if (there != 0) ++counters_.displaced;
    if (there == 0) ++counters_.encoded;
    if (there != 0 && there <= *distance) continue;
    there = *distance;
    block.intensity[shot->slot] =
        cloud.intensity.empty() ? std::uint8_t{0} : wire_intensity(cloud.intensity[i]);
  }
  step_turn_ = turning.rate_hz * kTurn * 1e-9 * facts_.step_ns;
  const double begin = turning.begin_azimuth_rad * 18'000.0 / std::numbers::pi;
  for (std::size_t step = 0; step < steps; ++step) {
    blocks[step].azimuth = wire_azimuth(begin + static_cast<double>(step) * step_turn_);
    append(blocks[step], turning.begin_ns + static_cast<std::int64_t>(step) * facts_.step_ns);
  }
}

void Encoder::append(const RawBlock& block, std::int64_t time_ns) {
  if (blocks_ == 0) {
    packet_ns_ = time_ns;
    packet_.stamp_us = static_cast<std::uint32_t>(time_ns % kHourNs / 1000);
  }
  packet_.blocks[blocks_] = block;
  if (++blocks_ < kBlocksPerPacket) return;
  full_.push_back({to_bytes(packet_), packet_ns_});
  blocks_ = 0;
}

std::vector<SentPacket> Encoder::take() { return std::exchange(full_, {}); }

std::vector<SentPacket> Encoder::finish() {
  while (blocks_ != 0) {
    RawBlock empty;
    empty.azimuth = wire_azimuth(packet_.blocks[blocks_ - 1].azimuth + step_turn_);
    append(empty, packet_ns_ + static_cast<std::int64_t>(blocks_) * facts_.step_ns);
  }
  return take();
}

}  // namespace verge::sensor::velodyne
