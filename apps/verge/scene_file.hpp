// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "verge/core/error.hpp"
#include "verge/model/scene.hpp"

namespace verge::app {

/// Longest line of a file of Scenes; a Scene of ours takes about a thousandth of it.
inline constexpr std::size_t kSceneLineMax = std::size_t{64} << 20U;

/// The Scenes of a file in its order, and found by frame. Frames are named without folder and without the
/// suffix of a scan's file (eval::frame_stem), so that "a/000123.pcd.bin" is 000123.
struct SceneFile {
  std::vector<Scene> scenes;
  std::map<std::string, std::size_t, std::less<>> by_frame;

  /// Null where the frame does not occur.
  [[nodiscard]] const Scene* find(std::string_view frame) const;
};

/// All Scenes of a file of JSON lines ("-" is standard input); empty lines are skipped. Fails with
/// kCannotOpen, kUnusable and the place of what is no Scene or of a frame that stands there before, kLimit
/// for a line longer than kSceneLineMax bytes.
[[nodiscard]] Expected<SceneFile> read_scenes(const std::filesystem::path& file);

/// Why nothing can be compared: none of the frames that are known is predicted.
[[nodiscard]] Error no_frame_matches(const std::string& file, const SceneFile& predictions,
                                     std::span<const std::string> known);

}  // namespace verge::app
