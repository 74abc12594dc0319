// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include <filesystem>
#include <memory>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include "apps/verge/commands.hpp"
#include "apps/verge/console.hpp"
#include "apps/verge/evaluation_report.hpp"
#include "apps/verge/number_range.hpp"
#include "apps/verge/scene_file.hpp"
#include "verge/eval/boundary_error.hpp"

namespace verge::app {
namespace {

constexpr const char* kExamples =
    "Examples:\n"
    "  verge evaluate found.jsonl --truth truth.jsonl           # how far from the truth, as a table\n"
    "  verge evaluate found.jsonl --truth truth.jsonl --json    # the same for programs, scan by scan\n";

struct EvaluateRequest {
  std::string predictions;
  std::string truth;
  eval::BoundaryErrorConfig config;
  bool json = false;
};

Expected<eval::Comparison> compare_files(const EvaluateRequest& request) {
  const auto predictions = read_scenes(request.predictions);
  if (!predictions) return Unexpected(predictions.error());
  const auto truths = read_scenes(request.truth);
  if (!truths) return Unexpected(truths.error());
  if (truths->empty()) {
    return Unexpected(Error{ErrorCode::kUnusable, request.truth, {}, "has no scene to compare with", {}, {}});
  }
  return eval::compare_all(*predictions, *truths, request.config);
}

ExitCode evaluate(const EvaluateRequest& request) {
  Console console({});
  const auto comparison = compare_files(request);
  if (!comparison) {
    console.error(comparison.error());
    return exit_code_of(comparison.error().code);
  }
  if (const std::size_t strays = comparison->frames_without_truth.size(); strays > 0) {
    console.warning(fmt::format("{} predicted frames have no truth and are left out, the first is {}", strays,
                                comparison->frames_without_truth.front()));
  }
  return print_data(request.json ? evaluation_json(*comparison, request.config)
                                 : evaluation_table(*comparison, request.config));
}

}  // namespace

void add_evaluate(CLI::App& program, Action& action) {
  CLI::App* verb = program.add_subcommand("evaluate", "say how far found boundaries are from the truth");
  const auto request = std::make_shared<EvaluateRequest>();
  verb->add_option("PREDICTIONS", request->predictions, "JSON lines of any program; - is standard input")
      ->required();
  verb->add_option("--truth", request->truth, "JSON lines of what is true; frames are matched by name")
      ->type_name("FILE")
      ->required();
  verb->add_option("--range", request->config.range_m, "compare within this distance of the sensor")
      ->type_name("M")
      ->capture_default_str()
      ->check(finite_range(0.1, 1000.0));
  verb->add_option("--tolerance", request->config.tolerance_m, "what counts as right and as covered")
      ->type_name("M")
      ->capture_default_str()
      ->check(finite_range(0.001, 100.0));
  verb->add_flag("--any-side", request->config.any_side,
                 "compare left with right as well: the place counts, not the name of the side");
  verb->add_flag("--json", request->json, "one JSON object with every scan instead of a table");
  verb->footer(std::string(kExamples) + "\n" + exit_code_help());
  verb->callback([request, &action] { action = [request] { return evaluate(*request); }; });
}

}  // namespace verge::app
