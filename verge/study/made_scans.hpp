// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "verge/sim/drive.hpp"
#include "verge/study/suite.hpp"

// The scans of a suite's made drives.

namespace verge::study {

/// What a scan of a made drive is called: "670-frames-3-000045" is of cell "670 frames", drive 3, scan 45. By
/// these names predictions are found.
[[nodiscard]] std::string frame_of(const Cell& cell, std::uint64_t drive, std::uint64_t index);

/// All of a suite's made drives.
[[nodiscard]] std::vector<std::string> frames_of(const Suite& suite);

/// Scan `index` of the world of one of these drives: with what is lost of it and what methods are told, and
/// the truth of which that much is visible. Its frame is its index.
[[nodiscard]] sim::Simulated simulated_of(const MadeDrives& drives, const sim::Drive& world,
                                          std::uint64_t drive, std::uint64_t index);

}  // namespace verge::study
