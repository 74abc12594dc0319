// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "verge/core/vec.hpp"
#include "verge/model/scene.hpp"

namespace verge::eval {

/// One scan of a drive. Corners keep their ids from scan to scan. In the truth a confidence of 0 marks a
/// place that looks like a corner and is none (a driveway, a gap in the kerb, a gap between parked cars): a
/// false corner that was presented.
struct CornerFrame {
  const Scene* prediction = nullptr;  ///< Null: nothing was predicted.
  const Scene* truth = nullptr;
  std::optional<Vec2> place{};  ///< Of the sensor in the world, metres; none where it is not known.
};

/// What a drive's corners came to; those of several drives are added up. An event is a corner of the truth
/// from the first scan that has it to the last; a report is an id of the prediction over scans without a gap.
struct CornerScore {
  std::size_t true_corners = 0;
  std::size_t detected = 0;  ///< True corners with a prediction near them in one of their scans.
  std::size_t late = 0;      ///< Those of them that had been passed when first detected.
  std::size_t false_presented = 0;
  std::size_t false_reported = 0;  ///< False corners likewise.
  std::size_t reports = 0;
  std::size_t false_reports = 0;  ///< Reports that are near no true corner in any of their scans.
  /// Of the detected ones: from the first scan of the event to that of the first detection, in scans and in
  /// metres that the corner came nearer; and the distance of the two positions then.
  std::vector<double> latency_scans;
  std::vector<double> latency_m;
  std::vector<double> ahead_m;  ///< How far ahead it was then; negative: passed.
  std::vector<double> position_error_m;
  double way_m = 0.0;  ///< From place to place, where both are known.

  CornerScore& operator+=(const CornerScore& more);

  [[nodiscard]] std::optional<double> m1() const;  ///< Detected / true corners (paper 1's first measure).
  [[nodiscard]] std::optional<double> m2() const;  ///< False reported / false presented (its second).
  [[nodiscard]] std::optional<double> false_discovery_rate() const;  ///< False reports / all reports.
  [[nodiscard]] std::optional<double> false_reports_a_km() const;    ///< None where no way is known.
};

/// Scores one drive, its scans in order of time. A prediction is near a corner of the truth within near_m,
/// and of a side that allows it (both goes with any).
[[nodiscard]] CornerScore score_corners(std::span<const CornerFrame> drive, double near_m = 2.0);

}  // namespace verge::eval
