// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0

// Speed of decoding: packets of one HDL-32E revolution to its cloud, beside the floor (bench/floor.hpp) over
// the same points; the counter x_floor is the ratio of the two medians.
#include <utility>
#include <vector>

#include <benchmark/benchmark.h>

#include "bench/floor.hpp"
#include "bench/measure.hpp"
#include "verge/sensor/velodyne/test_packets.hpp"

namespace verge::bench {
namespace {

namespace velodyne = sensor::velodyne;

// One drive, revolution by revolution: each time what comes until the next one is finished.
void decode_revolution(benchmark::State& state) {
  const auto packets = velodyne::testing::stream({.packets = 20'000});
  velodyne::RevolutionDecoder decoder;
  Floor floor;
  std::vector<double> ours;
  std::vector<double> floors;
  std::size_t next = 0;
  std::size_t points = 0;
  const auto revolution = [&] {
    while (next < packets.size()) {
      decoder.add(packets[next].bytes, packets[next].time_ns);
      ++next;
      if (auto finished = decoder.take()) return finished;
    }
    return decoder.take();
  };
  for ([[maybe_unused]] auto _ : state) {
    const double begin = thread_seconds();
    auto finished = revolution();
    const double took = thread_seconds() - begin;
    if (!finished) {  // the drive is over: again
      next = 0;
      decoder = velodyne::RevolutionDecoder();
      state.SetIterationTime(took);
      continue;
    }
    const Cloud& cloud = finished->cloud;
    points = cloud.x.size();
    const double floor_begin = thread_seconds();
    benchmark::DoNotOptimize(floor.run(cloud.x, cloud.y, cloud.z));
    floors.push_back(thread_seconds() - floor_begin);
    ours.push_back(took);
    state.SetIterationTime(took);
  }
  if (ours.empty()) return;
  state.counters["x_floor"] = typical(ours) / typical(floors);
  state.counters["ns_a_point"] = 1e9 * typical(ours) / static_cast<double>(points);
  state.counters["points"] = static_cast<double>(points);
}

BENCHMARK(decode_revolution)
    ->Name("decode/hdl32e_revolution")
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace verge::bench

BENCHMARK_MAIN();
