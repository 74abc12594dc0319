// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <mutex>
#include <string>
#include <string_view>

#include "apps/verge/exit_code.hpp"
#include "verge/core/error.hpp"
#include "verge/core/log.hpp"

namespace verge::app {

/// When the progress line shows.
enum class ProgressMode : std::uint8_t { kAuto, kAlways, kNever };

/// What goes to standard error: one line a message, and below them a progress line on a terminal. May be
/// called from several threads.
class Console {
 public:
  struct Options {
    bool quiet = false;  ///< Errors and warnings only.
    ProgressMode progress = ProgressMode::kAuto;
  };

  explicit Console(const Options& options);
  Console(const Console&) = delete;
  Console& operator=(const Console&) = delete;
  /// Takes the progress line away.
  ~Console();

  /// "verge: error: ...": exactly one line of at most 300 bytes.
  void error(const Error& error);
  /// Warnings beyond the twentieth are counted only; the destructor says how many.
  void warning(std::string_view text);
  /// Notes beyond the sixth are not shown: they say the same of every scan.
  void note(std::string_view text);
  /// Lines as they are (a table); nothing when quiet.
  void print(std::string_view lines);

  [[nodiscard]] bool shows_progress() const { return shows_progress_; }
  /// Replaces the progress line. Nothing where progress is not shown.
  void progress(std::string_view line);

  /// The library's messages.
  [[nodiscard]] Log log();

 private:
  void line(std::string_view label, std::string_view colour, std::string_view text);
  void clear_progress();

  bool quiet_;
  bool colour_;
  bool shows_progress_;
  std::mutex mutex_;
  std::string progress_;
  std::size_t notes_ = 0;
  std::size_t warnings_ = 0;
};

/// Data for whoever reads standard output. A reader that went away is no error.
[[nodiscard]] ExitCode print_data(std::string_view text);

/// The one line of an error, for where no Console stands yet.
void print_error(const Error& error);

}  // namespace verge::app
