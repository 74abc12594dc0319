// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0

// Speed of ray casting: 64 x 1800 rays of a scanner 1.9 m above a rough crossing of about 100,000 triangles,
// on one thread, beside the floor (bench/floor.hpp) over the points that are hit. The counter Mrays_at_3ns is
// the rate on a machine whose floor takes 3 ns a point; x_floor the ratio of the times of a ray and of a
// point.
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include <benchmark/benchmark.h>

#include "bench/floor.hpp"
#include "bench/measure.hpp"
#include "verge/core/angle.hpp"
#include "verge/sim/caster.hpp"
#include "verge/sim/land.hpp"
#include "verge/sim/ready.hpp"

namespace verge::bench {
namespace {

constexpr std::size_t kRings = 64;
constexpr std::size_t kColumns = 1800;

sim::World crossing() {
  sim::Scenario scenario = sim::ready_scenario("crossing");
  scenario.ground.roughness_m = 0.01;
  scenario.ground.roughness_length_m = 1.25;
  return sim::Land(scenario.roads, scenario.ground).mesh();
}

// In the order in which a scanner fires: column by column.
std::vector<sim::Ray> rays() {
  std::vector<sim::Ray> rays;
  for (std::size_t column = 0; column < kColumns; ++column) {
    const double azimuth = 2.0 * std::numbers::pi * static_cast<double>(column) / kColumns;
    for (std::size_t ring = 0; ring < kRings; ++ring) {
      const double elevation = deg_to_rad(-24.8 + 26.8 * static_cast<double>(ring) / (kRings - 1));
      const double level = std::cos(elevation);
      rays.push_back(
          {{70.0, 0.0, 1.9}, {level * std::cos(azimuth), level * std::sin(azimuth), std::sin(elevation)}});
    }
  }
  return rays;
}

struct Points {
  std::vector<float> x, y, z;
};

Points points_of(const std::vector<sim::Ray>& rays, const std::vector<std::optional<sim::Hit>>& hits) {
  Points points;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const Vec3 p = (hits[i] ? hits[i]->distance_m : 0.0) * rays[i].direction;
    points.x.push_back(static_cast<float>(p.x));
    points.y.push_back(static_cast<float>(p.y));
    points.z.push_back(static_cast<float>(p.z));
  }
  return points;
}

void cast_crossing(benchmark::State& state) {
  sim::World world = crossing();
  const auto triangles = static_cast<double>(world.triangles.size());
  const sim::Caster caster(std::move(world));
  const std::vector<sim::Ray> all = rays();
  std::vector<std::optional<sim::Hit>> hits(all.size());
  caster.cast(all, hits);
  const Points points = points_of(all, hits);
  Floor floor;
  std::vector<double> ours;
  std::vector<double> floors;
  for ([[maybe_unused]] auto _ : state) {
    const double begin = thread_seconds();
    caster.cast(all, hits);
    benchmark::DoNotOptimize(hits.data());
    ours.push_back(thread_seconds() - begin);
    const double floor_begin = thread_seconds();
    benchmark::DoNotOptimize(floor.run(points.x, points.y, points.z));
    floors.push_back(thread_seconds() - floor_begin);
    state.SetIterationTime(ours.back());
  }
  const double count = static_cast<double>(all.size());
  const double ns_a_ray = 1e9 * typical(ours) / count;
  const double ns_a_point = 1e9 * typical(floors) / count;
  state.counters["triangles"] = triangles;
  state.counters["ns_a_ray"] = ns_a_ray;
  state.counters["x_floor"] = ns_a_ray / ns_a_point;
  state.counters["Mrays_at_3ns"] = 1e3 / (ns_a_ray * 3.0 / ns_a_point);
}

BENCHMARK(cast_crossing)->Name("cast/64x1800_crossing")->UseManualTime()->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace verge::bench

BENCHMARK_MAIN();
