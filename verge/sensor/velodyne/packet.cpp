// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/sensor/velodyne/packet.hpp"

#include <cmath>
#include <cstring>

namespace verge::sensor::velodyne {
namespace {

constexpr std::size_t kBlockBytes = 100;
constexpr std::size_t kStampAt = 1200;
constexpr std::size_t kModeAt = 1204;
constexpr std::size_t kProductAt = 1205;

std::uint16_t flag_at(Bytes payload, std::size_t block) {
  return load_le<std::uint16_t>(payload, block * kBlockBytes);
}
std::uint16_t azimuth_at(Bytes payload, std::size_t block) {
  return load_le<std::uint16_t>(payload, block * kBlockBytes + 2);
}
std::uint8_t byte_at(Bytes payload, std::size_t offset) { return static_cast<std::uint8_t>(payload[offset]); }

template <class T>
void store_le(DataBytes& out, std::size_t offset, T value) {
  std::memcpy(out.data() + offset, &value, sizeof(T));
}

/// An HDL-64E does not say that it sends two echoes: the pair of banks comes twice with one azimuth.
bool banks_repeat(Bytes payload) {
  for (std::size_t block = 0; block < kBlocksPerPacket; block += 4) {
    if (azimuth_at(payload, block) != azimuth_at(payload, block + 2)) return false;
  }
  return true;
}

bool is_dual(Bytes payload, const Facts& facts) {
  if (facts.banks == 1) return byte_at(payload, kModeAt) == kModeDual;
  return facts.banks_share_step && banks_repeat(payload);
}

std::optional<std::uint8_t> bank_of(std::uint16_t flag, const Facts& facts) {
  if (flag == kUpperBank) return std::uint8_t{0};
  if (flag == kLowerBank && facts.banks == 2) return std::uint8_t{1};
  return std::nullopt;
}

void place_block(PlannedBlock& planned, Bytes payload, std::size_t block, const Facts& facts,
                 PacketPlan& plan) {
  const std::size_t banks = facts.banks_share_step ? 2 : 1;
  const std::size_t echoes = plan.dual ? 2 : 1;
  planned.azimuth = azimuth_at(payload, block);
  planned.step = static_cast<std::uint8_t>(block / (banks * echoes));
  planned.echo = static_cast<std::uint8_t>(block / banks % echoes);
  const auto bank = bank_of(flag_at(payload, block), facts);
  if (!bank) {
    ++plan.rejected_flag;
  } else if (planned.azimuth >= kTurn) {
    ++plan.rejected_azimuth;
  } else {
    planned.bank = *bank;
    planned.usable = true;
  }
}

constexpr double kSlowest = 1.0 * kTurn * 1e-9;
constexpr double kFastest = 40.0 * kTurn * 1e-9;

int turned(const PlannedBlock& from, const PlannedBlock& to) {
  return (kTurn + to.azimuth - from.azimuth) % kTurn;
}

double turn_per_ns_between(const PlannedBlock& from, const PlannedBlock& to, const Facts& facts) {
  return static_cast<double>(turned(from, to)) / static_cast<double>((to.step - from.step) * facts.step_ns);
}

/// The first usable block of the step after that of `block`; none at the end.
const PlannedBlock* next_step(const PacketPlan& plan, std::size_t block) {
  for (std::size_t next = block + 1; next < kBlocksPerPacket; ++next) {
    const PlannedBlock& to = plan.blocks[next];
    if (to.usable && to.step != plan.blocks[block].step) return &to;
  }
  return nullptr;
}

/// Turn from `block` to the next usable step; none where there is none or it is not that of a motor.
std::optional<double> turn_after(const PacketPlan& plan, std::size_t block, const Facts& facts) {
  const PlannedBlock* const next = next_step(plan, block);
  if (next == nullptr) return std::nullopt;
  const double turn_per_ns = turn_per_ns_between(plan.blocks[block], *next, facts);
  if (turn_per_ns < kSlowest || turn_per_ns > kFastest) return std::nullopt;
  return turn_per_ns;
}

/// Whether the azimuth leaps from `from` to `block` and goes on from there, rather than coming back.
bool leaps(const PacketPlan& plan, const PlannedBlock& from, std::size_t block, const Facts& facts) {
  const PlannedBlock* const next = next_step(plan, block);
  return next != nullptr && turn_per_ns_between(from, plan.blocks[block], facts) > kFastest &&
         turn_per_ns_between(from, *next, facts) > kFastest && turn_after(plan, block, facts);
}

/// Moves the steps after a leap to when the head had turned that far.
void find_pauses(PacketPlan& plan, const Facts& facts, double mean_turn_per_ns) {
  const PlannedBlock* from = nullptr;
  std::int64_t pause_ns = 0;
  for (std::size_t b = 0; b < kBlocksPerPacket; ++b) {
    PlannedBlock& block = plan.blocks[b];
    if (!block.usable) continue;
    const bool new_step = from != nullptr && from->step != block.step;
    if (new_step && from->turn_per_ns > 0.0 && leaps(plan, *from, b, facts)) {
      const double took_ns =
          turned(*from, block) / (mean_turn_per_ns > 0.0 ? mean_turn_per_ns : from->turn_per_ns);
      pause_ns += std::llround(took_ns) - std::int64_t{block.step - from->step} * facts.step_ns;
      from = &block;
    }
    block.pause_ns = pause_ns;
    if (from == nullptr || turn_per_ns_between(*from, block, facts) <= kFastest) from = &block;
  }
}

}  // namespace

RawPacket parse_packet(Bytes payload) {
  RawPacket packet;
  for (std::size_t b = 0; b < kBlocksPerPacket; ++b) {
    RawBlock& block = packet.blocks[b];
    block.flag = flag_at(payload, b);
    block.azimuth = azimuth_at(payload, b);
    for (std::size_t slot = 0; slot < kSlotsPerBlock; ++slot) {
      const std::size_t at = b * kBlockBytes + 4 + 3 * slot;
      block.distance[slot] = load_le<std::uint16_t>(payload, at);
      block.intensity[slot] = byte_at(payload, at + 2);
    }
  }
  packet.stamp_us = load_le<std::uint32_t>(payload, kStampAt);
  packet.mode = byte_at(payload, kModeAt);
  packet.product = byte_at(payload, kProductAt);
  return packet;
}

DataBytes to_bytes(const RawPacket& packet) {
  DataBytes out{};
  for (std::size_t b = 0; b < kBlocksPerPacket; ++b) {
    const RawBlock& block = packet.blocks[b];
    store_le(out, b * kBlockBytes, block.flag);
    store_le(out, b * kBlockBytes + 2, block.azimuth);
    for (std::size_t slot = 0; slot < kSlotsPerBlock; ++slot) {
      const std::size_t at = b * kBlockBytes + 4 + 3 * slot;
      store_le(out, at, block.distance[slot]);
      store_le(out, at + 2, block.intensity[slot]);
    }
  }
  store_le(out, kStampAt, packet.stamp_us);
  store_le(out, kModeAt, packet.mode);
  store_le(out, kProductAt, packet.product);
  return out;
}

PacketPlan plan_packet(Bytes payload, const Facts& facts, double turn_per_ns, double mean_turn_per_ns) {
  PacketPlan plan;
  plan.dual = is_dual(payload, facts);
  plan.steps = steps_of(payload, facts);
  for (std::size_t b = 0; b < kBlocksPerPacket; ++b) place_block(plan.blocks[b], payload, b, facts, plan);
  for (std::size_t b = 0; b < kBlocksPerPacket; ++b) {
    if (!plan.blocks[b].usable) continue;
    turn_per_ns = turn_after(plan, b, facts).value_or(turn_per_ns);
    plan.blocks[b].turn_per_ns = turn_per_ns;
  }
  find_pauses(plan, facts, mean_turn_per_ns);
  return plan;
}

std::size_t steps_of(Bytes payload, const Facts& facts) {
  return kBlocksPerPacket / (facts.banks_share_step ? 2U : 1U) / (is_dual(payload, facts) ? 2U : 1U);
}

std::optional<Model> model_of(Bytes payload) {
  constexpr std::uint8_t kAlphaPrime = 0xA1;  // has lower banks too, but four of them
  std::size_t lower = 0;
  for (std::size_t b = 0; b < kBlocksPerPacket; ++b) lower += flag_at(payload, b) == kLowerBank ? 1U : 0U;
  const std::uint8_t mode = byte_at(payload, kModeAt);
  const std::uint8_t product = byte_at(payload, kProductAt);
  if (lower >= 3 && product != kAlphaPrime) return lower >= 5 ? Model::kHdl64eS2 : Model::kHdl64eS1;
  if (mode == 0 && product == 0) return Model::kHdl32e;
  for (const Model model : {Model::kHdl32e, Model::kVlp16, Model::kVlp32c}) {
    if (facts_of(model).product == product) return model;
  }
  return std::nullopt;
}

bool fits(Bytes payload, const Facts& facts) {
  const auto model = model_of(payload);
  if (!model) return !facts.product;  // an HDL-64E whose blocks lost their flags
  if (facts.banks == 2) return facts_of(*model).banks == 2;
  return model == facts.model || (byte_at(payload, kModeAt) == 0 && byte_at(payload, kProductAt) == 0);
}

}  // namespace verge::sensor::velodyne
