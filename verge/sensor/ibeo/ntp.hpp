// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

namespace verge::sensor::ibeo {

/// The time that an ibeo message tells, in nanoseconds since the Unix epoch. `ntp` has seconds since
/// 1900-01-01 in its high word and 2^-32 s in its low word. None before 1970: a sensor that nobody has told
/// the time counts from 1900 when it is powered. Rounded to the nearest nanosecond. Good until 2036-02-07,
/// when the seconds begin again at 0.
[[nodiscard]] std::optional<std::int64_t> unix_ns_of(std::uint64_t ntp);

/// The NTP time nearest to a time from 1970 to 2036; unix_ns_of() gives back the same nanosecond.
[[nodiscard]] std::uint64_t ntp_of(std::int64_t unix_ns);

/// Seconds from `begin` to `end`, which is not earlier; whatever the epoch.
[[nodiscard]] double seconds_between(std::uint64_t begin, std::uint64_t end);

}  // namespace verge::sensor::ibeo
