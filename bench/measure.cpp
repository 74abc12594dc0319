// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/measure.hpp"

#include <limits>

#include <benchmark/benchmark.h>
#include <time.h>

#include "verge/core/statistics.hpp"

namespace verge::bench {

double thread_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

double seconds_of(const std::function<void()>& work) {
  const double begin = thread_seconds();
  work();
  return thread_seconds() - begin;
}

double typical(std::span<const double> seconds) {
  return median(seconds).value_or(std::numeric_limits<double>::quiet_NaN());
}

int run_benchmarks(int argc, char** argv, const std::function<void()>& add_all) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  add_all();
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}

}  // namespace verge::bench
