// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include <filesystem>
#include <memory>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include "apps/verge/commands.hpp"
#include "apps/verge/console.hpp"
#include "apps/verge/evaluate_ground.hpp"
#include "apps/verge/evaluate_labels.hpp"
#include "apps/verge/evaluate_request.hpp"
#include "apps/verge/evaluate_suite.hpp"
#include "apps/verge/evaluate_truth.hpp"
#include "apps/verge/number_range.hpp"
#include "apps/verge/options.hpp"
#include "verge/core/atomic_file.hpp"
#include "verge/core/field_io.hpp"
#include "verge/study/suite.hpp"

namespace verge::app {
namespace {

constexpr const char* kExamples =
    "Examples:\n"
    "  verge evaluate found.jsonl --truth truth.jsonl              # how far from the truth, as tables\n"
    "  verge evaluate found.jsonl --truth truth.jsonl --json -     # the same for programs, scan by scan\n"
    "  verge evaluate --predictions other.jsonl --labels nuscenes  # any program against labelled scans\n"
    "  verge evaluate found.jsonl --labels sequences/00 --tolerance 0.1,0.3 --per-frame --csv figures.csv\n"
    "  verge evaluate --ground --labels sequences/00               # how well the road's plane tells the "
    "ground\n"
    "  verge evaluate predictions --ground --labels sequences/00   # and the label files of any program\n"
    "  verge evaluate --suite degradation -o degradation          # drives, table and "
    "degradation/report.html\n"
    "  verge evaluate --suite paper3 --write-scans frames         # what another program is to find, and "
    "then\n"
    "  verge evaluate --suite paper3 --predictions other.jsonl    # how well it did beside the methods\n"
    "  verge evaluate --suite paper3 --drives 2 --scans 5 --method gradient --method "
    "gradient:reading=paper\n";

bool is_standard_output(const std::optional<std::string>& target) { return target && *target == "-"; }

Expected<void> write_where_asked(const std::optional<std::string>& target, const std::string& text) {
  if (!target || is_standard_output(target)) return {};
  return write_file(*target, text);
}

/// None where the request makes sense.
std::optional<std::string> nonsense_in(const EvaluateRequest& request) {
  if (is_standard_output(request.json) && is_standard_output(request.csv))
    return "--json and --csv cannot both be standard output";
  if (request.suite) return std::nullopt;
  if (request.ground) return std::nullopt;
  if (request.predictions.empty()) return "no predictions: name a file of JSON lines";
  if (!request.truth && !request.labels)
    return "nothing to compare with: give --truth FILE, --labels FOLDER or --suite NAME";
  return std::nullopt;
}

ExitCode evaluate(const EvaluateRequest& request) {
  Console console(request.console);
  if (const auto nonsense = nonsense_in(request)) {
    console.error({ErrorCode::kUsage, {}, {}, *nonsense, {}, {}});
    return ExitCode::kUsage;
  }
  if (request.suite) return evaluate_suite(request, console);
  const auto output = request.ground   ? evaluate_ground(request, console)
                      : request.labels ? evaluate_labels(request, console)
                                       : evaluate_truth(request, console);
  if (output) return hand_out(request, *output, console);
  console.error(output.error());
  return exit_code_of(output.error().code);
}

void add_sources(CLI::App& verb, EvaluateRequest& request) {
  auto* positional =
      verb.add_option("PREDICTIONS", request.predictions,
                      "JSON lines of any program; - is standard input (of --ground: a folder)");
  verb.add_option("--predictions", request.predictions, "the same")->type_name("FILE")->excludes(positional);
  auto* truth = verb.add_option("--truth", request.truth, "JSON lines of what is true; frames go by name");
  truth->type_name("FILE");
  verb.add_option(
          "--labels", request.labels,
          "labelled scans: nuScenes lidarseg, SemanticKITTI, PCD with kerb labels, kerb polygons (.gt), "
          "truth.csv")
      ->type_name("FOLDER")
      ->excludes(truth);
}

/// After the options that do not go with it.
void add_ground(CLI::App& verb, EvaluateRequest& request) {
  auto* ground =
      verb.add_flag("--ground", request.ground,
                    "of labels: score which points are ground, by a folder of label files "
                    "(NAME_lidarseg.bin, NAME.label) or, without PREDICTIONS, by the road's plane");
  ground->needs(verb.get_option("--labels"));
  for (const char* option : {"--tolerance", "--gap", "--any-side"}) ground->excludes(verb.get_option(option));
  const FieldRow tolerance = field_rows(request.plane).front();
  verb.add_option("--plane-tolerance", request.plane.tolerance_m,
                  fmt::format("of --ground: {}", tolerance.info.meaning))
      ->type_name("M")
      ->capture_default_str()
      ->needs(ground)
      ->check(finite_range(tolerance.info.min, tolerance.info.max));
}

std::string suite_help() {
  std::string text = "a ready evaluation, with its table and report:";
  for (const study::SuiteEntry& entry : study::suites())
    text += fmt::format("{} {} ({})", &entry == study::suites().data() ? "" : ";", entry.name, entry.about);
  return text;
}

void add_suite(CLI::App& verb, EvaluateRequest& request) {
  auto* suite = verb.add_option("--suite", request.suite, suite_help())->type_name("NAME");
  verb.get_option("--truth")->excludes(suite);
  verb.get_option("--labels")->excludes(suite);
  const auto add = [&](const char* name, auto& value, const char* about) {
    return verb.add_option(name, value, about)->needs(suite);
  };
  add("-o,--output", request.folder,
      "of a suite: folder for results.json, results.csv, report.html and the parts that are done, from which "
      "a "
      "later run goes on")
      ->type_name("FOLDER");
  add("--method", request.methods,
      "of a suite: METHOD or METHOD:KEY=VALUE,..., may stand several times (default: all, in their readings)")
      ->type_name("M")
      ->allow_extra_args(false);
  add("--drives", request.drives, "of a suite: drives a cell, in the place of its own number")
      ->type_name("N")
      ->check(CLI::Range(1, 1'000'000));
  add("--scans", request.scans, "of a suite: scans a drive, in the place of its own number")
      ->type_name("N")
      ->check(CLI::Range(1, 1'000'000));
  add("--data", request.data,
      "of suites real, paper2-real and paper3-real: where the labelled sets lie (default: $VERGE_DATA)")
      ->type_name("FOLDER");
  add("--write-scans", request.write_scans,
      "of a suite of made drives: write its scans (PCD) and their truth for another program to be run on, "
      "whose "
      "--predictions the suite then judges; nothing else is done")
      ->type_name("FOLDER");
  add("-j,--jobs", request.jobs, "of a suite: parts worked on at once; 0: as many as the machine can")
      ->type_name("N")
      ->check(CLI::Range(0, 1024));
  verb.add_flag("--no-times", request.no_times,
                "of a suite: leave out run times, which differ from run to run")
      ->needs(suite);
}

}  // namespace

ExitCode hand_out(const EvaluateRequest& request, const EvaluationOutput& output, Console& console) {
  auto written = write_where_asked(request.json, output.json);
  if (written) written = write_where_asked(request.csv, output.csv);
  if (!written) {
    console.error(written.error());
    return exit_code_of(written.error().code);
  }
  if (is_standard_output(request.json)) return print_data(output.json);
  return print_data(is_standard_output(request.csv) ? output.csv : output.table);
}

void add_evaluate(CLI::App& program, Action& action) {
  CLI::App* verb = program.add_subcommand("evaluate", "say how far what was found is from the truth");
  const auto request = std::make_shared<EvaluateRequest>();
  add_sources(*verb, *request);
  add_suite(*verb, *request);
  verb->add_option("--range", request->range_m,
                   "compare within this distance of the sensor (default: 20; of --ground: no limit)")
      ->type_name("M")
      ->check(finite_range(0.1, 1000.0));
  verb->add_option("--tolerance", request->tolerance_m,
                   "what counts as right and as found, one or several (default: those of the protocol)")
      ->type_name("M,M,...")
      ->delimiter(',')
      ->check(finite_range(0.001, 100.0));
  verb->add_option("--gap", request->gap_m,
                   "of labels: widest gap between two returns of a ring with a boundary in between")
      ->type_name("M")
      ->capture_default_str()
      ->check(finite_range(0.001, 3.0));
  verb->add_flag("--any-side", request->any_side,
                 "compare left with right as well: the place counts, not the name of the side");
  add_ground(*verb, *request);
  verb->add_flag("--per-frame", request->per_frame, "also a row for each scan");
  verb->add_option("--json", request->json, "figures and counts, scan by scan; - instead of the tables")
      ->type_name("FILE");
  verb->add_option("--csv", request->csv, "the same as a table; - instead of the tables")->type_name("FILE");
  add_console_options(*verb, request->console);
  verb->footer(std::string(kExamples) + "\n" + exit_code_help());
  verb->callback([request, &action] { action = [request] { return evaluate(*request); }; });
}

}  // namespace verge::app
