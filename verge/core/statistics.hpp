// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <vector>

namespace verge {

/// The value at `position` (0 .. n - 1) of the n values in ascending order v_0 .. v_{n-1}; between two of
/// them by linear interpolation. The values must be finite, and at least one; they are reordered. O(n).
[[nodiscard]] double value_at_rank(std::vector<double>& values, double position);

/// The `percent` percentile (0..100) by linear interpolation between order statistics: with the n values in
/// ascending order v_0..v_{n-1}, the value at position (n - 1) percent / 100 (Hyndman and Fan 1996, type 7;
/// the default of R and numpy). Values must be finite. No value: none. O(n).
[[nodiscard]] std::optional<double> percentile(std::span<const double> values, double percent);

/// The 50th percentile: of an even number of values the mean of the middle two. No value: none.
[[nodiscard]] std::optional<double> median(std::span<const double> values);

/// The arithmetic mean, summed in the order given. No value: none.
[[nodiscard]] std::optional<double> mean(std::span<const double> values);

}  // namespace verge
