// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/io/file/gps_time.hpp"

#include <array>
#include <cmath>

namespace verge::io {
namespace {

constexpr std::int64_t kGpsEpochInUnix = 315'964'800;  // 1980-01-06
constexpr std::int64_t kAdjustment = 1'000'000'000;
constexpr std::int64_t kNs = 1'000'000'000;
constexpr std::int64_t kLatestGps = 3'786'825'600;  // 2100

/// Unix times at which a leap second had just been put in since 1980-01-06: from then on GPS is one second
/// more ahead of UTC (IERS Bulletin C; the last one was at the end of 2016).
constexpr auto kLeapSeconds = std::to_array<std::int64_t>(
    {362'793'600, 394'329'600, 425'865'600, 489'024'000, 567'993'600, 631'152'000, 662'688'000, 709'948'800,
     741'484'800, 773'020'800, 820'454'400, 867'715'200, 915'148'800, 1'136'073'600, 1'230'768'000,
     1'341'100'800, 1'435'708'800, 1'483'228'800});

/// GPS seconds since 1980-01-06 at a Unix second.
std::int64_t gps_of_unix(std::int64_t unix_s) {
  std::int64_t leaps = 0;
  for (const std::int64_t leap : kLeapSeconds) leaps += unix_s >= leap ? 1 : 0;
  return unix_s - kGpsEpochInUnix + leaps;
}

/// The Unix second of a GPS second; of a leap second itself, the one after it.
std::int64_t unix_of_gps(std::int64_t gps_s) {
  std::int64_t unix_s = gps_s + kGpsEpochInUnix;
  for (const std::int64_t leap : kLeapSeconds) unix_s -= gps_s >= gps_of_unix(leap) ? 1 : 0;
  return unix_s;
}

}  // namespace

std::optional<std::int64_t> unix_ns_of_adjusted_gps(double seconds) {
  constexpr auto kFirst = static_cast<double>(-kAdjustment);
  constexpr auto kLast = static_cast<double>(kLatestGps - kAdjustment);
  if (std::isnan(seconds) || seconds < kFirst || seconds > kLast) return std::nullopt;
  const double whole = std::floor(seconds);
  const std::int64_t unix_s = unix_of_gps(static_cast<std::int64_t>(whole) + kAdjustment);
  return unix_s * kNs + std::llround((seconds - whole) * 1e9);
}

double adjusted_gps_of(std::int64_t unix_ns) {
  const std::int64_t fraction = ((unix_ns % kNs) + kNs) % kNs;
  const std::int64_t gps_s = gps_of_unix((unix_ns - fraction) / kNs);
  return static_cast<double>(gps_s - kAdjustment) + static_cast<double>(fraction) * 1e-9;
}

}  // namespace verge::io
