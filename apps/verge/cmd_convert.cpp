// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <utility>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "apps/verge/commands.hpp"
#include "apps/verge/console.hpp"
#include "apps/verge/damage.hpp"
#include "apps/verge/inputs.hpp"
#include "apps/verge/options.hpp"
#include "apps/verge/progress.hpp"
#include "apps/verge/signals.hpp"
#include "verge/core/field_io.hpp"
#include "verge/io/sink.hpp"

namespace verge::app {
namespace {

constexpr const char* kExamples =
    "Examples:\n"
    "  verge convert scan.pcd scan.ply                    # one scan: the suffix says the format\n"
    "  verge convert drive/velodyne out --to pcd          # many scans: a folder with a file each\n"
    "  verge convert drive/velodyne out --to csv --frames 0:3\n"
    "  verge convert drive.pcap drive.mcap                # a capture for Foxglove and ROS 2\n"
    "  verge convert drive.mcap drive.pcap --model vlp16  # packets as that sensor would have sent them\n"
    "  verge convert stream.bin drive.idc                 # what an ibeo LUX sent, as a file with an index\n"
    "\n"
    "What both formats hold is kept; what a sensor's packets cannot say is counted in one warning. Objects,\n"
    "health and vehicle states of an ibeo recording are no scans and stay behind.\n";

struct ConvertRequest {
  std::string in;
  InputRequest input;
  std::string out;
  std::optional<std::string> to;
  std::optional<std::string> to_model;
  DamagePolicy damage;
  Console::Options console;
};

Error usage_error(std::string place, std::string what) {
  return {ErrorCode::kUsage, std::move(place), {}, std::move(what), {}, {}};
}

/// Nothing is written over what is still to be read: neither the input itself nor a file of its folder.
Expected<void> check_apart(const std::string& in, const std::string& out) {
  namespace fs = std::filesystem;
  std::error_code ignored;
  if (!fs::is_regular_file(out, ignored)) return {};
  if (fs::equivalent(in, out, ignored)) return Unexpected(usage_error(out, "is the input itself"));
  const fs::path folder = fs::canonical(fs::path(out), ignored).parent_path();
  if (fs::is_directory(in, ignored) && fs::equivalent(in, folder, ignored)) {
    return Unexpected(usage_error(out, "is a file of the input's folder"));
  }
  return {};
}

Expected<std::unique_ptr<io::Sink>> sink_of(const ConvertRequest& request, const Log& log) {
  io::SinkOptions options;
  options.model = request.to_model ? request.to_model : request.input.model;
  if (request.input.calibration) options.calibration = *request.input.calibration;
  options.log = log;
  if (!request.to) return io::create(request.out, options);
  options.format = value_named<io::Format>(*request.to);
  if (options.format) return io::create(request.out, options);
  return Unexpected(
      usage_error(fmt::format("--to {}", *request.to),
                  fmt::format("no such format (known: {})", fmt::join(enum_names<io::Format>, ", "))));
}

/// One run from the opened inputs to the finished output.
class ConvertJob {
 public:
  ConvertJob(Inputs& inputs, io::Sink& sink, Console& console, const Signals& signals)
      : inputs_(inputs), sink_(sink), console_(console), signals_(signals), total_(inputs.total()) {}

  /// Reads and writes until the end, a signal, or an output that cannot be written.
  [[nodiscard]] Expected<void> copy() {
    while (!signals_.stop()) {
      auto next = inputs_.next();
      if (next && !*next) break;
      if (!next) {
        skip(std::move(next).error());
        continue;
      }
      if (auto written = sink_.write(**next); !written) return written;
      pipeline::add(counts_, **next, {});
      console_.progress(progress_line(counts_.scans + counts_.damaged, total_, seconds()));
    }
    return {};
  }

  [[nodiscard]] ExitCode code(const DamagePolicy& policy) const {
    return signals_.stop() ? signals_.exit_code() : exit_code_of(first_error_, counts_, policy);
  }
  [[nodiscard]] const pipeline::Counts& counts() const { return counts_; }
  [[nodiscard]] std::string report(const std::string& out) const {
    return fmt::format("verge: {} scans with {} points in {:.1f} s: {}\n", counts_.scans, counts_.points.used,
                       seconds(), out);
  }

 private:
  void skip(Error error) {
    console_.error(error);
    ++counts_.damaged;
    if (!first_error_) first_error_ = std::move(error);
  }
  [[nodiscard]] double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
  }

  Inputs& inputs_;
  io::Sink& sink_;
  Console& console_;
  const Signals& signals_;
  std::optional<std::size_t> total_;
  pipeline::Counts counts_;
  std::optional<Error> first_error_;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

ExitCode fail(Console& console, const Error& error) {
  console.error(error);
  return exit_code_of(error.code);
}

ExitCode convert(const ConvertRequest& request) {
  Console console(request.console);
  const Signals signals;
  if (const auto apart = check_apart(request.in, request.out); !apart) return fail(console, apart.error());
  auto inputs = Inputs::open(request.input, console.log());
  if (!inputs) return fail(console, inputs.error());
  auto sink = sink_of(request, console.log());
  if (!sink) return fail(console, sink.error());
  ConvertJob job(*inputs, **sink, console, signals);
  if (const auto copied = job.copy(); !copied) return fail(console, copied.error());
  const ExitCode code = job.code(request.damage);
  if (code == ExitCode::kDamaged || code == ExitCode::kOk) warn_of_damage(job.counts(), console);
  if (code == ExitCode::kUnusable || job.counts().scans == 0) return code;
  if (const auto finished = (*sink)->finish(); !finished) return fail(console, finished.error());
  console.print(job.report(request.out));
  return code;
}

}  // namespace

void add_convert(CLI::App& program, Action& action) {
  CLI::App* verb = program.add_subcommand("convert", "write scans in another format");
  const auto request = std::make_shared<ConvertRequest>();
  verb->add_option("IN", request->in, "a file or folder of scans; - is standard input")->required();
  verb->add_option("OUT", request->out, "a file, or a new folder with a file for each scan")->required();
  verb->add_option("--to", request->to, "format to write, where OUT's name does not say it")->type_name("F");
  verb->add_option("--to-model", request->to_model,
                   "sensor whose packets are written, where it is not that of --model or of the scans")
      ->type_name("M");
  add_recording_options(*verb, request->input);
  add_damage_options(*verb, request->damage);
  add_console_options(*verb, request->console);
  verb->footer(std::string(kExamples) + "\n" + exit_code_help());
  verb->callback([request, &action] {
    request->input.paths = {request->in};
    action = [request] { return convert(*request); };
  });
}

}  // namespace verge::app
