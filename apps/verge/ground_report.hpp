// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "verge/eval/ground_plane.hpp"
#include "verge/eval/ground_score.hpp"

namespace verge::app {

/// Which points are ground, against labels: each scan, and all together.
struct GroundEvaluation {
  struct Scan {
    std::string frame;
    eval::GroundScore score;
  };
  eval::GroundScoreConfig config;
  std::optional<eval::GroundPlaneConfig> plane;  ///< None where label files were scored.
  std::vector<Scan> scans;
  eval::GroundScore all;
};

/// A row a protocol, and how far heights are off; with `per_frame` also a row a scan.
[[nodiscard]] std::string ground_table(const GroundEvaluation& evaluation, bool per_frame);
/// One JSON object with the figures and the counts behind them, of all scans and of each.
[[nodiscard]] std::string ground_json(const GroundEvaluation& evaluation);
/// A row a scan and protocol, and one for all by each; RFC 4180.
[[nodiscard]] std::string ground_csv(const GroundEvaluation& evaluation);

}  // namespace verge::app
