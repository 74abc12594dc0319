// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0

// What the estimators of paper 2 take, on one thread: for a cluster of 60 points, as a kerb or a car has
// them, and for all 800 points of a four-layer scan at once. us_scan is the time for 800 points, in clusters
// of 60 or in one of 800; us_scan_at_3ns the same on a machine whose floor (bench/floor.hpp) takes 3 ns a
// point.
#include <cmath>
#include <cstddef>
#include <numbers>
#include <numeric>
#include <vector>

#include <benchmark/benchmark.h>

#include "bench/floor.hpp"
#include "bench/measure.hpp"
#include "verge/cluster/kmeans.hpp"
#include "verge/cluster/silhouette.hpp"
#include "verge/core/random.hpp"
#include "verge/core/statistics.hpp"
#include "verge/core/vec.hpp"
#include "verge/fit/line.hpp"
#include "verge/fit/polynomial.hpp"
#include "verge/fit/theil_sen.hpp"

namespace verge::bench {
namespace {

using Points = std::vector<Vec2>;

constexpr std::size_t kScan = 800;

/// Points along 20 m of a kerb, 5 cm of noise, every tenth on something 1 m behind it; in the order of a
/// scan.
Points kerb(std::size_t size, std::uint64_t seed) {
  RandomSequence random(seed);
  Points points;
  for (std::size_t i = 0; i < size; ++i) {
    const double x = 20.0 * (static_cast<double>(i) + random.uniform()) / static_cast<double>(size);
    const double behind = i % 10 == 0 ? 1.0 : 0.0;
    points.push_back({x, 3.0 + 0.2 * x + behind + 0.1 * (random.uniform() - 0.5)});
  }
  return points;
}

/// How long the floor takes a point, ns: over a dense scan, as its bins cost more than 800 points.
double floor_ns_a_point() {
  constexpr std::size_t kRings = 32;
  constexpr std::size_t kColumns = 2000;
  std::vector<float> x, y, z;
  for (std::size_t i = 0; i < kRings * kColumns; ++i) {
    const double azimuth = 2.0 * std::numbers::pi * static_cast<double>(i % kColumns) / kColumns;
    const double range = 3.0 + static_cast<double>(i / kColumns);
    x.push_back(static_cast<float>(range * std::cos(azimuth)));
    y.push_back(static_cast<float>(range * std::sin(azimuth)));
    z.push_back(static_cast<float>(0.01 * std::cos(7.0 * azimuth)));
  }
  Floor floor;
  std::vector<double> seconds;
  for (int i = 0; i < 8; ++i)
    seconds.push_back(seconds_of([&] { benchmark::DoNotOptimize(floor.run(x, y, z)); }));
  return 1e9 * typical(seconds) / static_cast<double>(x.size());
}

/// Different points in each run, so that the processor cannot learn one set's comparisons.
template <class Work>
void on_kerbs(benchmark::State& state, Work work) {
  const auto size = static_cast<std::size_t>(state.range(0));
  std::vector<Points> sets;
  for (std::uint64_t seed = 0; seed < 64; ++seed) sets.push_back(kerb(size, seed));
  const double floor_before = floor_ns_a_point();
  std::vector<double> ours;
  for ([[maybe_unused]] auto _ : state) {
    const Points& points = sets[ours.size() % sets.size()];
    ours.push_back(seconds_of([&] { benchmark::DoNotOptimize(work(points)); }));
    state.SetIterationTime(ours.back());
  }
  const double floor_ns = std::midpoint(floor_before, floor_ns_a_point());
  const double us = 1e6 * typical(ours);
  const double us_scan = us * static_cast<double>(kScan) / static_cast<double>(size);
  state.counters["us_p50"] = us;
  state.counters["us_scan"] = us_scan;
  state.counters["us_scan_at_3ns"] = us_scan * 3.0 / floor_ns;
}

void line_orthogonal(benchmark::State& state) {
  on_kerbs(state, [](const Points& points) { return fit::fit_line(points); });
}
void line_ordinary(benchmark::State& state) {
  on_kerbs(state, [](const Points& points) { return fit::fit_line_ordinary(points); });
}
void line_robust(benchmark::State& state) {
  on_kerbs(state, [](const Points& points) { return fit::fit_line_robust(points); });
}
void line_theil_sen(benchmark::State& state) {
  on_kerbs(state, [](const Points& points) { return fit::fit_line_theil_sen(points); });
}
void slopes_600_sampled(benchmark::State& state) {
  on_kerbs(state, [](const Points& points) { return median(fit::sampled_slopes(points, 600, 1)); });
}
void interval_sen(benchmark::State& state) {
  on_kerbs(state, [](const Points& points) { return fit::ci_sen(points); });
}
void interval_bootstrap(benchmark::State& state) {
  on_kerbs(state, [](const Points& points) { return fit::ci_bootstrap599(points, 1); });
}
void polynomial_degree_3(benchmark::State& state) {
  on_kerbs(state, [](const Points& points) { return fit::fit_polynomial(points, 3); });
}
void polynomial_to_tolerance(benchmark::State& state) {
  on_kerbs(state, [](const Points& points) { return fit::fit_polynomial_to(points); });
}
void polynomial_ridge_16(benchmark::State& state) {
  on_kerbs(state, [](const Points& points) {
    return fit::fit_polynomial_with(points, {.reading = fit::StatedError::kRidge});
  });
}
void kmeans_2(benchmark::State& state) {
  on_kerbs(state,
           [](const Points& points) { return cluster::kmeans(points, cluster::farthest_first(points, 2)); });
}
void kmeans_chosen_to_5(benchmark::State& state) {
  on_kerbs(state, [](const Points& points) { return cluster::choose_k(points, 5); });
}

constexpr int kCluster = 60;

BENCHMARK(line_orthogonal)->UseManualTime()->Arg(kCluster)->Arg(kScan);
BENCHMARK(line_ordinary)->UseManualTime()->Arg(kCluster)->Arg(kScan);
BENCHMARK(line_robust)->UseManualTime()->Arg(kCluster)->Arg(kScan);
BENCHMARK(line_theil_sen)->UseManualTime()->Arg(kCluster)->Arg(kScan);
BENCHMARK(slopes_600_sampled)->UseManualTime()->Arg(kCluster)->Arg(kScan);
BENCHMARK(interval_sen)->UseManualTime()->Arg(kCluster)->Arg(kScan);
BENCHMARK(interval_bootstrap)->UseManualTime()->Arg(kCluster)->Unit(benchmark::kMillisecond);
BENCHMARK(polynomial_degree_3)->UseManualTime()->Arg(kCluster)->Arg(kScan);
BENCHMARK(polynomial_to_tolerance)->UseManualTime()->Arg(kCluster)->Arg(kScan);
BENCHMARK(polynomial_ridge_16)->UseManualTime()->Arg(kCluster)->Arg(kScan);
BENCHMARK(kmeans_2)->UseManualTime()->Arg(kCluster)->Arg(kScan);
BENCHMARK(kmeans_chosen_to_5)->UseManualTime()->Arg(kCluster)->Arg(kScan);

}  // namespace
}  // namespace verge::bench

BENCHMARK_MAIN();
