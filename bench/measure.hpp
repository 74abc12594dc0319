// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <span>

namespace verge::bench {

/// Processor seconds of this thread alone, so that others on the machine disturb less. What is measured here
/// uses no second thread.
[[nodiscard]] double thread_seconds();

/// How long `work` takes, in seconds of thread_seconds().
[[nodiscard]] double seconds_of(const std::function<void()>& work);

/// The typical one of these times: their median, which a disturbed run does not move. None: not a number.
[[nodiscard]] double typical(std::span<const double> seconds);

/// A main() whose benchmarks `add_all` registers at run time; the exit code.
int run_benchmarks(int argc, char** argv, const std::function<void()>& add_all);

}  // namespace verge::bench
