// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "apps/verge/detect_job.hpp"

#include <chrono>
#include <cstdlib>
#include <future>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include <fmt/core.h>

#include "apps/verge/pictures.hpp"
#include "apps/verge/progress.hpp"
#include "apps/verge/report.hpp"
#include "apps/verge/signals.hpp"
#include "apps/verge/trace_json.hpp"
#include "verge/core/field_io.hpp"
#include "verge/detect/registry.hpp"
#include "verge/emit/scene_json.hpp"
#include "verge/pipeline/run.hpp"

namespace verge::app {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

/// One run from the opened inputs to the finished outputs.
class Job {
 public:
  Job(const DetectRequest& request, const Settings& settings, Console& console, const Signals& signals,
      Inputs& inputs, Output& output, std::optional<Pictures>& pictures)
      : request_(request),
        settings_(settings),
        console_(console),
        signals_(signals),
        inputs_(inputs),
        output_(output),
        pictures_(pictures),
        total_(inputs.total()) {}

  [[nodiscard]] ExitCode run(detect::Detector& detector) {
    const auto options = pipeline_options();
    const auto ends = pipeline_ends();
    auto work = std::async(std::launch::async,
                           [&] { return pipeline::run(ends, detector, options, signals_.stop()); });
    constexpr auto kTick = std::chrono::milliseconds(100);
    while (work.wait_for(kTick) != std::future_status::ready) tick();
    return conclude(work.get());
  }

 private:
  [[nodiscard]] pipeline::Options pipeline_options() const {
    return {.mount_hint = settings_.mount_hint(),
            .mount_config = config_of<MountConfig>(settings_.section("mount_estimate")),
            .trace = request_.trace || pictures_,
            .threads = request_.threads,
            .method = settings_.method(),
            .config_hash = settings_.hash()};
  }

  [[nodiscard]] pipeline::Ends pipeline_ends() {
    return {
        .read = [this] { return inputs_.next(); },
        .render = [this](const pipeline::Frame& frame) { return render(frame); },
        .write = [this](const pipeline::Frame& frame, std::string&& record) { return write(frame, record); },
        .skip = [this](std::size_t /*index*/, const Error& error) { skip(error); }};
  }

  /// In several threads at once.
  [[nodiscard]] Expected<std::string> render(const pipeline::Frame& frame) const {
    if (pictures_) {
      if (auto drawn = pictures_->draw(frame); !drawn) return Unexpected(std::move(drawn).error());
    }
    std::string record = emit::to_json_line(frame.scene);
    if (!request_.trace) return record;
    record.pop_back();  // the closing brace: the trace becomes the object's last member
    return record + fmt::format(",\"trace\":{}}}", to_json(*frame.trace));
  }

  [[nodiscard]] Expected<void> write(const pipeline::Frame& frame, const std::string& record) {
    if (std::exchange(is_first_, false)) {
      console_.print(fmt::format("verge: {}\n", mount_line(frame.mount, settings_.mount_hint())));
    }
    if (pictures_) {
      if (auto drawn = pictures_->follow(frame); !drawn) return drawn;
    }
    return output_.write(frame, record);
  }

  void skip(const Error& error) {
    console_.error(error);
    output_.count_damaged();
  }

  /// While the run goes on: the progress line, and the end of patience after a signal.
  void tick() {
    const pipeline::Counts counts = output_.counts();
    console_.progress(progress_line(counts.scans + counts.damaged, total_, seconds_since(begin_)));
    // The scans under way have this long to come to their end; what is done by then is kept all the same.
    constexpr auto kPatience = std::chrono::milliseconds(1500);
    if (const auto since = signals_.since(); since && *since > kPatience) {
      const bool finished = output_.finish(true, {}).has_value();
      std::_Exit(static_cast<int>(finished ? signals_.exit_code() : ExitCode::kCannotWrite));
    }
  }

  [[nodiscard]] ExitCode outcome(const pipeline::Summary& summary) const {
    if (summary.interrupted) return signals_.exit_code();
    return exit_code_of(summary.first_error, summary.counts, request_.damage);
  }

  [[nodiscard]] static bool keeps_output(ExitCode code) {
    return code == ExitCode::kOk || code == ExitCode::kDamaged || code == ExitCode::kInterrupted ||
           code == ExitCode::kTerminated;
  }

  [[nodiscard]] ExitCode conclude(const Expected<pipeline::Summary>& done) {
    if (!done) return fail(done.error());
    const ExitCode code = outcome(*done);
    if (keeps_output(code)) {
      if (pictures_) {
        if (auto drawn = pictures_->finish(); !drawn) return fail(drawn.error());
      }
      if (auto finished = output_.finish(done->interrupted, done->mounts); !finished) {
        return fail(finished.error());
      }
    }
    if (keeps_output(code)) warn_of_damage(done->counts, console_);
    if (done->counts.scans > 0) console_.print(closing_table(*done, seconds_since(begin_)));
    return code;
  }

  [[nodiscard]] ExitCode fail(const Error& error) {
    const ExitCode code = exit_code_of(error.code);
    if (code != ExitCode::kOk) console_.error(error);
    return code;
  }

  const DetectRequest& request_;
  const Settings& settings_;
  Console& console_;
  const Signals& signals_;
  Inputs& inputs_;
  Output& output_;
  std::optional<Pictures>& pictures_;
  std::optional<std::size_t> total_;
  Clock::time_point begin_ = Clock::now();
  bool is_first_ = true;
};

/// The detector that the settings describe. Fields that fit one by one may still not fit together.
Expected<std::unique_ptr<detect::Detector>> detector_of(const Settings& settings) {
  try {
    return detect::make(settings.method(), settings.section(settings.method()));
  } catch (const std::invalid_argument& error) {
    return Unexpected({ErrorCode::kUsage, settings.method(), {}, error.what(), {}, {}});
  }
}

}  // namespace

ExitCode detect(const DetectRequest& request) {
  Console console(request.console);
  const auto fail = [&console](const Error& error) {
    console.error(error);
    return exit_code_of(error.code);
  };
  const auto settings = Settings::of(request.settings);
  if (!settings) return fail(settings.error());
  const auto detector = detector_of(*settings);
  if (!detector) return fail(detector.error());
  if (request.dump_config) return print_data(settings->to_toml());
  const Signals signals;
  auto inputs = Inputs::open(request.input, console.log());
  if (!inputs) return fail(inputs.error());
  std::optional<Pictures> pictures;
  if (request.plot) {
    auto opened = Pictures::open(*request.plot, request.input.paths.size() > 1,
                                 config_of<emit::BevPlot::Config>(settings->section("plot")));
    if (!opened) return fail(opened.error());
    pictures = *std::move(opened);
  }
  const auto output = Output::open(request.output, {settings->method(), settings->hash()});
  if (!output) return fail(output.error());
  return Job(request, *settings, console, signals, *inputs, **output, pictures).run(**detector);
}

}  // namespace verge::app
