// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include "apps/verge/commands.hpp"
#include "apps/verge/console.hpp"
#include "verge/core/field_io.hpp"
#include "verge/detect/registry.hpp"

namespace verge::app {
namespace {

constexpr const char* kExamples =
    "Examples:\n"
    "  verge methods              # what there is\n"
    "  verge methods gradient     # its settings: key, default, unit, range, meaning, source\n";

std::string list_of_methods() {
  std::size_t width = 0;
  for (const detect::Method& method : detect::methods()) width = std::max(width, method.name.size());
  std::string text;
  for (const detect::Method& method : detect::methods()) {
    text +=
        fmt::format("{:{}}  {}\n{:{}}  {}\n", method.name, width, method.summary, "", width, method.citation);
  }
  return text;
}

std::string description_of(const detect::Method& method) {
  const auto* order = method.order == detect::Order::kIndependent ? "scans are worked on in parallel"
                                                                  : "scans are worked on in their order";
  return fmt::format("{}: {}\n{}\n{}\n\n{}", method.name, method.summary, method.citation, order,
                     to_table(method.fields({})));
}

ExitCode show(const std::optional<std::string>& name) {
  if (!name) return print_data(list_of_methods());
  try {
    return print_data(description_of(detect::method_named(*name)));
  } catch (const std::invalid_argument& error) {
    print_error({ErrorCode::kUsage, {}, {}, error.what(), {}, {}});
    return ExitCode::kUsage;
  }
}

}  // namespace

void add_methods(CLI::App& program, Action& action) {
  CLI::App* verb = program.add_subcommand("methods", "list the methods, or one method's settings");
  const auto name = std::make_shared<std::optional<std::string>>();
  verb->add_option("NAME", *name, "the method to describe");
  verb->footer(std::string(kExamples) + "\n" + exit_code_help());
  verb->callback([name, &action] { action = [name] { return show(*name); }; });
}

}  // namespace verge::app
