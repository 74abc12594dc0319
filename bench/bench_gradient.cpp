// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0

// What gradient takes for a revolution of an HDL-32E, step by step, on one thread: 20 scans of paper 3's
// drives, and what lies around them. x_floor is the median over that of the floor (bench/floor.hpp) on the
// same points.
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include "bench/floor.hpp"
#include "bench/measure.hpp"
#include "verge/core/statistics.hpp"
#include "verge/detect/gradient/boundaries.hpp"
#include "verge/detect/gradient/denoise.hpp"
#include "verge/detect/gradient/scan_lines.hpp"
#include "verge/scan/mount.hpp"
#include "verge/sim/drive.hpp"
#include "verge/sim/ready.hpp"
#include "verge/sim/sensors.hpp"

namespace verge::bench {
namespace {

using namespace detect::gradient;  // NOLINT(google-build-using-namespace): the method's own steps
const detect::GradientConfig kConfig;

/// A scan, and what each step has from the one before.
struct Revolution {
  Scan scan;
  LevelFrame frame;
  std::vector<LowRing> low;
  Obstacles obstacles;
  std::vector<ScanLine> lines;
  std::vector<Strand> strands;
};

Revolution revolution_of(Scan scan) {
  const LevelFrame frame(*scan.mount);
  auto low = height_gate(scan, frame, kConfig);
  const Obstacles obstacles(low, kConfig);
  auto lines = scan_lines(low, obstacles, kConfig);
  auto strands = denoise(lines, scan.mount->height_m, kConfig);
  return {std::move(scan), frame, std::move(low), obstacles, std::move(lines), std::move(strands)};
}

std::vector<Revolution> revolutions_on(const char* scenario) {
  constexpr std::size_t kScans = 10;
  std::vector<Revolution> all;
  const sim::Drive drive({.scenario = sim::ready_scenario(scenario),
                          .sensor = sim::sensor_named("hdl32e"),
                          .noise = {.seed = 1, .range_sigma_m = 0.02}});
  for (std::size_t i = 0; i < kScans; ++i) {
    sim::Simulated simulated = drive.scan(i);
    Scan scan = deskew(std::move(simulated.scan));
    scan.mount = simulated.mount;
    all.push_back(revolution_of(std::move(scan)));
  }
  return all;
}

using Revolutions = std::function<const std::vector<Revolution>&()>;

/// Made when they are first asked for.
const std::vector<Revolution>& straight_road() {
  static const std::vector<Revolution> all = revolutions_on("paper3-13m-straight");
  return all;
}

const std::vector<Revolution>& curved_road() {
  static const std::vector<Revolution> all = revolutions_on("paper3-6m-curved");
  return all;
}

const std::vector<Revolution>& both_roads() {
  static const std::vector<Revolution> all = [] {
    std::vector<Revolution> both = straight_road();
    both.insert(both.end(), curved_road().begin(), curved_road().end());
    return both;
  }();
  return all;
}

using Step = std::function<void(const Revolution&)>;

void measure(benchmark::State& state, const std::vector<Revolution>& all, const Step& step) {
  Floor floor;
  std::vector<double> ours;
  std::vector<double> floors;
  double points = 0.0;
  for (const Revolution& one : all)
    points += static_cast<double>(one.scan.size()) / static_cast<double>(all.size());
  for ([[maybe_unused]] auto _ : state) {
    double sum = 0.0;
    for (const Revolution& one : all) {
      ours.push_back(seconds_of([&] { step(one); }));
      floors.push_back(
          seconds_of([&] { benchmark::DoNotOptimize(floor.run(one.scan.x, one.scan.y, one.scan.z)); }));
      sum += ours.back();
    }
    state.SetIterationTime(sum);
  }
  state.counters["points"] = points;
  state.counters["us_p50"] = 1e6 * typical(ours);
  state.counters["us_p99"] = 1e6 * percentile(ours, 99.0).value_or(0.0);
  state.counters["x_floor"] = typical(ours) / typical(floors);
  state.counters["floor_ns_a_point"] = 1e9 * typical(floors) / points;
}

void add(const char* name, const Step& step, const Revolutions& revolutions = both_roads) {
  benchmark::RegisterBenchmark(name, [=](benchmark::State& state) { measure(state, revolutions(), step); })
      ->UseManualTime()
      ->Unit(benchmark::kMillisecond);
}

template <class Result>
Step all_lines(Result result) {
  return [=](const Revolution& one) {
    for (const ScanLine& line : one.lines) benchmark::DoNotOptimize(result(one, line));
  };
}

void add_all() {
  add("mount, where it is not given",
      [](const Revolution& one) { benchmark::DoNotOptimize(estimate_mount(one.scan)); });
  add("II-1 (1) height gate",
      [](const Revolution& one) { benchmark::DoNotOptimize(height_gate(one.scan, one.frame, kConfig)); });
  add("obstacles", [](const Revolution& one) {
    benchmark::DoNotOptimize(Obstacles(one.low, kConfig).stand_above({}, {}));
  });
  add("II-1 (2), (3) scan lines along the road",
      [](const Revolution& one) { benchmark::DoNotOptimize(scan_lines(one.low, one.obstacles, kConfig)); });
  add("of these: II-1 (2) gradient", all_lines([](const Revolution&, const ScanLine& line) {
        return gradient_points(line.layer, kConfig);
      }));
  add("of these: II-1 (3) K, clusters", all_lines([](const Revolution&, const ScanLine& line) {
        return cluster_layer(line.layer, line.points, kConfig);
      }));
  add("of these: boundary points", all_lines([](const Revolution& one, const ScanLine& line) {
        return first_outward(line.layer, line.points, line.clusters, one.obstacles, kConfig);
      }));
  add("II-1 (3) adjacent layers", [](const Revolution& one) {
    benchmark::DoNotOptimize(denoise(one.lines, one.scan.mount->height_m, kConfig));
  });
  add("III line or B-spline",
      [](const Revolution& one) { benchmark::DoNotOptimize(fit_boundaries(one.strands, kConfig)); });
  const Step all_steps = [](const Revolution& one) {
    benchmark::DoNotOptimize(detect::Gradient(kConfig).process(one.scan, nullptr));
  };
  add("gradient, all steps", all_steps);
  add("gradient, all steps, straight road", all_steps, straight_road);  // lines alone
  add("gradient, all steps, curved road", all_steps, curved_road);      // B-splines alone
}

}  // namespace
}  // namespace verge::bench

int main(int argc, char** argv) { return verge::bench::run_benchmarks(argc, argv, &verge::bench::add_all); }
