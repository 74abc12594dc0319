// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0

// What straight lines in a scan of 800 points take on one thread: squares, edges, the Hough transform, peaks,
// segments, on scans of an ibeo LUX in paper 2's street (50 m ahead, 30 m to either side, pixels of 0.1 m,
// squares of 5 pixels). Each step's counter is its median, us_p50 the median of all of them together.
#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include <benchmark/benchmark.h>

#include "bench/measure.hpp"
#include "verge/core/statistics.hpp"
#include "verge/raster/edges.hpp"
#include "verge/raster/hough.hpp"
#include "verge/raster/hough_peaks.hpp"
#include "verge/raster/hough_segments.hpp"
#include "verge/raster/squares.hpp"
#include "verge/sim/drive.hpp"
#include "verge/sim/ready.hpp"
#include "verge/sim/sensors.hpp"

namespace verge::bench {
namespace {

constexpr std::size_t kScans = 20;
constexpr std::size_t kPoints = 800;  // "about 800" in one cycle (paper 2, I-B)

/// 800 of the scan's points within 50 m, evenly chosen.
std::vector<Vec2> points_of(const Scan& scan) {
  std::vector<Vec2> all;
  for (std::size_t i = 0; i < scan.x.size(); ++i) {
    if (scan.range[i] > 0.0F && scan.range[i] < 50.0F) all.push_back({scan.x[i], scan.y[i]});
  }
  std::vector<Vec2> chosen;
  for (std::size_t i = 0; i < kPoints && !all.empty(); ++i) chosen.push_back(all[i * all.size() / kPoints]);
  return chosen;
}

std::vector<std::vector<Vec2>> lux_scans() {
  const sim::Drive drive({.scenario = sim::ready_scenario("paper2"),
                          .sensor = sim::sensor_named("lux"),
                          .noise = {.seed = 1, .range_sigma_m = 0.03}});
  std::vector<std::vector<Vec2>> scans;
  for (std::size_t i = 0; i < kScans; ++i) scans.push_back(points_of(drive.scan(5 * i).scan));
  return scans;
}

constexpr std::array<std::string_view, 5> kSteps = {"squares_us", "edges_us", "hough_us", "peaks_us",
                                                    "segments_us"};

/// The seconds of each step, and of them together.
class Chain {
 public:
  explicit Chain(raster::EdgeFilter filter) : edges_{.filter = filter} {}

  double run(const std::vector<Vec2>& points) {
    raster::Picture squares;
    raster::Picture edges;
    raster::Accumulator accumulator;
    std::vector<raster::HoughPeak> peaks;
    const std::array seconds = {
        seconds_of([&] { squares = raster::mark_squares(points, grid_); }),
        seconds_of([&] { edges = raster::find_edges(squares, edges_); }),
        seconds_of([&] { accumulator = hough_(edges); }),
        seconds_of([&] { peaks = raster::hough_peaks(accumulator); }),
        seconds_of([&] { benchmark::DoNotOptimize(raster::hough_segments(edges, grid_, peaks)); })};
    double sum = 0.0;
    for (std::size_t step = 0; step < seconds.size(); ++step) {
      steps_.at(step).push_back(seconds.at(step));
      sum += seconds.at(step);
    }
    all_.push_back(sum);
    marked_.push_back(
        static_cast<double>(std::ranges::count_if(edges.grey, [](auto grey) { return grey != 0; })));
    return sum;
  }

  void tell(benchmark::State& state) const {
    for (std::size_t step = 0; step < kSteps.size(); ++step) {
      state.counters[std::string(kSteps.at(step))] = 1e6 * typical(steps_.at(step));
    }
    state.counters["us_p50"] = 1e6 * typical(all_);
    state.counters["us_p99"] = 1e6 * percentile(all_, 99.0).value_or(0.0);
    state.counters["marked"] = typical(marked_);
  }

 private:
  raster::Grid grid_ = raster::grid_over({0.0, -30.0}, {50.0, 30.0});
  raster::EdgeOptions edges_;
  raster::HoughTransform hough_;
  std::array<std::vector<double>, kSteps.size()> steps_;
  std::vector<double> all_;
  std::vector<double> marked_;
};

void lines(benchmark::State& state, raster::EdgeFilter filter) {
  const std::vector<std::vector<Vec2>> scans = lux_scans();
  Chain chain(filter);
  for ([[maybe_unused]] auto _ : state) {
    double sum = 0.0;
    for (const std::vector<Vec2>& points : scans) sum += chain.run(points);
    state.SetIterationTime(sum);
  }
  chain.tell(state);
}

BENCHMARK_CAPTURE(lines, none, raster::EdgeFilter::kNone)->UseManualTime()->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(lines, canny, raster::EdgeFilter::kCanny)->UseManualTime()->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace verge::bench

BENCHMARK_MAIN();
