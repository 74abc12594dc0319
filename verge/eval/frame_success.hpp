// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "verge/core/fields.hpp"
#include "verge/eval/scene_match.hpp"

namespace verge::eval {

/// How good a scan's boundaries are as a whole (paper 3's "minimum deviation", "larger deviation", failure).
enum class Deviation : std::uint8_t { kMinimum, kLarger, kFailed };

}  // namespace verge::eval

namespace verge {
template <>
inline constexpr std::array enum_names<eval::Deviation> =
    std::to_array<std::string_view>({"minimum", "larger", "failed"});
}  // namespace verge

namespace verge::eval {

/// Minimum: at least 90 % of the visible truth within range_m is at most 0.2 m from a prediction, and no
/// predicted sample there is more than 0.5 m from the truth. Larger: the same with 0.5 m and 1 m. None where
/// no truth is visible.
[[nodiscard]] std::optional<Deviation> deviation_of(const SceneMatch& match, double range_m = 20.0);

/// Scans by their deviation; counts of several sets are added up.
struct SuccessCounts {
  std::size_t minimum = 0;
  std::size_t larger = 0;
  std::size_t failed = 0;

  void count(Deviation deviation);
  SuccessCounts& operator+=(const SuccessCounts& more);
  [[nodiscard]] std::size_t scans() const { return minimum + larger + failed; }
  [[nodiscard]] std::size_t successes() const { return minimum + larger; }
};

/// A share and the interval that holds the true one with 95 %.
struct ShareInterval {
  double share = 0.0;
  double low = 0.0;
  double high = 1.0;
};

/// Wilson's score interval (1927), z = 1.959964. None without a trial.
[[nodiscard]] std::optional<ShareInterval> wilson_interval(std::size_t successes, std::size_t trials);

}  // namespace verge::eval
