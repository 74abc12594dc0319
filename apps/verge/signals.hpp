// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <chrono>
#include <csignal>
#include <optional>
#include <thread>

#include "apps/verge/exit_code.hpp"

namespace verge::app {

/// A write to a pipe that nobody reads, or beyond the size limit, shall fail with an error, not end the
/// program. Call at the start of main().
void ignore_write_signals();

/// Ctrl-C and SIGTERM as a flag: the first one asks the work to stop, the second one ends the program at once
/// (targets of AtomicFile are then as before). Made before any other thread, since threads inherit the mask
/// that keeps these signals from them: a thread of its own waits for them, so that no code runs in a handler.
/// A signal that was ignored at the start (nohup, a background job) stays ignored.
class Signals {
 public:
  Signals();
  Signals(const Signals&) = delete;
  Signals& operator=(const Signals&) = delete;
  ~Signals();

  /// True from the first signal on.
  [[nodiscard]] const std::atomic<bool>& stop() const { return stop_; }

  /// The code to end with, once stopped.
  [[nodiscard]] ExitCode exit_code() const;

  /// How long ago the first signal came; none before it.
  [[nodiscard]] std::optional<std::chrono::steady_clock::duration> since() const;

 private:
  void wait(const std::stop_token& done);

  sigset_t watched_{};
  sigset_t before_{};
  std::atomic<bool> stop_{false};
  std::atomic<int> signal_{0};
  std::atomic<std::chrono::steady_clock::time_point> when_{};
  std::jthread waiter_;
};

}  // namespace verge::app
