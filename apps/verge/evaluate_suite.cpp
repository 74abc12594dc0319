// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "apps/verge/evaluate_suite.hpp"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "apps/verge/progress.hpp"
#include "apps/verge/scene_file.hpp"
#include "apps/verge/signals.hpp"
#include "apps/verge/suite_scans.hpp"
#include "verge/core/atomic_file.hpp"
#include "verge/core/hash.hpp"
#include "verge/study/engine.hpp"
#include "verge/study/figures.hpp"
#include "verge/study/made_scans.hpp"
#include "verge/study/report.hpp"

namespace verge::app {
namespace {

constexpr std::size_t kWorstScans = 3;  // of each method

Error usage_error(std::string what) { return {ErrorCode::kUsage, {}, {}, std::move(what), {}, {}}; }

Expected<study::Suite> suite_of(const EvaluateRequest& request) {
  const char* variable = std::getenv("VERGE_DATA");
  const std::filesystem::path usual = variable == nullptr ? "" : variable;
  try {
    return study::suite_named(
        *request.suite,
        {.drives = request.drives, .scans = request.scans, .data = request.data.value_or(usual)});
  } catch (const std::invalid_argument& error) {
    return Unexpected(usage_error(error.what()));
  }
}

Expected<study::Contestant> program_of(const std::string& file) {
  auto scenes = read_scenes(file);
  if (!scenes) return Unexpected(std::move(scenes).error());
  study::Predictions predictions;
  for (Scene& scene : scenes->scenes) predictions.emplace(scene.frame, std::move(scene));
  const std::string name = file == "-" ? "predictions" : std::filesystem::path(file).filename().string();
  return study::contestant_of(escape_control_bytes(name), std::move(predictions));
}

/// Whether a made-up scan of the suite is among the predictions.
bool knows_scan_of(const study::Predictions& predictions, const study::Suite& suite) {
  return std::ranges::any_of(study::frames_of(suite),
                             [&](const std::string& frame) { return predictions.contains(frame); });
}

/// The methods that were asked for, or all that say what is judged; then the predictions. Fails also where
/// these are of none of the suite's drives: every figure would be nought.
Expected<std::vector<study::Contestant>> contestants_of(const EvaluateRequest& request,
                                                        const study::Suite& suite) {
  std::vector<study::Contestant> contestants;
  try {
    for (const std::string& method : request.methods) contestants.push_back(study::contestant_of(method));
  } catch (const std::invalid_argument& error) {
    return Unexpected(usage_error(fmt::format("--method: {}", error.what())));
  }
  if (request.methods.empty()) contestants = study::usual_contestants(suite.judged);
  if (request.predictions.empty()) return contestants;
  auto program = program_of(request.predictions);
  if (!program) return Unexpected(std::move(program).error());
  if (!study::is_labelled(suite.cells.front()) && !knows_scan_of(*program->predictions, suite))
    return Unexpected(Error{ErrorCode::kUnusable,
                            request.predictions,
                            {},
                            "none of its frames is a scan of this suite (see --write-scans)",
                            {},
                            {}});
  contestants.push_back(*std::move(program));
  return contestants;
}

/// Any line of the program may change a figure: what another build made is not taken up again.
std::string build_mark() {
  std::ifstream program("/proc/self/exe", std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(program), {}};
  return fmt::format("{:016x}", fnv1a(bytes));
}

study::RunOptions options_of(const EvaluateRequest& request) {
  study::RunOptions options{.jobs = request.jobs, .keep_in = {}, .salt = {}};
  if (!request.folder) return options;
  options.keep_in = *request.folder / "parts";
  options.salt = build_mark();
  return options;
}

Expected<study::Results> run_suite(study::Suite suite, const EvaluateRequest& request, Console& console,
                                   const Signals& signals) {
  auto contestants = contestants_of(request, suite);
  if (!contestants) return Unexpected(std::move(contestants).error());
  const auto begin = std::chrono::steady_clock::now();
  const study::RunHooks hooks{.progress =
                                  [&](std::size_t done, std::size_t total) {
                                    const std::chrono::duration<double> taken =
                                        std::chrono::steady_clock::now() - begin;
                                    console.progress(progress_line(done, total, taken.count()));
                                  },
                              .warning = [&](const std::string& text) { console.warning(text); }};
  return study::run(std::move(suite), *std::move(contestants), options_of(request), hooks, signals.stop());
}

ExitCode stopped(const EvaluateRequest& request, const study::Results& results, Console& console,
                 const Signals& signals) {
  const std::string kept = request.folder
                               ? fmt::format("are kept in {}: the same command goes on from there",
                                             (*request.folder / "parts").string())
                               : std::string("were done; with -o FOLDER they would have been kept");
  console.print(escape_control_bytes(fmt::format("verge: stopped: {} of {} parts {}", results.parts_done,
                                                 results.parts, kept)) +
                "\n");
  return signals.exit_code();
}

Expected<void> write_report(const std::filesystem::path& folder, const study::Results& results,
                            const EvaluationOutput& output, bool times) {
  auto worst = study::worst_scans(results, kWorstScans);
  if (!worst) return Unexpected(worst.error());
  auto corners = study::corner_pictures(results);
  if (!corners) return Unexpected(corners.error());
  auto galleries = study::edge_galleries(results);
  if (!galleries) return Unexpected(galleries.error());
  auto roads = study::boundary_galleries(results);
  if (!roads) return Unexpected(roads.error());
  std::ranges::move(*roads, std::back_inserter(*galleries));
  galleries->push_back(
      {"Corners",
       "Four lines seen from above, heading up, with the edges found; true corners are crosses, faint where "
       "they only look like one. Then the road's width from scan to scan: a corner is marked where it is "
       "first said.",
       *std::move(corners)});
  galleries->push_back(
      {"Worst scans",
       "Seen from above, heading up. Points by height, what was found in colour, the truth in white "
       "dashes over it.",
       *std::move(worst)});
  if (auto written = write_file(folder / "results.json", output.json); !written) return written;
  if (auto written = write_file(folder / "results.csv", output.csv); !written) return written;
  return write_file(folder / "report.html", study::html_report(results, *galleries, times));
}

}  // namespace

ExitCode evaluate_suite(const EvaluateRequest& request, Console& console) {
  const Signals signals;
  const auto fail = [&console](const Error& error) {
    console.error(error);
    return exit_code_of(error.code);
  };
  auto suite = suite_of(request);
  if (!suite) return fail(suite.error());
  if (request.write_scans) {
    const auto written = write_suite_scans(*suite, *request.write_scans, console, signals);
    if (!written) return fail(written.error());
    return signals.stop() ? signals.exit_code() : ExitCode::kOk;
  }
  const auto results = run_suite(*std::move(suite), request, console, signals);
  if (!results) return fail(results.error());
  if (results->parts_done < results->parts) return stopped(request, *results, console, signals);
  const bool times = !request.no_times;
  const EvaluationOutput output{study::text_report(*results, times), study::json_report(*results, times),
                                study::csv_report(*results)};
  if (request.folder) {
    if (auto written = write_report(*request.folder, *results, output, times); !written)
      return fail(written.error());
    console.print(
        fmt::format("verge: report: {}\n", escape_control_bytes((*request.folder / "report.html").string())));
  }
  return hand_out(request, output, console);
}

}  // namespace verge::app
