// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "apps/verge/console.hpp"

#include <cstdio>
#include <cstdlib>

#include <fmt/core.h>
#include <unistd.h>

#include "verge/core/atomic_file.hpp"

namespace verge::app {
namespace {

constexpr std::size_t kMostNotes = 6;
constexpr std::size_t kMostWarnings = 20;
constexpr std::string_view kRed = "\x1b[31m";
constexpr std::string_view kYellow = "\x1b[33m";
constexpr std::string_view kPlain = "\x1b[0m";
constexpr std::string_view kClearLine = "\r\x1b[K";

/// One call, so that lines of several threads and processes do not mix. Where standard error is gone there is
/// nobody left to tell.
void put(std::string_view text) { (void)std::fwrite(text.data(), 1, text.size(), stderr); }

bool is_terminal() { return ::isatty(STDERR_FILENO) == 1; }

/// https://no-color.org: any value that is not empty.
bool wants_colour() {
  const char* no_color = std::getenv("NO_COLOR");
  return is_terminal() && (no_color == nullptr || *no_color == '\0');
}

bool wants_progress(const Console::Options& options) {
  if (options.quiet || options.progress == ProgressMode::kNever) return false;
  return options.progress == ProgressMode::kAlways || is_terminal();
}

}  // namespace

Console::Console(const Options& options)
    : quiet_(options.quiet), colour_(wants_colour()), shows_progress_(wants_progress(options)) {}

Console::~Console() {
  clear_progress();
  if (warnings_ > kMostWarnings)
    line("warning: ", kYellow, fmt::format("{} more warnings", warnings_ - kMostWarnings));
}

void Console::clear_progress() {
  if (progress_.empty()) return;
  put(kClearLine);
  progress_.clear();
}

void Console::line(std::string_view label, std::string_view colour, std::string_view text) {
  const std::string progress = progress_;
  clear_progress();
  const bool coloured = colour_ && !colour.empty();
  put(fmt::format("verge: {}{}{}{}\n", coloured ? colour : "", label, coloured ? kPlain : "", text));
  if (!progress.empty()) put(progress);
  progress_ = progress;
}

void Console::error(const Error& error) {
  const std::scoped_lock lock(mutex_);
  line("error: ", kRed, to_string(error));
}

void Console::warning(std::string_view text) {
  const std::scoped_lock lock(mutex_);
  if (++warnings_ <= kMostWarnings) line("warning: ", kYellow, escape_control_bytes(text));
}

void Console::note(std::string_view text) {
  const std::scoped_lock lock(mutex_);
  if (quiet_ || ++notes_ > kMostNotes) return;
  line("", "", escape_control_bytes(text));
}

void Console::print(std::string_view lines) {
  const std::scoped_lock lock(mutex_);
  if (quiet_) return;
  clear_progress();
  put(lines);
}

void Console::progress(std::string_view text) {
  const std::scoped_lock lock(mutex_);
  if (!shows_progress_) return;
  progress_ = text;
  put(fmt::format("{}{}", kClearLine, text));
}

Log Console::log() {
  return [this](LogLevel level, std::string_view text) {
    if (level == LogLevel::kWarning) return warning(text);
    note(text);
  };
}

ExitCode print_data(std::string_view text) {
  auto out = AtomicFile::standard_output();
  Expected<void> done;
  if (!out) {
    done = Unexpected(out.error());
  } else if (done = out->write(text); done) {
    done = out->commit();
  }
  if (done) return ExitCode::kOk;
  const ExitCode code = exit_code_of(done.error().code);
  if (code != ExitCode::kOk) print_error(done.error());
  return code;
}

void print_error(const Error& error) { Console({.quiet = true}).error(error); }

}  // namespace verge::app
