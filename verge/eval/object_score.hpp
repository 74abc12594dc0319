// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "verge/model/scene.hpp"

namespace verge::eval {

/// How the boxes of some true objects were found.
struct BoxScore {
  std::size_t truth = 0;
  std::vector<double> heading_error_rad;  ///< Of pairs, sizes in 0..pi/2: front and back are not told apart.
  std::vector<double> overlap;            ///< Of pairs: intersection over union.

  BoxScore& operator+=(const BoxScore& more);

  /// Share of the true objects whose box was found with an intersection over union of `least` or more.
  [[nodiscard]] std::optional<double> share_above(double least) const;
};

/// How objects were found; those of several scans are added up.
struct ObjectScore {
  static constexpr std::size_t kClasses = enum_names<ObjectClass>.size();

  std::size_t predicted = 0;
  std::size_t truth = 0;
  std::size_t matched = 0;          ///< Pairs that are near enough to each other.
  std::size_t over_segmented = 0;   ///< True objects that hold at least half of two predictions or more.
  std::size_t under_segmented = 0;  ///< Predictions that hold at least half of two true objects or more.
  std::vector<double> heading_error_rad;  ///< Of pairs of boxes, as BoxScore's.
  std::vector<double> corner_error_m;     ///< Of pairs of boxes: mean distance of the footprints' corners.
  std::vector<double> overlap;            ///< Of pairs of boxes: intersection over union.
  BoxScore cars;                          ///< True cars alone ...
  BoxScore two_faced_cars;                ///< ... and those of which two faces are seen (shape J or L).
  /// By class: predicted, true, and pairs of the same class.
  std::array<std::size_t, kClasses> class_predicted{};
  std::array<std::size_t, kClasses> class_truth{};
  std::array<std::size_t, kClasses> class_matched{};

  ObjectScore& operator+=(const ObjectScore& more);

  [[nodiscard]] std::optional<double> precision() const;
  [[nodiscard]] std::optional<double> recall() const;
  [[nodiscard]] std::optional<double> class_f1(ObjectClass type) const;
};

/// Objects whose centers lie within range_m. Pairs are made one to one, the nearest first: boxes by overlap
/// seen from above, down to an intersection over union of `least_overlap`; a true object that is less than a
/// metre long and wide (a person, a pole), of which a scanner sees a few returns and no box, by the distance
/// of the centers, up to (1 - least_overlap) m. A true object of confidence 0 was not seen, by anyone: it is
/// no miss, and the prediction that is paired with it, or with a true object beyond the range, does not
/// count.
[[nodiscard]] ObjectScore score_objects(const Scene& prediction, const Scene& truth, double range_m,
                                        double least_overlap = 0.5);

}  // namespace verge::eval
