// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "apps/verge/commands.hpp"
#include "apps/verge/console.hpp"
#include "apps/verge/options.hpp"
#include "apps/verge/progress.hpp"
#include "apps/verge/settings.hpp"
#include "apps/verge/signals.hpp"
#include "verge/core/atomic_file.hpp"
#include "verge/core/field_io.hpp"
#include "verge/study/train_lda.hpp"

namespace verge::app {
namespace {

constexpr const char* kMethod = "lda";  // the only one that learns

constexpr const char* kExamples =
    "Examples:\n"
    "  verge train lda -o lda.toml                          # on made-up drives; the same command, the same "
    "file\n"
    "  verge train lda --drives 0 --data labelled -o lda.toml  # on labelled scans alone\n"
    "  verge train lda --set lda.window=15 -o wide.toml\n"
    "\n"
    "The file is one of settings: verge detect SCANS --config lda.toml takes it.\n";

struct TrainRequest {
  std::string method;
  std::string output = "-";
  study::LdaTraining training;
  SettingsRequest settings;
  Console::Options console;
};

Error usage_error(std::string place, std::string what) {
  return {ErrorCode::kUsage, std::move(place), {}, std::move(what), {}, {}};
}

/// The gate and the windows that the settings describe.
Expected<detect::LdaConfig> config_of_request(const TrainRequest& request) {
  const auto settings = Settings::of(request.settings);
  if (!settings) return Unexpected(settings.error());
  try {
    const auto config = config_of<detect::LdaConfig>(settings->section(kMethod));
    (void)detect::Lda(config);  // what does not fit together throws now
    return config;
  } catch (const std::invalid_argument& error) {
    return Unexpected(usage_error(kMethod, error.what()));
  }
}

std::string closing_line(const study::LdaModel& model) {
  std::size_t scans = 0;
  std::size_t edges = 0;
  std::size_t others = 0;
  for (const study::LdaSource& source : model.sources) {
    scans += source.scans;
    edges += source.edge_windows;
    others += source.other_windows;
  }
  return fmt::format(
      "verge: trained on {} scans, {} windows of an edge and {} others; of those held back {:.1f} % of {} "
      "found, {:.2f} % of {} taken for one\n",
      scans, edges, others, 100.0 * model.found_share, model.held_edges, 100.0 * model.false_share,
      model.held_others);
}

/// The file of the model, made now, so that a folder that cannot be written ends the run before any work;
/// none for standard output.
Expected<std::optional<AtomicFile>> target_of(const TrainRequest& request) {
  if (request.output == "-") return std::optional<AtomicFile>();
  auto file = AtomicFile::create(request.output);
  if (!file) return Unexpected(std::move(file).error());
  return std::optional(*std::move(file));
}

ExitCode hand_out(const std::string& text, std::optional<AtomicFile>& file, Console& console) {
  if (!file) return print_data(text);
  auto written = file->write(text);
  if (written) written = file->commit();
  if (written) return ExitCode::kOk;
  console.error(written.error());
  return exit_code_of(written.error().code);
}

Expected<std::optional<study::LdaModel>> model_of(const study::LdaTraining& training, Console& console,
                                                  const Signals& signals) {
  const auto begin = std::chrono::steady_clock::now();
  const study::LdaTrainingHooks hooks{.stop = signals.stop(),
                                      .progress =
                                          [&](std::size_t done, std::size_t total) {
                                            const std::chrono::duration<double> taken =
                                                std::chrono::steady_clock::now() - begin;
                                            console.progress(progress_line(done, total, taken.count()));
                                          },
                                      .warning = [&](const std::string& text) { console.warning(text); }};
  return study::train_lda(training, hooks);
}

ExitCode train(const TrainRequest& request) {
  Console console(request.console);
  const Signals signals;
  const auto fail = [&console](const Error& error) {
    console.error(error);
    return exit_code_of(error.code);
  };
  if (request.method != kMethod)
    return fail(
        usage_error({}, fmt::format("nothing to train of '{}' (known: {})", request.method, kMethod)));
  const auto config = config_of_request(request);
  if (!config) return fail(config.error());
  study::LdaTraining training = request.training;
  training.config = *config;
  auto file = target_of(request);
  if (!file) return fail(file.error());
  const auto model = model_of(training, console, signals);
  if (!model) return fail(model.error());
  if (!*model) return signals.exit_code();
  console.print(closing_line(**model));
  return hand_out(study::model_file(training, **model), *file, console);
}

}  // namespace

void add_train(CLI::App& program, Action& action) {
  CLI::App* verb = program.add_subcommand("train", "make the model of a method that has one");
  const auto request = std::make_shared<TrainRequest>();
  verb->add_option("METHOD", request->method, "lda: the baseline of paper 3, reconstructed")->required();
  verb->add_option("-o,--output", request->output, "the model, a file of settings; - is standard output")
      ->type_name("FILE")
      ->capture_default_str();
  verb->add_option("--drives", request->training.drives, "made-up drives to train on; 0: none")
      ->type_name("N")
      ->capture_default_str()
      ->check(CLI::Range(0, 100'000));
  verb->add_option("--scans", request->training.scans, "of each drive")
      ->type_name("N")
      ->capture_default_str()
      ->check(CLI::Range(1, 1000));
  verb->add_option("--data", request->training.data,
                   "labelled scans besides, as `verge evaluate --labels` takes them; may stand several times")
      ->type_name("FOLDER")
      ->allow_extra_args(false);
  verb->add_option("--config", request->settings.config, "settings of the method (see: verge methods lda)")
      ->type_name("FILE.toml");
  verb->add_option("--set", request->settings.set,
                   "one setting, as in lda.window=15; may stand several times")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  add_console_options(*verb, request->console);
  verb->footer(std::string(kExamples) + "\n" + exit_code_help());
  verb->callback([request, &action] { action = [request] { return train(*request); }; });
}

}  // namespace verge::app
