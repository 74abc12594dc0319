// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "verge/model/scene.hpp"

namespace verge::eval {

/// How the stations ahead are laid out (the protocol of CurbScan, Baek et al. 2020).
struct StationConfig {
  double range_m = 20.0;  ///< Stations x = 0, step, ... below it.
  double step_m = 0.2;
  double tolerance_m = 0.3;
};

/// What a station came to, or several together; the left and the right boundary are one count each.
struct StationCounts {
  std::size_t both_absent = 0;
  std::size_t missed = 0;    ///< Only the truth has a boundary there.
  std::size_t extra = 0;     ///< Only the prediction has.
  std::size_t right = 0;     ///< Both have, less than the tolerance apart.
  std::size_t wrong = 0;     ///< Both have, farther apart.
  double error_sum_m = 0.0;  ///< Of |difference| where both have.

  StationCounts& operator+=(const StationCounts& more);
  friend bool operator==(const StationCounts&, const StationCounts&) = default;

  /// Strict: what is predicted where the truth has nothing is wrong.
  [[nodiscard]] std::optional<double> precision() const;
  /// Inside the truth's interval: such stations are left out.
  [[nodiscard]] std::optional<double> precision_inside() const;
  [[nodiscard]] std::optional<double> recall() const;
  [[nodiscard]] std::optional<double> mean_error_m() const;
};

/// Lateral position y of the boundaries of a side at x, by interpolation between their points; the one
/// nearest to the vehicle's path where several pass. None where none passes.
[[nodiscard]] std::optional<double> lateral_at(const Scene& scene, Side side, double x);

/// One count a station.
[[nodiscard]] std::vector<StationCounts> count_stations(const Scene& prediction, const Scene& truth,
                                                        const StationConfig& config = {});
/// Adds scans; `sum` is empty or of the same layout.
void add_stations(std::vector<StationCounts>& sum, const std::vector<StationCounts>& more);
/// All stations together.
[[nodiscard]] StationCounts pooled(const std::vector<StationCounts>& stations);

}  // namespace verge::eval
