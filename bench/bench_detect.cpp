// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0

// What a method takes for a scan, on one thread: the readings of road_width on a drive of an ALASCA XT past
// side roads, driveways and parked cars (paper 1's, 200 scans at 30 km/h). Beside it the floor
// (bench/floor.hpp) over the same points. us_800_at_3ns is the median for 800 points on a machine whose floor
// takes 3 ns a point.
#include <array>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include "bench/floor.hpp"
#include "bench/measure.hpp"
#include "verge/core/statistics.hpp"
#include "verge/detect/registry.hpp"
#include "verge/sim/drive.hpp"
#include "verge/sim/ready.hpp"
#include "verge/sim/sensors.hpp"

namespace verge::bench {
namespace {

constexpr std::size_t kScans = 200;

std::vector<Scan> alasca_drive() {
  const sim::Drive drive({.scenario = sim::ready_scenario("paper1-r3-v30"),
                          .sensor = sim::sensor_named("alasca_xt"),
                          .noise = {.seed = 1, .range_sigma_m = 0.03}});
  std::vector<Scan> scans;
  for (std::size_t i = 0; i < kScans; ++i) {
    sim::Simulated simulated = drive.scan(60 + i);  // from before the first side road to behind the driveway
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

void road_width(benchmark::State& state, const std::string& reading) {
  const std::vector<Scan> scans = alasca_drive();
  const Cloud all = cloud_of(scans);
  Floor floor;
  std::vector<double> ours;
  std::vector<double> floors;
  for ([[maybe_unused]] auto _ : state) {
    const auto detector = detect::make("road_width", {{"reading", reading}});
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

BENCHMARK_CAPTURE(road_width, combined, std::string("combined"))
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(road_width, fixed, std::string("fixed"))->UseManualTime()->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(road_width, paper, std::string("paper"))->UseManualTime()->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace verge::bench

BENCHMARK_MAIN();
