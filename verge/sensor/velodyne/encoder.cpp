// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/sensor/velodyne/encoder.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "verge/sensor/velodyne/unprojector.hpp"

namespace verge::sensor::velodyne {
namespace {

constexpr std::int64_t kHourNs = 3'600'000'000'000;
constexpr double kUsualRateHz = 10.0;
constexpr std::size_t kStepsOfSeries1 = 4;  // three of the upper bank, one of the lower

std::uint16_t wire_azimuth(double azimuth) {
  const auto whole = static_cast<std::int64_t>(std::llround(azimuth)) % kTurn;
  return static_cast<std::uint16_t>(whole < 0 ? whole + kTurn : whole);
}

std::uint8_t wire_intensity(float intensity) {
  if (!(intensity > 0.0F)) return 0;
  return static_cast<std::uint8_t>(std::lround(std::min(255.0F, intensity)));
}

double turn_of_step(const Facts& facts, double rate_hz) { return rate_hz * kTurn * 1e-9 * facts.step_ns; }

std::size_t firings_per_step(const Facts& facts) { return kSlotsPerBlock / facts.lasers_per_firing; }

std::int64_t firing_period_ns(const Facts& facts) {
  return facts.step_ns / static_cast<std::int64_t>(firings_per_step(facts));
}

/// Whether a step is of one bank alone, as those of an HDL-64E S1 are.
bool banks_take_turns(const Facts& facts) { return facts.banks == 2 && !facts.banks_share_step; }

}  // namespace

Encoder::Encoder(Model model, const std::optional<Calibration>& calibration)
    : facts_(facts_of(model)),
      calibration_(calibration.value_or(facts_.calibration)),
      step_turn_(turn_of_step(facts_, kUsualRateHz)) {
  if (calibration_.size() != facts_.lasers) {
    throw std::invalid_argument("the calibration does not have the lasers of the model");
  }
  laser_of_ring_.resize(facts_.lasers);
  const std::vector<std::int64_t> rings = rings_of(calibration_);
  for (std::size_t laser = 0; laser < rings.size(); ++laser) {
    laser_of_ring_[static_cast<std::size_t>(rings[laser])] = laser;
  }
}

std::size_t Encoder::steps_per_packet(bool dual) const {
  return kBlocksPerPacket / (facts_.banks_share_step ? 2U : 1U) / (dual ? 2U : 1U);
}

std::optional<Encoder::Shot> Encoder::shot_of(const Cloud& cloud, std::size_t i,
                                              std::int64_t stamp_ns) const {
  if (cloud.ring[i] < 0 || cloud.ring[i] >= static_cast<std::int64_t>(facts_.lasers)) return std::nullopt;
  if (!(std::abs(cloud.time_s[i]) < 1e6)) return std::nullopt;
  const std::size_t laser = laser_of_ring_[static_cast<std::size_t>(cloud.ring[i])];
  const Vec3 point{cloud.x[i], cloud.y[i], cloud.z[i]};
  const auto measured = unproject(calibration_[laser], facts_.range_step_m, point);
  if (!measured) return std::nullopt;
  const std::int64_t time_ns = stamp_ns + std::llround(1e9 * cloud.time_s[i]);
  return Shot{.firing_ns = time_ns - facts_.slot_time_ns[laser % kSlotsPerBlock],
              .laser = laser,
              .measured = {.count = measured->count,
                           .intensity =
                               cloud.intensity.empty() ? std::uint8_t{0} : wire_intensity(cloud.intensity[i]),
                           .farther = !cloud.echo.empty() && cloud.echo[i] != 0},
              .azimuth = measured->azimuth};
}

/// The points that can be on the wire, in the cloud's order.
std::vector<Encoder::Shot> Encoder::shots_of(const Cloud& cloud, std::int64_t stamp_ns) {
  std::vector<Shot> shots;
  shots.reserve(cloud.x.size());
  counters_.points += cloud.x.size();
  const bool timed = cloud.ring.size() == cloud.x.size() && cloud.time_s.size() == cloud.x.size();
  for (std::size_t i = 0; timed && i < cloud.x.size(); ++i) {
    if (auto shot = shot_of(cloud, i, stamp_ns)) shots.push_back(*shot);
  }
  counters_.not_on_wire += cloud.x.size() - shots.size();
  return shots;
}

namespace {

/// In a step, points of the second block come behind all of the first: where firings or slots begin again.
template <class Shots>
void find_second_blocks(Shots& shots) {
  const auto place = [](const auto& shot) { return std::pair(*shot.firing, shot.laser); };
  const auto* before = static_cast<decltype(shots.data())>(nullptr);
  std::int64_t newest_ns = std::numeric_limits<std::int64_t>::min();
  for (auto& shot : shots) {
    if (!shot.firing) continue;
    if (before != nullptr && shot.step_ns <= newest_ns) {
      const bool again = shot.step_ns < before->step_ns || place(shot) <= place(*before);
      shot.second = before->second || again;
    }
    newest_ns = std::max(newest_ns, shot.step_ns);
    before = &shot;
  }
}

}  // namespace

void Encoder::put(Step& step, const Shot& shot, bool dual) {
  const std::size_t bank = shot.laser / kSlotsPerBlock;
  if (banks_take_turns(facts_) && step.bank.value_or(bank) != bank) {
    ++counters_.not_on_wire;
    return;
  }
  step.bank = bank;
  const std::size_t slot = shot.laser + *shot.firing * facts_.lasers_per_firing;
  step.samples.push_back(
      {shot.azimuth, static_cast<double>(facts_.slot_time_ns[slot % kSlotsPerBlock]) / facts_.step_ns});
  auto& [first, second] = step.returns[slot];
  Return* free = first.count == 0 ? &first : nullptr;
  if (dual && second.count == 0 && (shot.second || free == nullptr)) free = &second;
  if (free == nullptr) {
    ++counters_.displaced;
    if (!dual && shot.measured.count < first.count) first = shot.measured;
    return;
  }
  *free = shot.measured;
  ++counters_.encoded;
}

void Encoder::add(const Cloud& cloud, std::int64_t stamp_ns, const Turning& turning, std::int64_t end_ns) {
  const bool dual = !cloud.echo.empty();
  const std::int64_t lasts_ns = std::max<std::int64_t>(0, end_ns - turning.begin_ns);
  const std::int64_t steps = (lasts_ns + facts_.step_ns - 1) / facts_.step_ns;
  const std::int64_t period_ns = firing_period_ns(facts_);
  const std::int64_t slack_ns = facts_.step_ns / 8;  // stamps on the wire are whole microseconds
  std::vector<Shot> shots = shots_of(cloud, stamp_ns);
  for (Shot& shot : shots) {
    const std::int64_t after_ns = shot.firing_ns - turning.begin_ns + slack_ns;
    if (after_ns < 0 || after_ns >= steps * facts_.step_ns || after_ns % period_ns > 2 * slack_ns) continue;
    shot.step_ns = turning.begin_ns + after_ns / facts_.step_ns * facts_.step_ns;
    shot.firing = static_cast<std::size_t>(after_ns % facts_.step_ns / period_ns);
  }
  find_second_blocks(shots);
  std::vector<Step> all(static_cast<std::size_t>(steps));
  for (const Shot& shot : shots) {
    if (!shot.firing) ++counters_.not_on_wire;
    if (shot.firing)
      put(all[static_cast<std::size_t>((shot.step_ns - turning.begin_ns) / facts_.step_ns)], shot, dual);
  }
  step_turn_ = turn_of_step(facts_, turning.rate_hz);
  const double begin = turning.begin_azimuth_rad * 18'000.0 / std::numbers::pi;
  for (std::size_t step = 0; step < all.size(); ++step) {
    all[step].azimuth = begin + static_cast<double>(step) * step_turn_;
    append(std::move(all[step]), turning.begin_ns + static_cast<std::int64_t>(step) * facts_.step_ns, dual);
  }
}

/// Sorts the shots by their firings' times and finds the packets of these; packets that are full are closed.
void Encoder::add(const Cloud& cloud, std::int64_t stamp_ns) {
  const bool dual = !cloud.echo.empty();
  std::vector<Shot> shots = shots_of(cloud, stamp_ns);
  find_steps(shots, dual);
  find_second_blocks(shots);
  std::stable_sort(shots.begin(), shots.end(),
                   [](const Shot& a, const Shot& b) { return a.firing_ns < b.firing_ns; });
  for (const Shot& shot : shots) {
    if (!shot.firing) {
      ++counters_.not_on_wire;
      continue;
    }
    if (!open_ || open_->begin_ns != shot.packet_ns) open(shot.packet_ns, dual);
    put(open_->steps[static_cast<std::size_t>((shot.step_ns - shot.packet_ns) / facts_.step_ns)], shot, dual);
  }
}

/// Which step of which packet each shot is of, by the times of all firings.
void Encoder::find_steps(std::vector<Shot>& shots, bool dual) {
  constexpr std::size_t kAhead = 1000;
  if (!grid_ || grid_dual_ != dual) {
    close();
    grid_.emplace(facts_, steps_per_packet(dual) * firings_per_step(facts_));
    grid_dual_ = dual;
  }
  std::map<std::int64_t, std::optional<PacketGrid::Place>> places;
  for (const Shot& shot : shots) places[shot.firing_ns];
  std::vector<std::int64_t> ahead;
  for (auto at = places.begin(); at != places.end() && ahead.size() < kAhead; ++at)
    ahead.push_back(at->first);
  for (auto& [time_ns, place] : places) place = grid_->place(time_ns, ahead);
  for (Shot& shot : shots) {
    const auto& place = places[shot.firing_ns];
    if (!place) continue;
    shot.packet_ns = place->packet_ns;
    const std::size_t step = place->firing / firings_per_step(facts_);
    shot.step_ns = place->packet_ns + static_cast<std::int64_t>(step) * facts_.step_ns;
    shot.firing = place->firing % firings_per_step(facts_);
  }
}

void Encoder::open(std::int64_t begin_ns, bool dual) {
  close();
  open_ = OpenPacket{.begin_ns = begin_ns, .dual = dual, .steps = std::vector<Step>(steps_per_packet(dual))};
}

void Encoder::append(Step step, std::int64_t time_ns, bool dual) {
  if (!open_ || open_->dual != dual) open(time_ns, dual);
  open_->steps[open_->used] = std::move(step);
  if (++open_->used == open_->steps.size()) close();
}

/// As they are known, or as the points tell.
std::vector<std::uint16_t> Encoder::azimuths_of(const OpenPacket& packet) {
  std::vector<std::uint16_t> azimuths;
  if (packet.steps.front().azimuth) {
    for (const Step& step : packet.steps) {
      last_azimuth_ = step.azimuth.value_or(last_azimuth_ + step_turn_);
      azimuths.push_back(wire_azimuth(last_azimuth_));
    }
    return azimuths;
  }
  std::vector<std::vector<HeadSample>> samples;
  for (const Step& step : packet.steps) samples.push_back(step.samples);
  HeadAzimuths fitted = fit_azimuths(samples, step_turn_, last_azimuth_ + step_turn_);
  step_turn_ = fitted.turn;
  last_azimuth_ = fitted.azimuth.back();
  return std::move(fitted.azimuth);
}

/// What stands in the block of the echo that was not handed out, beside the other one. That one's echo number
/// may tell of something nearer, which the decoder left out as too near; else a second echo is the first one
/// again.
Encoder::Return Encoder::missing_echo(const Return& other, bool is_second,
                                      const LaserCorrection& laser) const {
  const bool can_be_too_near = facts_.range_min_m - laser.distance_m > 2.0 * facts_.range_step_m;
  if (other.count > 1 && other.farther && can_be_too_near) return {.count = 1};
  return is_second ? other : Return{};
}

/// Which of four steps are of the lower bank, in a packet of an HDL-64E S1: as those with returns say, for
/// the decoder knows the series by that.
std::size_t Encoder::lower_step(const OpenPacket& packet) {
  std::array<bool, kStepsOfSeries1> is_upper{};
  for (std::size_t number = 0; number < packet.steps.size(); ++number) {
    const std::optional<std::size_t> bank = packet.steps[number].bank;
    if (bank == 1U) return number % kStepsOfSeries1;
    if (bank) is_upper.at(number % kStepsOfSeries1) = true;
  }
  const auto free = std::find(is_upper.begin(), is_upper.end(), false);
  return free == is_upper.end() ? 0 : static_cast<std::size_t>(free - is_upper.begin());
}

void Encoder::fill_step(RawPacket& packet, std::size_t number, const Step& step, std::uint16_t azimuth,
                        std::size_t lower) const {
  const std::size_t banks = facts_.banks_share_step ? 2 : 1;
  const std::size_t echoes = packet.mode == kModeDual ? 2 : 1;
  const std::size_t only_bank =
      step.bank.value_or(static_cast<std::size_t>(number % kStepsOfSeries1 == lower));
  for (std::size_t b = 0; b < banks * echoes; ++b) {
    const std::size_t bank = banks_take_turns(facts_) ? only_bank : b % banks;
    RawBlock& block = packet.blocks[number * banks * echoes + b];
    block.flag = bank == 1 ? kLowerBank : kUpperBank;
    block.azimuth = azimuth;
    for (std::size_t slot = 0; slot < kSlotsPerBlock; ++slot) {
      const auto& returns = step.returns[bank * kSlotsPerBlock + slot];
      const std::size_t laser = bank * kSlotsPerBlock + slot % facts_.lasers_per_firing;
      const bool first = b / banks == 0;
      const Return measured = echoes == 1 || returns[first ? 0 : 1].count != 0
                                  ? returns[first ? 0 : 1]
                                  : missing_echo(returns[first ? 1 : 0], !first, calibration_[laser]);
      block.distance[slot] = measured.count;
      block.intensity[slot] = measured.intensity;
    }
  }
}

void Encoder::close() {
  if (!open_) return;
  RawPacket packet;
  packet.mode = open_->dual ? kModeDual : kModeStrongest;
  if (facts_.product) packet.product = *facts_.product;
  packet.stamp_us = static_cast<std::uint32_t>(open_->begin_ns % kHourNs / 1000);
  const std::vector<std::uint16_t> azimuths = azimuths_of(*open_);
  const std::size_t lower = lower_step(*open_);
  for (std::size_t step = 0; step < azimuths.size(); ++step) {
    fill_step(packet, step, open_->steps[step], azimuths[step], lower);
  }
  full_.push_back({to_bytes(packet), open_->begin_ns});
  open_.reset();
}

std::vector<SentPacket> Encoder::take() { return std::exchange(full_, {}); }

std::vector<SentPacket> Encoder::finish() {
  close();
  return take();
}

}  // namespace verge::sensor::velodyne
