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

BeamModel beam_model(const Facts& facts) {
  BeamModel model{.name = std::string(enum_names<Model>[static_cast<std::size_t>(facts.model)]),
                  .lasers = {},
                  .firing_period_ns = facts.step_ns,
                  .rate_hz = 10.0,
                  .clockwise = true,
                  .range_min_m = facts.range_min_m,
                  .range_max_m = facts.range_max_m,
                  .range_resolution_m = facts.range_step_m};
  const std::size_t firings_per_block = kSlotsPerBlock / facts.lasers_per_firing;
  model.firing_period_ns /= static_cast<std::int64_t>(firings_per_block);
  for (std::size_t laser = 0; laser < facts.lasers; ++laser) {
    model.lasers.push_back(
        {facts.calibration[laser].elevation_rad, facts.slot_time_ns[laser % kSlotsPerBlock]});
  }
  return model;
}

}  // namespace verge::sensor::velodyne
