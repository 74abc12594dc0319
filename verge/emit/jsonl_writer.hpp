// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <utility>

#include "verge/core/atomic_file.hpp"
#include "verge/core/error.hpp"
#include "verge/model/scene.hpp"

namespace verge::emit {

/// The output that a command line names: "-" is standard output, anything else a file that appears whole or
/// not at all (or a device or FIFO, written directly). Fails with kCannotWrite.
[[nodiscard]] Expected<AtomicFile> open_output(const std::filesystem::path& target);

/// Scenes as JSON lines, one a scan (see scene_json.hpp). A file appears with finish(); standard output, a
/// pipe or a device gets each line at once.
///
/// Errors: kCannotWrite; kReaderGone where the other end of a pipe has closed, which only a program that
/// ignores SIGPIPE lives to see. After an error every further call fails likewise, and without a good
/// finish() no file is left.
class SceneWriter {
 public:
  [[nodiscard]] static Expected<SceneWriter> open(const std::filesystem::path& target);

  [[nodiscard]] Expected<void> write(const Scene& scene);

  /// Call once, after the last scene.
  [[nodiscard]] Expected<void> finish();

 private:
  explicit SceneWriter(AtomicFile file) : file_(std::move(file)) {}
  AtomicFile file_;
};

}  // namespace verge::emit
