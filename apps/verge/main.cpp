// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <exception>
#include <new>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "apps/verge/commands.hpp"
#include "apps/verge/console.hpp"
#include "apps/verge/signals.hpp"
#include "verge/core/field_io.hpp"
#include "verge/core/version.hpp"

namespace verge::app {
namespace {

/// Every verb; a new one is one more here and in commands.hpp.
constexpr std::array kVerbs{
    add_convert, add_detect, add_evaluate, add_info, add_methods, add_simulate, add_train,
};

constexpr const char* kExamples =
    "Examples:\n"
    "  verge info drive/velodyne                        # what is in these files?\n"
    "  verge detect drive/velodyne -o boundaries.jsonl  # where are the road's edges?\n"
    "  verge convert drive/velodyne drive_ply --to ply  # the same scans in another format\n"
    "  verge methods gradient                           # which settings are there?\n"
    "  verge simulate made-up                           # a drive whose boundaries are known\n"
    "  verge evaluate boundaries.jsonl --truth made-up/truth.jsonl  # how far from the truth?\n"
    "  verge train lda -o lda.toml                      # the model of a method that learns\n"
    "  verge detect --help                              # options of a verb\n";

ExitCode refuse(const std::string& what) {
  print_error({ErrorCode::kUsage, {}, {}, what, {}, {}});
  return ExitCode::kUsage;
}

/// What is wrong with the first word where it is no verb.
std::optional<std::string> misspelled_verb(const CLI::App& program, std::string_view word) {
  std::vector<std::string> names;
  for (const CLI::App* verb : program.get_subcommands({})) names.push_back(verb->get_name());
  const std::vector<std::string_view> views(names.begin(), names.end());
  if (word.starts_with('-') || std::ranges::find(views, word) != views.end()) return std::nullopt;
  const std::string_view near = nearest_word(word, views);
  if (near.empty()) return fmt::format("no verb '{}' (known: {})", word, fmt::join(names, ", "));
  return fmt::format("no verb '{}' (did you mean '{}'?)", word, near);
}

ExitCode parse_and_run(int argc, char** argv) {
  CLI::App program("verge finds the road in lidar scans: its edges, and where they run.", "verge");
  program.require_subcommand(1);
  program.set_version_flag("--version", fmt::format("verge {}", version()));
  program.footer(std::string(kExamples) + "\n" + exit_code_help());
  Action action;
  for (const auto& add_verb : kVerbs) add_verb(program, action);
  try {
    program.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    return print_data(program.help());
  } catch (const CLI::CallForVersion& asked) {
    return print_data(fmt::format("{}\n", asked.what()));
  } catch (const CLI::ParseError& error) {
    if (const auto misspelled = argc > 1 ? misspelled_verb(program, argv[1]) : std::nullopt)
      return refuse(*misspelled);
    return refuse(fmt::format("{} (see: verge --help)", error.what()));
  }
  return action();
}

/// Nothing escapes: what is not foreseen is a bug, and said so in one line.
ExitCode guarded_main(int argc, char** argv) {
  try {
    return parse_and_run(argc, argv);
  } catch (const std::bad_alloc&) {
    print_error(
        {ErrorCode::kLimit, {}, {}, "out of memory (see --max-mem, and -j for fewer scans at once)", {}, {}});
    return ExitCode::kLimit;
  } catch (const std::exception& error) {
    print_error({ErrorCode::kUnusable,
                 {},
                 {},
                 fmt::format("internal error, please report it: {}", error.what()),
                 {},
                 {}});
  } catch (...) {
    print_error({ErrorCode::kUnusable, {}, {}, "internal error, please report it", {}, {}});
  }
  return ExitCode::kBug;
}

}  // namespace
}  // namespace verge::app

int main(int argc, char** argv) {
  verge::app::ignore_write_signals();
  return static_cast<int>(verge::app::guarded_main(argc, argv));
}
