// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/sensor/velodyne/facts.hpp"

#include <algorithm>
#include <numeric>
#include <string>

namespace verge::sensor::velodyne {

const Facts& facts_of(Model model) {
  static const std::array<Facts, 6> all = {hdl32e_facts(),
                                           vlp16_facts(),
                                           vlp32c_facts(),
                                           hdl64e_facts(Model::kHdl64eS1),
                                           hdl64e_facts(Model::kHdl64eS2),
                                           hdl64e_facts(Model::kHdl64eS3)};
  return all[static_cast<std::size_t>(model)];
}

std::optional<Model> model_named(std::string_view name) {
  if (name == "hdl64e") return Model::kHdl64eS2;
  const auto& names = enum_names<Model>;
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) return std::nullopt;
  return static_cast<Model>(found - names.begin());
}

std::vector<std::int64_t> rings_of(const Calibration& calibration) {
  std::vector<std::size_t> by_elevation(calibration.size());
  std::iota(by_elevation.begin(), by_elevation.end(), 0U);
  std::stable_sort(by_elevation.begin(), by_elevation.end(), [&](std::size_t a, std::size_t b) {
    return calibration[a].elevation_rad < calibration[b].elevation_rad;
  });
  std::vector<std::int64_t> rings(by_elevation.size());
  for (std::size_t ring = 0; ring < rings.size(); ++ring) {
    rings[by_elevation[ring]] = static_cast<std::int64_t>(ring);
  }
  return rings;
}

namespace {

Laser shot_of(const Facts& facts, std::size_t laser, std::int64_t ring, std::int64_t step) {
  const LaserCorrection& aim = facts.calibration[laser];
  return {.elevation_rad = aim.elevation_rad,
          .time_ns = step * facts.step_ns + facts.slot_time_ns[laser % kSlotsPerBlock],
          .azimuth_rad = aim.azimuth_rad,
          .up_m = aim.up_m,
          .left_m = aim.left_m,
          .ring = static_cast<std::size_t>(ring)};
}

}  // namespace

BeamModel beam_model(const Facts& facts) {
  BeamModel model{.name = std::string(enum_names<Model>[static_cast<std::size_t>(facts.model)]),
                  .lasers = {},
                  .firing_period_ns = facts.step_ns,
                  .block_ns = facts.step_ns,
                  .rate_hz = 10.0,
                  .clockwise = true,
                  .range_min_m = facts.range_min_m,
                  .range_max_m = facts.range_max_m,
                  .range_resolution_m = facts.range_step_m};
  const std::vector<std::int64_t> rings = rings_of(facts.calibration);
  const auto add = [&](std::size_t from, std::size_t to, std::int64_t step) {
    for (std::size_t laser = from; laser < to; ++laser) {
      model.lasers.push_back(shot_of(facts, laser, rings[laser], step));
    }
  };
  if (facts.banks == 2 && !facts.banks_share_step) {  // a step of the lower bank after three of the upper one
    constexpr std::int64_t kUpperSteps = 3;
    for (std::int64_t step = 0; step < kUpperSteps; ++step) add(0, kSlotsPerBlock, step);
    add(kSlotsPerBlock, facts.lasers, kUpperSteps);
    model.firing_period_ns *= kUpperSteps + 1;
  } else {
    add(0, facts.lasers, 0);
    model.firing_period_ns /= static_cast<std::int64_t>(kSlotsPerBlock / facts.lasers_per_firing);
  }
  return model;
}

}  // namespace verge::sensor::velodyne
