// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/sensor/ibeo/health2030.hpp"

#include <span>
#include <utility>

#include "verge/core/byte_writer.hpp"
#include "verge/sensor/ibeo/damaged.hpp"

namespace verge::sensor::ibeo {
namespace {

constexpr std::size_t kBodyBytes = 16;
constexpr unsigned kTooWarmOrCold = 0x0300;

struct Bit {
  unsigned mask = 0;
  std::string_view meaning;
};

constexpr std::array kError1 = std::to_array<Bit>({{0x0001, "internal error"},
                                                   {0x0002, "motor error"},
                                                   {0x0004, "scan buffer incomplete"},
                                                   {0x0008, "scan buffer overflow"},
                                                   {0x3C00, "motor error"}});
constexpr std::array kError2 = std::to_array<Bit>({{0x0001, "no scan data"},
                                                   {0x0002, "internal communication error"},
                                                   {0x0004, "wrong scan data"},
                                                   {0x0008, "FPGA error"},
                                                   {0x0010, "wrong configuration"},
                                                   {0x0020, "wrong configuration parameters"},
                                                   {0x0040, "processing timeout"}});
constexpr std::array kWarning1 = std::to_array<Bit>({{0x0001, "warning: internal communication"},
                                                     {0x0008, "warning: low temperature"},
                                                     {0x0010, "warning: high temperature"},
                                                     {0x0080, "warning: synchronisation"}});
constexpr std::array kWarning2 = std::to_array<Bit>({{0x0001, "warning: CAN blocked"},
                                                     {0x0002, "warning: Ethernet blocked"},
                                                     {0x0004, "warning: wrong CAN data"},
                                                     {0x0010, "warning: unknown Ethernet data"},
                                                     {0x0020, "warning: forbidden Ethernet command"},
                                                     {0x0040, "warning: memory access"}});

void add(std::vector<std::string_view>& out, unsigned value, std::span<const Bit> bits) {
  for (const Bit& bit : bits) {
    if ((value & bit.mask) != 0) out.push_back(bit.meaning);
  }
}

}  // namespace

Expected<LuxHealth> decode_health(Bytes body, std::uint64_t at) {
  if (body.size() != kBodyBytes) {
    return damaged(at, "size of errors and warnings is wrong", fmt::format("{} B", body.size()), "16 B");
  }
  LuxHealth health{.error_1 = load_le<std::uint16_t>(body, 0),
                   .error_2 = load_le<std::uint16_t>(body, 2),
                   .warning_1 = load_le<std::uint16_t>(body, 4),
                   .warning_2 = load_le<std::uint16_t>(body, 6)};
  for (std::size_t i = 0; i < health.reserved.size(); ++i) {
    health.reserved[i] = load_le<std::uint16_t>(body, 8 + 2 * i);
  }
  return health;
}

std::vector<std::byte> encode_health(const LuxHealth& health) {
  ByteWriter out;
  out.le(health.error_1).le(health.error_2).le(health.warning_1).le(health.warning_2);
  for (const std::uint16_t value : health.reserved) out.le(value);
  return std::move(out).take();
}

std::vector<std::string_view> troubles_of(const LuxHealth& health) {
  std::vector<std::string_view> out;
  add(out, health.error_1, kError1);
  const unsigned temperature = health.error_1 & kTooWarmOrCold;
  if (temperature == kTooWarmOrCold) out.emplace_back("temperature sensor defective");
  if (temperature != 0 && temperature != kTooWarmOrCold) out.emplace_back("receiver too warm or too cold");
  add(out, health.error_2, kError2);
  add(out, health.warning_1, kWarning1);
  add(out, health.warning_2, kWarning2);
  return out;
}

}  // namespace verge::sensor::ibeo
