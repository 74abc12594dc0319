// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace verge::fit {

/// Count, mean and scatter of a class of samples, one sample after the other. Moments of parts add up to
/// those of the whole but for rounding.
class Moments {
 public:
  explicit Moments(std::size_t dimensions);

  /// A sample: finite, one number a dimension.
  void add(std::span<const double> sample);
  /// Both must have as many dimensions.
  Moments& operator+=(const Moments& more);

  [[nodiscard]] std::size_t dimensions() const { return mean_.size(); }
  [[nodiscard]] std::size_t count() const { return count_; }
  [[nodiscard]] std::span<const double> mean() const { return mean_; }
  /// Sum of (x - mean)(x - mean)^T, row by row.
  [[nodiscard]] std::span<const double> scatter() const { return scatter_; }

 private:
  std::size_t count_ = 0;
  std::vector<double> mean_;
  std::vector<double> scatter_;
};

/// A sample x is of the first class where weights . x > threshold.
struct Discriminant {
  std::vector<double> weights;  ///< One a dimension, in units of 1 / its unit.
  double threshold = 0.0;
};

/// Linear discriminant of Fisher: w = S_W^-1 (mu_1 - mu_0), S_W pooled over both classes, and the threshold
/// between two Gaussians of that covariance, w^T (mu_1 + mu_0) / 2 + ln(n_0 / n_1) with the classes' counts.
///
/// `shrinkage` (lambda, 0 or more) times the mean variance is added to S_W's diagonal after each dimension is
/// divided by its own deviation, so that units do not matter. A dimension that is the same in all samples of
/// each class weighs nothing. Degenerate: fewer than 2 samples in a class, no dimension that spreads, or
/// dimensions that depend on each other where nothing is added, give none.
[[nodiscard]] std::optional<Discriminant> fit_discriminant(const Moments& first, const Moments& other,
                                                           double shrinkage);

}  // namespace verge::fit
