// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/sensor/velodyne/revolutions.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "verge/core/angle.hpp"

namespace verge::sensor::velodyne {
namespace {

constexpr std::int64_t kLongestRevolutionNs = 1'250'000'000;
constexpr std::size_t kStampAt = 1200;
/// 2006-01-01: no sensor of these was there to hear an earlier date.
constexpr std::int64_t kFirstSensorNs = 1'136'073'600'000'000'000;

std::int32_t cut_of(double azimuth_rad) {
  if (!std::isfinite(azimuth_rad)) throw std::invalid_argument("the azimuth of the cut must be finite");
  const double turns = azimuth_rad / (2.0 * std::numbers::pi);
  return static_cast<std::int32_t>(std::llround((turns - std::floor(turns)) * kTurn)) % kTurn;
}

std::int64_t last_shot_ns(const Facts& facts, std::size_t steps) {
  const auto last = *std::max_element(facts.slot_time_ns.begin(), facts.slot_time_ns.end());
  return static_cast<std::int64_t>(steps - 1) * facts.step_ns + last;
}

/// Times from the cloud's earliest point on: with two banks it need not be the first.
double count_from_first(Cloud& cloud) {
  const std::size_t first_steps = std::min<std::size_t>(cloud.time_s.size(), 4 * kSlotsPerBlock);
  const auto end = cloud.time_s.begin() + static_cast<std::ptrdiff_t>(first_steps);
  const double first_s = *std::min_element(cloud.time_s.begin(), end);
  if (first_s == 0.0) return 0.0;
  for (double& time_s : cloud.time_s) time_s -= first_s;
  return first_s;
}

void reserve(Cloud& cloud, std::size_t points) {
  cloud.x.reserve(points);
  cloud.y.reserve(points);
  cloud.z.reserve(points);
  cloud.intensity.reserve(points);
  cloud.ring.reserve(points);
  cloud.time_s.reserve(points);
}

/// Times far from any calendar would overflow when counted on.
std::int64_t sane(std::int64_t received_ns) {
  return std::clamp<std::int64_t>(received_ns, 0, 4'000'000'000'000'000'000);
}

}  // namespace

RevolutionDecoder::RevolutionDecoder(DecoderConfig config)
    : config_(std::move(config)), tracker_(cut_of(config_.cut_azimuth_rad)) {
  const bool finite =
      std::isfinite(config_.range_min_m.value_or(0.0)) && std::isfinite(config_.range_max_m.value_or(0.0));
  if (!finite) throw std::invalid_argument("the ranges must be finite");
  if (!config_.model) return;
  if (config_.calibration && config_.calibration->size() != facts_of(*config_.model).lasers) {
    throw std::invalid_argument("the calibration does not have the lasers of the model");
  }
  set_model(*config_.model);
}

void RevolutionDecoder::set_model(Model model) {
  model_ = model;
  facts_ = &facts_of(model);
  const bool own = config_.calibration && config_.calibration->size() == facts_->lasers;
  projector_ = std::make_unique<Projector>(*facts_, own ? *config_.calibration : facts_->calibration,
                                           config_.range_min_m.value_or(facts_->range_min_m),
                                           config_.range_max_m.value_or(facts_->range_max_m));
}

void RevolutionDecoder::add(Bytes payload, std::int64_t received_ns) {
  ++counters_.packets;
  if (payload.size() == kDataBytes) {
    add_data(payload, sane(received_ns));
  } else if (payload.size() == kPositionBytes) {
    add_position(payload, sane(received_ns));
  } else {
    ++counters_.rejected_size;
  }
}

void RevolutionDecoder::add_position(Bytes payload, std::int64_t received_ns) {
  ++counters_.positions;
  position_ = parse_position(payload);
  const NmeaReading& nmea = position_->nmea;
  const bool rolled_over = nmea.fault == NmeaFault::kNone && week_rolled_over(nmea.utc_ns, received_ns);
  if (nmea.fault == NmeaFault::kNoSentence) {
    ++counters_.nmea_absent;
  } else if (rolled_over) {
    ++counters_.nmea_rolled_over;
  } else if (nmea.fault != NmeaFault::kNone || nmea.utc_ns < kFirstSensorNs) {
    ++counters_.nmea_ignored;
  } else if (!nmea.locked) {
    ++counters_.nmea_unlocked;
  } else {
    ++counters_.nmea_used;
    clock_.set_reference(nmea.utc_ns, received_ns);
    if (clock_.hour_disputed()) ++counters_.hour_disputed;
  }
}

bool RevolutionDecoder::accept_model(Bytes payload) {
  if (!model_) {
    const auto model = model_of(payload);
    if (model) set_model(*model);
    return model.has_value();
  }
  return fits(payload, *facts_);
}

void RevolutionDecoder::add_data(Bytes payload, std::int64_t received_ns) {
  if (!accept_model(payload)) {
    ++counters_.rejected_model;
    return;
  }
  if (queue_.seen(payload)) {
    ++counters_.duplicates;
    return;
  }
  if (!queue_.push(time_of(payload, received_ns), payload)) {
    ++counters_.late;
    return;
  }
  ++counters_.data;
  while (const auto* const packet = queue_.pop()) decode(*packet);
}

/// Time of the packet's first firing.
std::int64_t RevolutionDecoder::time_of(Bytes payload, std::int64_t received_ns) {
  const std::size_t steps = steps_of(payload, *facts_);
  const std::int64_t packet_ns = static_cast<std::int64_t>(steps) * facts_->step_ns;
  const StampClock::Reading reading =
      facts_->has_clock ? clock_.read(load_le<std::uint32_t>(payload, kStampAt), received_ns, packet_ns)
                        : clock_.read_received(received_ns, packet_ns);
  ++counters_.stamps;
  if (reading.estimated) ++counters_.stamps_estimated;
  if (reading.ambiguous) ++counters_.hour_ambiguous;
  if (reading.jumped) {
    ++counters_.clock_jumps;
    drain();
    queue_.restart();
    tracker_.restart();
  }
  const bool marks_last = config_.stamp == StampMark::kLast && facts_->has_clock;
  return reading.time_ns - (marks_last ? last_shot_ns(*facts_, steps) : 0);
}

void RevolutionDecoder::drain() {
  while (const auto* const packet = queue_.drain()) decode(*packet);
}

void RevolutionDecoder::decode(const PacketQueue::Packet& packet) {
  const PacketPlan plan = plan_packet(packet.bytes, *facts_, turn_per_ns_, mean_turn_per_ns_);
  counters_.blocks += kBlocksPerPacket;
  counters_.rejected_flag += plan.rejected_flag;
  counters_.rejected_azimuth += plan.rejected_azimuth;
  for (std::size_t first = 0; first < kBlocksPerPacket;) {
    std::size_t end = first + 1;
    while (end < kBlocksPerPacket && plan.blocks[end].step == plan.blocks[first].step) ++end;
    decode_step(packet, plan, first, end);
    first = end;
  }
  move_points(batch_, current_.cloud, echoes_);
}

/// The blocks [first, end) of a packet, which were measured together.
void RevolutionDecoder::decode_step(const PacketQueue::Packet& packet, const PacketPlan& plan,
                                    std::size_t first, std::size_t end) {
  const auto* const begin = plan.blocks.data() + first;
  const auto* const usable =
      std::find_if(begin, plan.blocks.data() + end, [](const PlannedBlock& b) { return b.usable; });
  if (usable == plan.blocks.data() + end) return;
  const std::int64_t time_ns =
      packet.time_ns + static_cast<std::int64_t>(begin->step) * facts_->step_ns + usable->pause_ns;
  const bool followed = follow(*usable, time_ns);
  if (plan.dual && !echoes_) {  // where the sensor switched to two echoes, the points before have one
    move_points(batch_, current_.cloud, false);
    current_.cloud.echo.resize(current_.cloud.x.size(), 0);
    echoes_ = true;
  }
  const double time_s = 1e-9 * static_cast<double>(time_ns - current_begin_ns_);
  const std::size_t apart = facts_->banks_share_step ? 2 : 1;  // from a block to the one with its other echo
  for (std::size_t b = first; b < end; ++b) {
    const PlannedBlock& block = plan.blocks[b];
    if (!block.usable) continue;
    if (!followed) {
      ++counters_.rejected_turn;
      continue;
    }
    ++counters_.blocks_used;
    const std::size_t other = block.echo == 0 ? b + apart : b - apart;
    const bool paired = plan.dual && plan.blocks[other].usable;
    projector_->add(packet.bytes, b, block, time_s, paired ? &other : nullptr, batch_, counters_.points);
  }
}

/// Moves on to the azimuth of a step: ends the revolution where it passes the cut. False: no motor turns so.
bool RevolutionDecoder::follow(const PlannedBlock& block, std::int64_t time_ns) {
  using Move = TurnTracker::Move;
  const Move move = tracker_.step(block.azimuth, time_ns, turn_per_ns_);
  if (move == Move::kImplausible) return false;
  const bool stalled = current_begun_ && time_ns - current_begin_ns_ > kLongestRevolutionNs;
  if (move != Move::kSameRevolution || stalled) {
    end_revolution(stalled && move == Move::kSameRevolution);
    begin_revolution(time_ns);
  }
  turn_per_ns_ = block.turn_per_ns;
  constexpr double kFollow = 1.0 / 64.0;
  mean_turn_per_ns_ += (mean_turn_per_ns_ > 0.0 ? kFollow : 1.0) * (turn_per_ns_ - mean_turn_per_ns_);
  const double share = turn_per_ns_ * static_cast<double>(facts_->step_ns) / kTurn;
  current_.completeness = std::min(1.0, current_.completeness + share);
  return true;
}

void RevolutionDecoder::begin_revolution(std::int64_t time_ns) {
  current_ = {};
  reserve(current_.cloud, points_before_ + points_before_ / 16);
  echoes_ = false;
  current_begin_ns_ = time_ns;
  current_begun_ = true;
}

void RevolutionDecoder::end_revolution(bool stalled) {
  move_points(batch_, current_.cloud, echoes_);
  if (!current_begun_) return;
  current_begun_ = false;
  points_before_ = current_.cloud.x.size();
  if (points_before_ != 0) {
    const double first_s = count_from_first(current_.cloud);
    current_.stamp_ns = current_begin_ns_ + std::llround(1e9 * first_s);
  }
  current_.stalled = stalled;
  if (stalled) ++counters_.stalled;
  finished_.push_back(std::move(current_));
  current_ = {};
}

std::optional<Revolution> RevolutionDecoder::take() {
  if (finished_.empty()) return std::nullopt;
  Revolution oldest = std::move(finished_.front());
  finished_.pop_front();
  return oldest;
}

std::optional<Revolution> RevolutionDecoder::finish() {
  if (facts_ != nullptr) drain();
  end_revolution(false);
  return take();
}

}  // namespace verge::sensor::velodyne
