// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/sensor/ibeo/ntp.hpp"

#include <cassert>

namespace verge::sensor::ibeo {
namespace {

constexpr std::uint64_t kUnixEpochInNtp = 2'208'988'800;  // seconds from 1900-01-01 to 1970-01-01
constexpr std::uint64_t kNs = 1'000'000'000;

}  // namespace

std::optional<std::int64_t> unix_ns_of(std::uint64_t ntp) {
  const std::uint64_t seconds = ntp >> 32U;
  if (seconds < kUnixEpochInNtp) return std::nullopt;
  const std::uint64_t ns = ((ntp & 0xFFFF'FFFFU) * kNs + (1ULL << 31U)) >> 32U;
  return static_cast<std::int64_t>((seconds - kUnixEpochInNtp) * kNs + ns);
}

std::uint64_t ntp_of(std::int64_t unix_ns) {
  assert(unix_ns >= 0);
  const auto ns = static_cast<std::uint64_t>(unix_ns);
  const std::uint64_t seconds = ns / kNs + kUnixEpochInNtp;
  assert(seconds >> 32U == 0);
  return (seconds << 32U) + (((ns % kNs) << 32U) + kNs / 2) / kNs;
}

double seconds_between(std::uint64_t begin, std::uint64_t end) {
  constexpr double kTick = 1.0 / 4'294'967'296.0;
  return static_cast<double>(end - begin) * kTick;
}

}  // namespace verge::sensor::ibeo
