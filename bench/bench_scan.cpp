// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0

// Speed of the scan room, on simulated scans and, where VERGE_DATA is set, on real ones.
//
// Every benchmark alternates with the floor (bench/floor.hpp) on the same points; the counter x_floor is the
// ratio of the two medians.
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <benchmark/benchmark.h>

#include "bench/floor.hpp"
#include "bench/measure.hpp"
#include "verge/scan/organise.hpp"
#include "verge/scan/test_clouds.hpp"

namespace verge::bench {
namespace {

// Times `work` on what `prepare` makes, outside the clock, in turn with the floor.
template <class Prepare, class Work>
void run_beside_floor(benchmark::State& state, const Cloud& cloud, const Prepare& prepare, const Work& work) {
  Floor floor;
  std::vector<double> ours;
  std::vector<double> floors;
  for ([[maybe_unused]] auto _ : state) {
    floors.push_back(seconds_of([&] { benchmark::DoNotOptimize(floor.run(cloud.x, cloud.y, cloud.z)); }));
    auto input = prepare();
    ours.push_back(seconds_of([&] { benchmark::DoNotOptimize(work(std::move(input))); }));
    state.SetIterationTime(ours.back());
  }
  const double median = typical(ours);
  state.counters["x_floor"] = median / typical(floors);
  state.counters["ns_a_point"] = 1e9 * median / static_cast<double>(cloud.x.size());
  state.counters["points"] = static_cast<double>(cloud.x.size());
}

void add(const std::string& name, const std::function<void(benchmark::State&)>& run) {
  benchmark::RegisterBenchmark(name.c_str(), run)->UseManualTime()->Unit(benchmark::kMillisecond);
}

void add_organise(const std::string& name, const Cloud& cloud, RingSource expected) {
  add(name, [cloud, expected](benchmark::State& state) {
    if (cloud.x.empty() || organise(cloud).source != expected) {
      state.SkipWithError("the rings do not come from where they should");
      return;
    }
    run_beside_floor(
        state, cloud, [&] { return cloud; }, [](Cloud&& input) { return organise(std::move(input)); });
  });
}

void add_deskew(const std::string& name, const Cloud& cloud) {
  Scan scan = organise(cloud).scan;
  scan.motion = Motion{.T_world_sensor_begin = {},
                       .T_world_sensor_end = {.rotation = from_yaw_pitch_roll(0.02, 0.001, 0.001),
                                              .translation = {1.67, 0.02, 0.0}}};
  add(name, [cloud, scan](benchmark::State& state) {
    if (!deskew(scan).deskewed) {
      state.SkipWithError("the scan cannot be deskewed");
      return;
    }
    run_beside_floor(
        state, cloud, [&] { return scan; }, [](Scan&& input) { return deskew(std::move(input)); });
  });
}

void add_floor(const std::string& name, const Cloud& cloud) {
  add(name, [cloud](benchmark::State& state) {
    Floor floor;
    run_beside_floor(
        state, cloud, [] { return 0; }, [&](int) { return floor.run(cloud.x, cloud.y, cloud.z).front(); });
  });
}

Cloud ringless(Cloud cloud) {
  cloud.ring.clear();
  return cloud;
}

// A cloud as KITTI's files have it: rings one after the other, no field.
void add_hdl64(const std::string& scan, const Cloud& cloud) {
  add_floor("floor/" + scan, cloud);
  add_organise("organise_by_order/" + scan, ringless(cloud), RingSource::kKittiOrder);
  add_organise("organise_shuffled/" + scan, ringless(testing::shuffled(cloud, 1)), RingSource::kElevation);
}

// A cloud as nuScenes' files have it: firing by firing, with a ring field.
void add_hdl32(const std::string& scan, const Cloud& cloud) {
  add_floor("floor/" + scan, cloud);
  add_organise("organise_by_field/" + scan, cloud, RingSource::kField);
  add_organise("organise_by_elevation/" + scan, ringless(cloud), RingSource::kElevation);
}

void add_all() {
  const Cloud simulated64 = testing::simulate(testing::plan(64, -24.8, 2.0, 1875));
  const Cloud simulated32 = testing::column_major(testing::simulate(testing::plan(32, -30.67, 10.67, 1085)));
  add_hdl64("simulated_64_rings", simulated64);
  add_deskew("deskew/simulated_64_rings", simulated64);
  add_hdl32("simulated_32_rings", simulated32);
  add_deskew("deskew/simulated_32_rings", simulated32);
  const auto data = testing::data_folder();
  if (!data) return;
  add_hdl64("semantickitti_000000",
            testing::read_kitti(*data / "semantickitti/sequences/00/velodyne/000000.bin"));
  add_hdl32("nuscenes_n015", testing::read_nuscenes(*data / "nuscenes-hdl32/raw/n015.pcd.bin"));
}

}  // namespace
}  // namespace verge::bench

int main(int argc, char** argv) { return verge::bench::run_benchmarks(argc, argv, &verge::bench::add_all); }
