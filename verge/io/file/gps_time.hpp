// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

namespace verge::io {

/// "Adjusted standard GPS time" as LAS files have it: seconds since 1980-01-06 less 1e9, without leap
/// seconds. None for times before 1980 or after 2100, and for what is not finite.
[[nodiscard]] std::optional<std::int64_t> unix_ns_of_adjusted_gps(double seconds);

/// The other way, for a time since 1980-01-06. Good to 0.12 us, which is what a double holds today.
[[nodiscard]] double adjusted_gps_of(std::int64_t unix_ns);

}  // namespace verge::io
