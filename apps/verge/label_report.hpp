// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "verge/eval/label_score.hpp"

namespace verge::app {

/// Predictions against labels: each scan, and all together.
struct LabelEvaluation {
  struct Scan {
    std::string frame;
    eval::LabelScore score;
  };
  eval::LabelScoreConfig config;
  double gap_m = 0.0;
  std::vector<Scan> scans;
  eval::LabelScore all;
};

/// A row a tolerance; with `per_frame` also a row a scan, with its F1 at each tolerance.
[[nodiscard]] std::string label_table(const LabelEvaluation& evaluation, bool per_frame);
/// One JSON object with the figures and the counts behind them, of all scans and of each.
[[nodiscard]] std::string label_json(const LabelEvaluation& evaluation);
/// A row a scan and tolerance, and one for all at each; RFC 4180.
[[nodiscard]] std::string label_csv(const LabelEvaluation& evaluation);

}  // namespace verge::app
