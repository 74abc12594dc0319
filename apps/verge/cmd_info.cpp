// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include <memory>
#include <optional>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include "apps/verge/commands.hpp"
#include "apps/verge/console.hpp"
#include "apps/verge/damage.hpp"
#include "apps/verge/inputs.hpp"
#include "apps/verge/options.hpp"
#include "apps/verge/recording_facts.hpp"
#include "verge/model/scene.hpp"

namespace verge::app {
namespace {

constexpr const char* kExamples =
    "Examples:\n"
    "  verge info scan.pcd                  # points, rings, ranges, fields, time, how the sensor stands\n"
    "  verge info drive/velodyne --json     # the same of a whole folder, for programs\n";

struct InfoRequest {
  InputRequest input;
  DamagePolicy damage;
  bool json = false;
};

ExitCode info(const InfoRequest& request) {
  Console console({});
  RecordingFacts facts;
  const Log log = [&](LogLevel /*level*/, std::string_view text) { facts.notes.emplace_back(text); };
  auto inputs = Inputs::open(request.input, log);
  if (!inputs) {
    console.error(inputs.error());
    return exit_code_of(inputs.error().code);
  }
  std::optional<Error> first_error;
  while (true) {
    const auto next = inputs->next();
    if (next && !*next) break;
    if (next) {
      add(facts, **next);
      continue;
    }
    console.error(next.error());
    ++facts.counts.damaged;
    if (!first_error) first_error = next.error();
  }
  facts.counters = inputs->counters();
  if (inputs->format()) facts.format = name_of(*inputs->format());
  const ExitCode code = exit_code_of(first_error, facts.counts, request.damage);
  if (code == ExitCode::kOk || code == ExitCode::kDamaged) warn_of_damage(facts.counts, console);
  if (facts.counts.scans == 0 || code == ExitCode::kUnusable) return code;
  const ExitCode printed = print_data(request.json ? to_json(facts) : to_text(facts));
  return printed == ExitCode::kOk ? code : printed;
}

}  // namespace

void add_info(CLI::App& program, Action& action) {
  CLI::App* verb = program.add_subcommand("info", "say what is in a file or folder of scans");
  const auto request = std::make_shared<InfoRequest>();
  add_input_options(*verb, request->input);
  verb->add_flag("--json", request->json, "one JSON object instead of a table");
  add_damage_options(*verb, request->damage);
  verb->footer(std::string(kExamples) + "\n" + exit_code_help());
  verb->callback([request, &action] { action = [request] { return info(*request); }; });
}

}  // namespace verge::app
