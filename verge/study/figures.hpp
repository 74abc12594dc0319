// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "verge/study/contestant.hpp"
#include "verge/study/suite.hpp"
#include "verge/study/tally.hpp"

namespace verge::study {

/// A number with its name; none where there is nothing to tell (a share of no samples, corners of a method
/// that does not report any).
struct Figure {
  std::string name;
  std::optional<double> value;
};
using Figures = std::vector<Figure>;

/// What a cell's tally came to, in the suite's terms: always the same names in the same order.
[[nodiscard]] Figures figures_of(const Suite& suite, const Contestant& contestant, const Tally& tally);

/// The figures of how long a scan took, in ms: not part of figures_of(), since no two runs agree in them.
[[nodiscard]] Figures times_of(const Tally& tally);

/// None where there is no figure of that name, or it has no value.
[[nodiscard]] std::optional<double> value_of(const Figures& figures, std::string_view name);

/// The cell whose counts are the headline: the suite's range and tolerance. Null of no scan.
[[nodiscard]] const eval::ToleranceCell* headline_of(const Suite& suite, const Tally& tally);

/// Whether a cell is a folder of labelled scans.
[[nodiscard]] bool is_labelled(const Cell& cell);

}  // namespace verge::study
