// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "apps/verge/console.hpp"
#include "verge/eval/ground_plane.hpp"

namespace verge::app {

/// What `verge evaluate` is asked to do.
struct EvaluateRequest {
  std::string predictions;            ///< JSON lines; "-" is standard input. Of ground: a folder of labels.
  std::optional<std::string> truth;   ///< JSON lines of Scenes; or
  std::optional<std::string> labels;  ///< a folder of labelled scans.
  bool ground = false;                ///< Of labels: which points are ground, not boundaries.
  eval::GroundPlaneConfig plane;      ///< Of ground without predictions.
  std::optional<std::string> suite;   ///< Or a suite, with what follows.
  std::optional<std::filesystem::path> folder;
  std::vector<std::string> methods;  ///< Empty: all that there are.
  std::optional<std::size_t> drives;
  std::optional<std::size_t> scans;
  std::optional<std::filesystem::path> data;         ///< Where the labelled sets lie; none: $VERGE_DATA.
  std::optional<std::filesystem::path> write_scans;  ///< Its scans are written there, and nothing is judged.
  std::size_t jobs = 0;                              ///< 0: as many as the machine can.
  bool no_times = false;
  std::optional<double> range_m;    ///< None: 20 m for boundaries, no limit for ground.
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

/// The files that --json and --csv name are written, and one of the three goes to standard
/// output.
[[nodiscard]] ExitCode hand_out(const EvaluateRequest& request, const EvaluationOutput& output,
                                Console& console);

}  // namespace verge::app
