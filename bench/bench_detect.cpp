// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0

// What a method takes for a scan, on one thread: the readings of road_width on a drive of an ALASCA XT past
// side roads, driveways and parked cars (paper 1's, 200 scans at 30 km/h), and line_fit with its estimators
// on a LUX between parked cars (paper 2's, 200 scans). Beside it the floor (bench/floor.hpp) over the same
// points. us_800_at_3ns is the median for 800 points on a machine whose floor takes 3 ns a point.
#include <cstddef>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include "bench/floor.hpp"
#include "bench/measure.hpp"
#include "verge/core/statistics.hpp"
#include "verge/sim/drive.hpp"
#include "verge/sim/ready.hpp"
#include "verge/sim/sensors.hpp"
#include "verge/study/contestant.hpp"

namespace verge::bench {
namespace {

constexpr std::size_t kScans = 200;

/// A drive of which scans count from the `first` on.
struct Drive {
  std::string scenario;
  std::string sensor;
  std::size_t first = 0;
};
const Drive kCorners{"paper1-r3-v30", "alasca_xt",
                     60};  // from before the first side road to behind the driveway
const Drive kStreet{"paper2", "lux", 0};

std::vector<Scan> scans_of(const Drive& which) {
  const sim::Drive drive({.scenario = sim::ready_scenario(which.scenario),
                          .sensor = sim::sensor_named(which.sensor),
                          .noise = {.seed = 1, .range_sigma_m = 0.03}});
  std::vector<Scan> scans;
  for (std::size_t i = 0; i < kScans; ++i) {
    sim::Simulated simulated = drive.scan(which.first + i);
    scans.push_back(deskew(std::move(simulated.scan)));
    scans.back().mount = simulated.mount;
  }
  return scans;
}

/// All points of the drive as one cloud: the floor's bins cost more than a single scan of so few points.
struct Cloud {
  std::vector<float> x, y, z;
};

Cloud cloud_of(const std::vector<Scan>& scans) {
  Cloud all;
  for (const Scan& scan : scans) {
    all.x.insert(all.x.end(), scan.x.begin(), scan.x.end());
    all.y.insert(all.y.end(), scan.y.begin(), scan.y.end());
    all.z.insert(all.z.end(), scan.z.begin(), scan.z.end());
  }
  return all;
}

void method(benchmark::State& state, const study::Contestant& contestant, const Drive& drive) {
  const std::vector<Scan> scans = scans_of(drive);
  const Cloud all = cloud_of(scans);
  Floor floor;
  std::vector<double> ours;
  std::vector<double> floors;
  for ([[maybe_unused]] auto _ : state) {
    const auto detector = study::detector_of(contestant);
    double sum = 0.0;
    for (const Scan& scan : scans) {
      ours.push_back(seconds_of([&] { benchmark::DoNotOptimize(detector->process(scan, nullptr)); }));
      sum += ours.back();
    }
    floors.push_back(seconds_of([&] { benchmark::DoNotOptimize(floor.run(all.x, all.y, all.z)); }));
    state.SetIterationTime(sum);
  }
  const double points = static_cast<double>(all.x.size()) / static_cast<double>(scans.size());
  const double ns_a_point = 1e9 * typical(floors) / static_cast<double>(all.x.size());
  state.counters["points"] = points;
  state.counters["us_p50"] = 1e6 * typical(ours);
  state.counters["us_p99"] = 1e6 * percentile(ours, 99.0).value_or(0.0);
  state.counters["x_floor"] = 1e9 * typical(ours) / points / ns_a_point;
  state.counters["us_800_at_3ns"] = 1e6 * typical(ours) * 800.0 / points * 3.0 / ns_a_point;
}

void add(const std::vector<std::string>& methods, const Drive& drive) {
  for (const std::string& text : methods) {
    benchmark::RegisterBenchmark(
        text.c_str(), [=](benchmark::State& state) { method(state, study::contestant_of(text), drive); })
        ->UseManualTime()
        ->Unit(benchmark::kMillisecond);
  }
}

void add_all() {
  add({"road_width", "road_width:reading=fixed", "road_width:reading=paper"}, kCorners);
  add({"line_fit", "line_fit:estimator=least_squares", "line_fit:estimator=polynomial",
       "line_fit:estimator=theil_sen", "line_fit:estimator=hough", "line_fit:grouping=clusters",
       "line_fit:grouping=kmeans", "line_fit:grouping=none,estimator=hough",
       "line_fit:reading=paper,estimator=hough"},
      kStreet);
}

}  // namespace
}  // namespace verge::bench

int main(int argc, char** argv) { return verge::bench::run_benchmarks(argc, argv, &verge::bench::add_all); }
