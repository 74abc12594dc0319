// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "verge/core/error.hpp"
#include "verge/core/vec.hpp"
#include "verge/eval/labelled_truth.hpp"

namespace verge::eval {

/// The table truth.csv by frame (see frame_stem()): a header, then rows frame,side,x,y[,...] in metres. Fails
/// as io::Input does, and with kUnusable at the row that is none.
[[nodiscard]] Expected<std::map<std::string, std::vector<Vec2>>> read_kerb_table(
    const std::filesystem::path& path);

/// Kerb points as they are, joined to their neighbours; nothing is known of the rest of the scan.
[[nodiscard]] LabelledTruth truth_of_kerb_points(std::span<const Vec2> kerb);

/// The edges that two polygons of the file share, as segments and as points every 0.1 m. A line is a corner,
/// x y in millimetres; a blank line ends a polygon. Fails as io::Input does, and with kUnusable at the line
/// that is none of the two.
[[nodiscard]] Expected<LabelledTruth> read_kerb_polygons(const std::filesystem::path& path);

}  // namespace verge::eval
