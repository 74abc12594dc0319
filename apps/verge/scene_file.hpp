// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "verge/core/error.hpp"
#include "verge/model/scene.hpp"

namespace verge::app {

/// Longest line of a file of Scenes; a Scene of ours takes about a thousandth of it.
inline constexpr std::size_t kSceneLineMax = std::size_t{64} << 20U;

/// All Scenes of a file of JSON lines ("-" is standard input); empty lines are skipped. Fails with
/// kCannotOpen, kUnusable and the place of what is no Scene, kLimit for a line longer than kSceneLineMax
/// bytes.
[[nodiscard]] Expected<std::vector<Scene>> read_scenes(const std::filesystem::path& file);

}  // namespace verge::app
