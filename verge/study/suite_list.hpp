// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "verge/sim/noise.hpp"
#include "verge/study/suite.hpp"

// The suites, one file each; suites.cpp lists them.

namespace verge::study {

[[nodiscard]] Suite paper1_suite(const SuiteRequest& request);
[[nodiscard]] Suite paper1_coarse_suite(const SuiteRequest& request);
[[nodiscard]] Suite paper2_suite(const SuiteRequest& request);
[[nodiscard]] Suite paper2_real_suite(const SuiteRequest& request);
[[nodiscard]] Suite paper3_suite(const SuiteRequest& request);
[[nodiscard]] Suite paper3_real_suite(const SuiteRequest& request);
[[nodiscard]] Suite degradation_suite(const SuiteRequest& request);
[[nodiscard]] Suite corners_suite(const SuiteRequest& request);
[[nodiscard]] Suite real_suite(const SuiteRequest& request);
[[nodiscard]] Suite campus_suite(const SuiteRequest& request);

/// Scans of nuScenes HDL-32E for the report, from cells of these names.
[[nodiscard]] std::vector<RoadFigure> hdl32_figures(const std::string& straight, const std::string& junction);

/// A number of drive `drive`, uniform in [low, high); `which` tells several of a drive apart.
[[nodiscard]] inline double drawn(std::uint64_t drive, std::uint64_t which, double low, double high) {
  return low + (high - low) * sim::uniform({drive, 0, which}, sim::Draw::kScenario);
}

}  // namespace verge::study
