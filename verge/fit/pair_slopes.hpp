// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "verge/core/vec.hpp"

namespace verge::fit {

/// The slopes (y_j - y_i) / (x_j - x_i) of all pairs of points, by their order of size. Pairs that are less
/// than `min_step_m` > 0 apart in x have none. Of few points all slopes are held. Of many, those around the
/// rank that is asked for are found by sweeping a slope past them: as it rises, two points change their order
/// along it just when it passes the slope of their pair (after Cole, Salowe, Steiger and Szemeredi 1989 and
/// Matousek 1991). It starts at a slope drawn by chance (always the same) that misses the rank by about a
/// sqrt(n)-th of all pairs: O(n^1.5) time with a small constant and O(n) memory, plus the number of pairs
/// without a slope. The order of the points plays no part. Coordinates must be finite.
class PairSlopes {
 public:
  /// Up to so many points all slopes are held: about where the sweep begins to be faster.
  static constexpr std::size_t kHeldPoints = 24;
  /// With more, the sweep ends where so many slopes a point are left, which are sorted.
  static constexpr std::size_t kCollectPerPoint = 2;

  PairSlopes(std::span<const Vec2> points, double min_step_m);

  /// How many pairs have a slope.
  [[nodiscard]] std::size_t size() const { return size_; }
  /// The slope at `position` (0 .. size() - 1) in ascending order, between two of them by linear
  /// interpolation; size() must not be 0. As from sorting all slopes; but where more than kCollectPerPoint n
  /// slopes lie within 1e-9 of each other, one of them.
  [[nodiscard]] double at(double position);
  /// The slope in the middle: the mean of the middle two where their number is even. None without slopes.
  [[nodiscard]] std::optional<double> median();
  /// The slopes of `count` pairs drawn by chance, with repetition; none where no pair has one.
  [[nodiscard]] std::vector<double> sample(std::size_t count, std::uint64_t seed) const;

 private:
  using Pair = std::pair<std::size_t, std::size_t>;
  /// A slope, and how many slopes are less.
  struct Bound {
    double slope = 0.0;
    std::size_t below = 0;
  };
  /// The slopes from `low` on and below `high`: those that are looked for, and others.
  struct Band {
    Bound low, high;
    [[nodiscard]] std::size_t inside() const { return high.below - low.below; }
  };
  /// The ranks that are looked for.
  struct Ranks {
    std::size_t first = 0;
    std::size_t last = 0;
  };
  struct Projected {
    double value = 0.0;  // y - slope x
    std::size_t index = 0;
    friend bool operator<(const Projected& a, const Projected& b) { return a.value < b.value; }
  };
  /// The points in their order along a slope.
  struct Sweep {
    Bound at;
    std::vector<Projected> order;
  };

  [[nodiscard]] bool has_slope(Pair pair) const;
  [[nodiscard]] double slope_of(Pair pair) const;
  [[nodiscard]] std::vector<double> all_slopes() const;
  [[nodiscard]] double projected(std::size_t i, double slope) const;
  [[nodiscard]] Sweep sweep_from(double slope) const;
  template <class Pass>
  void move(Sweep& sweep, double slope, Pass pass) const;
  void look_at(Sweep& sweep, Band& band, double probe, Ranks ranks) const;
  void start(Sweep& sweep, Band& band, Ranks ranks) const;
  void narrow(Sweep& sweep, Band& band, Ranks ranks) const;
  [[nodiscard]] std::vector<double> slopes_in(Sweep& sweep, const Band& band) const;

  double min_step_m_;
  std::vector<Vec2> points_;    // in ascending order of x, then y
  std::vector<Pair> too_near_;  // pairs without a slope, the first index the lower
  double middle_ = 0.0;         // of their extent in x
  std::size_t size_ = 0;
  std::vector<double> held_;  // all slopes, where they are few
};

}  // namespace verge::fit
