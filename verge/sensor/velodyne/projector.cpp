// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/sensor/velodyne/projector.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>

#include "verge/core/angle.hpp"
#include "verge/sensor/velodyne/correction.hpp"

namespace verge::sensor::velodyne {
namespace {

/// cos and sin of all azimuths there are on the wire.
struct Direction {
  float cosine;
  float sine;
};

const std::vector<Direction>& directions() {
  static const std::vector<Direction> table = [] {
    std::vector<Direction> all(kTurn);
    for (std::size_t i = 0; i < all.size(); ++i) {
      const double azimuth = deg_to_rad(0.01 * static_cast<double>(i));
      all[i] = {static_cast<float>(std::cos(azimuth)), static_cast<float>(std::sin(azimuth))};
    }
    return all;
  }();
  return table;
}

constexpr double kRadPerUnit = std::numbers::pi / 18'000.0;

/// The least and the greatest count of distance between two ranges. By rounding first, so that 0.9 m is 450
/// counts of 2 mm whatever the last bit of the quotient says.
std::uint16_t count_at_least(double range_m, double step_m) {
  return static_cast<std::uint16_t>(std::clamp(std::ceil(range_m / step_m - 1e-6), 1.0, 65'535.0));
}
std::uint16_t count_at_most(double range_m, double step_m) {
  return static_cast<std::uint16_t>(std::clamp(std::floor(range_m / step_m + 1e-6), 0.0, 65'535.0));
}

template <class T>
void append_column(std::vector<T>& column, const T* from, std::size_t count) {
  column.insert(column.end(), from, from + count);
}

}  // namespace

Projector::Projector(const Facts& facts, const Calibration& calibration, double range_min_m,
                     double range_max_m)
    : range_step_m_(static_cast<float>(facts.range_step_m)) {
  for (std::size_t slot = 0; slot < kSlotsPerBlock; ++slot) {
    slot_time_ns_[slot] = static_cast<float>(facts.slot_time_ns[slot]);
    slot_time_s_[slot] = 1e-9 * facts.slot_time_ns[slot];
  }
  for (std::size_t bank = 0; bank < facts.banks; ++bank) {
    banks_.push_back(make_bank(facts, calibration, bank, range_min_m, range_max_m));
  }
}

Projector::Bank Projector::make_bank(const Facts& facts, const Calibration& calibration, std::size_t bank,
                                     double range_min_m, double range_max_m) {
  Bank out;
  const std::vector<std::int64_t> rings = rings_of(calibration);
  for (std::size_t slot = 0; slot < kSlotsPerBlock; ++slot) {
    const std::size_t laser = bank * kSlotsPerBlock + slot % facts.lasers_per_firing;
    const LaserCorrection& correction = calibration[laser];
    const double level = std::cos(correction.elevation_rad);
    out.ahead[slot] = static_cast<float>(level * std::cos(correction.azimuth_rad));
    out.aside[slot] = static_cast<float>(level * std::sin(correction.azimuth_rad));
    out.up[slot] = static_cast<float>(std::sin(correction.elevation_rad));
    out.distance[slot] = static_cast<float>(correction.distance_m);
    out.count_min[slot] = count_at_least(range_min_m - correction.distance_m, facts.range_step_m);
    const std::uint16_t most = count_at_most(range_max_m - correction.distance_m, facts.range_step_m);
    out.count_span[slot] = static_cast<std::uint16_t>(std::max(0, most - out.count_min[slot]));
    out.ring[slot] = rings[laser];
    out.correction[slot] = correction;
    out.shifted = out.shifted || correction.up_m != 0.0 || correction.left_m != 0.0 || correction.near;
  }
  return out;
}

void Projector::load(Bytes packet, std::size_t block, Lanes& lanes) {
  const std::byte* at = packet.data() + block * 100 + 4;
  for (std::size_t slot = 0; slot < kSlotsPerBlock; ++slot) {
    std::memcpy(&lanes.distance[slot], at + 3 * slot, 2);
    lanes.intensity[slot] = static_cast<float>(static_cast<std::uint8_t>(at[3 * slot + 2]));
  }
}

void Projector::judge(const Bank& bank, Lanes& lanes, PointCounters& counters) {
  unsigned valid = 0;
  for (std::size_t slot = 0; slot < kSlotsPerBlock; ++slot) {
    // One comparison of 16 bits: below the least count it wraps around.
    const auto above_least = static_cast<std::uint16_t>(lanes.distance[slot] - bank.count_min[slot]);
    lanes.valid[slot] = above_least <= bank.count_span[slot] ? 1 : 0;
    valid += lanes.valid[slot];
  }
  lanes.all_valid = valid == kSlotsPerBlock;
  if (lanes.all_valid) return;
  for (std::size_t slot = 0; slot < kSlotsPerBlock; ++slot) {
    const std::uint16_t distance = lanes.distance[slot];
    if (lanes.valid[slot] != 0) continue;
    std::uint64_t& reason = distance == 0                     ? counters.no_return
                            : distance < bank.count_min[slot] ? counters.below_min
                                                              : counters.above_max;
    ++reason;
  }
}

/// Each laser's azimuth is the head's when it fired. The head turns little within a block (0.0004 rad for an
/// HDL-32E at 10 Hz), so that two terms of the series are exact to float.
void Projector::place(const Bank& bank, const PlannedBlock& plan, Lanes& lanes) const {
  const auto [cosine, sine] = directions()[plan.azimuth];
  const auto turn = static_cast<float>(plan.turn_per_ns * kRadPerUnit);
  for (std::size_t slot = 0; slot < kSlotsPerBlock; ++slot) {
    const float d = turn * slot_time_ns_[slot];
    const float cos_d = 1.0F - 0.5F * d * d;
    const float sin_d = d * (1.0F - d * d * (1.0F / 6.0F));
    const float cos_head = cosine * cos_d - sine * sin_d;
    const float sin_head = sine * cos_d + cosine * sin_d;
    const float range = static_cast<float>(lanes.distance[slot]) * range_step_m_ + bank.distance[slot];
    lanes.x[slot] = range * (bank.ahead[slot] * cos_head - bank.aside[slot] * sin_head);
    lanes.y[slot] = -range * (bank.ahead[slot] * sin_head + bank.aside[slot] * cos_head);
    lanes.z[slot] = range * bank.up[slot];
  }
}

/// HDL-64E: beams that do not start in the origin, and distances that are corrected otherwise near by.
void Projector::shift(const Bank& bank, const PlannedBlock& plan, Lanes& lanes) const {
  for (std::size_t slot = 0; slot < kSlotsPerBlock; ++slot) {
    const LaserCorrection& laser = bank.correction[slot];
    const double azimuth =
        kRadPerUnit * (plan.azimuth + plan.turn_per_ns * static_cast<double>(slot_time_ns_[slot])) +
        laser.azimuth_rad;
    const double cos_a = std::cos(azimuth);
    const double sin_a = std::sin(azimuth);
    const double level = std::cos(laser.elevation_rad);
    const double measured = static_cast<double>(lanes.distance[slot]) * static_cast<double>(range_step_m_);
    const auto [ahead_m, side_m] = corrected(laser, measured, measured < kFarM, level * cos_a, level * sin_a);
    const double mean_m = 0.5 * (ahead_m + side_m);
    lanes.x[slot] = static_cast<float>(ahead_m * level * cos_a + laser.left_m * sin_a);
    lanes.y[slot] = static_cast<float>(-side_m * level * sin_a + laser.left_m * cos_a);
    lanes.z[slot] = static_cast<float>(mean_m * std::sin(laser.elevation_rad) + laser.up_m);
  }
}

void Projector::append(const Bank& bank, const Lanes& lanes, double time_s, PointBatch& batch) const {
  // Plain pointers: every lane is written, and only those that are valid move the end on.
  float* x = batch.x.data() + batch.size;
  float* y = batch.y.data() + batch.size;
  float* z = batch.z.data() + batch.size;
  float* intensity = batch.intensity.data() + batch.size;
  std::int64_t* ring = batch.ring.data() + batch.size;
  double* time = batch.time_s.data() + batch.size;
  std::size_t n = 0;
  if (lanes.all_valid) {
    for (; n < kSlotsPerBlock; ++n) time[n] = time_s + slot_time_s_[n];
    std::copy_n(lanes.x.data(), n, x);
    std::copy_n(lanes.y.data(), n, y);
    std::copy_n(lanes.z.data(), n, z);
    std::copy_n(lanes.intensity.data(), n, intensity);
    std::copy_n(bank.ring.data(), n, ring);
  } else {
    for (std::size_t slot = 0; slot < kSlotsPerBlock; ++slot) {
      x[n] = lanes.x[slot];
      y[n] = lanes.y[slot];
      z[n] = lanes.z[slot];
      intensity[n] = lanes.intensity[slot];
      ring[n] = bank.ring[slot];
      time[n] = time_s + slot_time_s_[slot];
      n += lanes.valid[slot];
    }
  }
  batch.size += n;
}

void Projector::add(Bytes packet, std::size_t block, const PlannedBlock& plan, double time_s,
                    const std::size_t* other, PointBatch& batch, PointCounters& counters) const {
  const Bank& bank = banks_[plan.bank];
  Lanes lanes;
  load(packet, block, lanes);
  judge(bank, lanes, counters);
  place(bank, plan, lanes);
  if (bank.shifted) shift(bank, plan, lanes);
  counters.measured += kSlotsPerBlock;
  std::size_t at = batch.size;
  if (other != nullptr) {
    Lanes others;
    load(packet, *other, others);
    for (std::size_t slot = 0; slot < kSlotsPerBlock; ++slot) {
      if (lanes.valid[slot] == 0) continue;
      const bool same = lanes.distance[slot] == others.distance[slot];
      if (same && plan.echo == 1) {
        lanes.valid[slot] = 0;
        lanes.all_valid = false;
        ++counters.same_echo;
        continue;
      }
      batch.echo[at++] = others.distance[slot] != 0 && lanes.distance[slot] > others.distance[slot] ? 1 : 0;
    }
  }
  const std::size_t before = batch.size;
  append(bank, lanes, time_s, batch);
  if (other == nullptr)
    std::fill(batch.echo.begin() + static_cast<std::ptrdiff_t>(before),
              batch.echo.begin() + static_cast<std::ptrdiff_t>(batch.size), std::uint8_t{0});
  counters.used += batch.size - before;
}

void move_points(PointBatch& batch, Cloud& cloud, bool with_echo) {
  const std::size_t n = batch.size;
  append_column(cloud.x, batch.x.data(), n);
  append_column(cloud.y, batch.y.data(), n);
  append_column(cloud.z, batch.z.data(), n);
  append_column(cloud.intensity, batch.intensity.data(), n);
  append_column(cloud.ring, batch.ring.data(), n);
  append_column(cloud.time_s, batch.time_s.data(), n);
  if (with_echo) append_column(cloud.echo, batch.echo.data(), n);
  batch.size = 0;
}

}  // namespace verge::sensor::velodyne
