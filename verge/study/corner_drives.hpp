// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "verge/study/suite.hpp"

// Drives past true and false corners, as paper 1 drove them: an ALASCA XT 1 m up, turned down by 13.4
// degrees.

namespace verge::study {

struct CornerKind {
  double radius_m = 3.0;  ///< Of the kerb returns.
  double speed_kmh = 30.0;
  bool coarse = false;  ///< 0.5 degrees from point to point in the place of 0.25.
};

/// Drives of 385 m past four side roads of 4 to 5 m each, and past what looks like one: driveways of 1 to
/// 2.5 m, gaps of the kerb, gaps between cars parked in a bay. They differ in places, widths, sides, kerbs of
/// 12 to 15 cm and noise. Methods are told how the sensor was mounted, as the paper's is.
[[nodiscard]] MadeDrives corner_drives(const CornerKind& kind, std::size_t drives,
                                       const SuiteRequest& request);

/// Columns of M1, M2 and what goes with them, and their meaning in a sentence.
[[nodiscard]] std::vector<Column> corner_columns();
[[nodiscard]] std::string corner_measures();

}  // namespace verge::study
