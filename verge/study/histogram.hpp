// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <utility>

namespace verge::study {

/// Values counted in steps: thousands of scans add up in little room, and in any order to the same bytes.
/// What is said of them is right to half a step.
class Histogram {
 public:
  using Bins = std::map<std::int64_t, std::uint64_t>;  ///< Counts by value / step.

  Histogram() = default;
  /// `step` is positive.
  explicit Histogram(double step, Bins bins = {}) : step_(step), bins_(std::move(bins)) {}

  /// A finite value.
  void add(double value);
  /// Both must have one step.
  Histogram& operator+=(const Histogram& more);
  friend bool operator==(const Histogram&, const Histogram&) = default;

  /// The same without signs.
  [[nodiscard]] Histogram sizes() const;

  [[nodiscard]] std::uint64_t count() const;
  [[nodiscard]] std::optional<double> mean() const;  ///< None of nothing, as all below.
  [[nodiscard]] std::optional<double> root_mean_square() const;
  /// As verge::percentile() has it of the rounded values.
  [[nodiscard]] std::optional<double> percentile(double percent) const;

  [[nodiscard]] double step() const { return step_; }
  [[nodiscard]] const Bins& bins() const { return bins_; }

 private:
  [[nodiscard]] double value_at(std::uint64_t rank) const;

  double step_ = 0.001;
  Bins bins_;
};

}  // namespace verge::study
