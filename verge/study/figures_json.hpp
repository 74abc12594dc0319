// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string>

#include "verge/eval/tolerance_score.hpp"

namespace verge::study {

/// A figure as JSON text, to a millionth, a whole number without a point; null where there is none or it is
/// not finite.
[[nodiscard]] std::string figure_json(const std::optional<double>& figure);

/// Counts and the figures of them as the text of one object.
[[nodiscard]] std::string counts_json(const eval::ToleranceCounts& counts);

/// An array of objects: where they hold, the counts, and of cells the macro F1.
[[nodiscard]] std::string cells_json(std::span<const eval::ToleranceCell> cells);
[[nodiscard]] std::string confidence_json(std::span<const eval::ConfidencePoint> points);

}  // namespace verge::study
