// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/verge/console.hpp"

namespace verge::app {

/// What `verge evaluate` is asked to do.
struct EvaluateRequest {
  std::string predictions;            ///< JSON lines; "-" is standard input.
  std::optional<std::string> truth;   ///< JSON lines of Scenes; or
  std::optional<std::string> labels;  ///< a folder of labelled scans.
  double range_m = 20.0;
  std::vector<double> tolerance_m;  ///< Empty: those of the protocol.
  double gap_m = 0.6;  ///< Of labels: widest gap between two returns with the boundary in between.
  bool any_side = false;
  bool per_frame = false;
  std::optional<std::string> json;  ///< Files; "-" is standard output, in the place of the table.
  std::optional<std::string> csv;
  Console::Options console;
};

/// What an evaluation says, in the forms in which it is asked for.
struct EvaluationOutput {
  std::string table;
  std::string json;
  std::string csv;
};

}  // namespace verge::app
