// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "apps/verge/signals.hpp"

#include <cstdlib>
#include <ctime>

#include <pthread.h>

namespace verge::app {
namespace {

bool is_ignored(int signal) {
  struct sigaction action {};
  return ::sigaction(signal, nullptr, &action) == 0 && action.sa_handler == SIG_IGN;
}

}  // namespace

void ignore_write_signals() {
  (void)std::signal(SIGPIPE, SIG_IGN);
  (void)std::signal(SIGXFSZ, SIG_IGN);
}

Signals::Signals() {
  ::sigemptyset(&watched_);
  for (const int signal : {SIGINT, SIGTERM}) {
    if (!is_ignored(signal)) ::sigaddset(&watched_, signal);
  }
  ::pthread_sigmask(SIG_BLOCK, &watched_, &before_);
  waiter_ = std::jthread([this](const std::stop_token& done) { wait(done); });
}

Signals::~Signals() {
  waiter_.request_stop();
  waiter_.join();
  ::pthread_sigmask(SIG_SETMASK, &before_, nullptr);
}

void Signals::wait(const std::stop_token& done) {
  constexpr timespec kTick{0, 10'000'000};
  while (!done.stop_requested()) {
    const int signal = ::sigtimedwait(&watched_, nullptr, &kTick);
    if (signal <= 0) continue;
    if (stop_.load()) std::_Exit(128 + signal);
    signal_.store(signal);
    when_.store(std::chrono::steady_clock::now());
    stop_.store(true);
  }
}

ExitCode Signals::exit_code() const {
  return signal_.load() == SIGTERM ? ExitCode::kTerminated : ExitCode::kInterrupted;
}

std::optional<std::chrono::steady_clock::duration> Signals::since() const {
  if (!stop_.load()) return std::nullopt;
  return std::chrono::steady_clock::now() - when_.load();
}

}  // namespace verge::app
