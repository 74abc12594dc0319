// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "verge/study/suite.hpp"

namespace verge::study {

/// What a value of a condition does to a drive.
using Change = std::function<void(sim::DriveConfig&, double value)>;

/// Deviation of the ranges, and height of the first road's kerbs, metres.
void set_noise(sim::DriveConfig& config, double value);
void set_kerb(sim::DriveConfig& config, double value);

/// A cell a value: the usual drives, changed. Named by condition and value.
void add_condition(std::vector<Cell>& cells, const std::string& condition, const std::vector<double>& values,
                   const MadeDrives& usual, const Change& change);

/// A cell a share of returns that go missing: "returns lost, share".
void add_losses(std::vector<Cell>& cells, const std::vector<double>& shares, const MadeDrives& usual);

}  // namespace verge::study
