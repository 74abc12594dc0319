// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "verge/eval/tolerance_score.hpp"

namespace verge::eval {

/// What becomes of a method as a condition gets worse: counts at each value of the condition. Scans at the
/// same value are added up, so that parts of a study may come in any order.
class DegradationCurve {
 public:
  DegradationCurve(std::string condition, std::string unit)
      : condition_(std::move(condition)), unit_(std::move(unit)) {}

  void add(double value, const ToleranceCounts& counts) { at_[value] += counts; }
  /// Both must be of one condition.
  DegradationCurve& operator+=(const DegradationCurve& more);

  struct Point {
    double value = 0.0;
    ToleranceCounts counts;
    /// By how much F1 is below that at the first value; none where either has none.
    std::optional<double> f1_loss;
  };
  /// In order of the condition's value.
  [[nodiscard]] std::vector<Point> points() const;

  [[nodiscard]] const std::string& condition() const { return condition_; }
  [[nodiscard]] const std::string& unit() const { return unit_; }

 private:
  std::string condition_;  ///< As "range noise".
  std::string unit_;
  std::map<double, ToleranceCounts> at_;
};

}  // namespace verge::eval
