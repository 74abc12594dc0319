// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include <nlohmann/json.hpp>

#include "apps/verge/evaluation_report.hpp"

namespace verge::app {

/// A figure for JSON, as study::figure_json() has it.
[[nodiscard]] nlohmann::ordered_json figure(const std::optional<double>& value);

/// The metrics of docs/evaluation.md as tables, and as one JSON object with the counts behind them.
[[nodiscard]] std::string metric_tables(const TruthEvaluation& evaluation);
[[nodiscard]] nlohmann::ordered_json metrics_json(const TruthEvaluation& evaluation);

}  // namespace verge::app
