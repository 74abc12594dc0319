// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "verge/model/scene.hpp"

namespace verge::eval {

/// How junctions were told apart; those of several scans are added up.
struct JunctionScore {
  static constexpr std::size_t kTypes = enum_names<JunctionType>.size();
  static constexpr std::size_t kNone = kTypes;  ///< No junction: a road that goes on.

  /// Scans by true type (first index) and predicted type.
  std::array<std::array<std::size_t, kTypes + 1>, kTypes + 1> confusion{};
  std::size_t with_both = 0;             ///< Scans in which both have a junction.
  std::size_t right_branch_count = 0;    ///< Of those.
  std::vector<double> branch_error_rad;  ///< Of matched branches, sizes.
  std::vector<double> center_error_m;
  /// By distance of the true junction's center, bins of 5 m: scans, and those with the right type.
  std::vector<std::size_t> seen;
  std::vector<std::size_t> right;

  JunctionScore& operator+=(const JunctionScore& more);

  [[nodiscard]] std::optional<double> type_accuracy() const;
  /// Mean over the types (none included) that occur in the truth or the prediction of 2 TP / (2 TP + FP +
  /// FN).
  [[nodiscard]] std::optional<double> macro_f1() const;
  [[nodiscard]] std::optional<double> branch_count_accuracy() const;
  /// Outer edge of the last bin before which no bin has less than `least` of its types right; none without a
  /// junction.
  [[nodiscard]] std::optional<double> detection_distance_m(double least = 0.9) const;
};

inline constexpr double kJunctionBin_m = 5.0;

/// One scan: the true junction nearest to the sensor, and the predicted one nearest to that; without a true
/// one the predicted one of the greatest confidence. Branches are matched one to one, the nearest angles
/// first.
[[nodiscard]] JunctionScore score_junction(const Scene& prediction, const Scene& truth);

}  // namespace verge::eval
