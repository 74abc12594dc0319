// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/emit/jsonl_writer.hpp"

#include <utility>

#include "verge/emit/scene_json.hpp"

namespace verge::emit {

Expected<AtomicFile> open_output(const std::filesystem::path& target) {
  return target == "-" ? AtomicFile::standard_output() : AtomicFile::create(target);
}

Expected<SceneWriter> SceneWriter::open(const std::filesystem::path& target) {
  return open_output(target).map([](AtomicFile&& file) { return SceneWriter(std::move(file)); });
}

Expected<void> SceneWriter::write(const Scene& scene) {
  return file_.write(to_json_line(scene) + '\n').and_then([this] { return file_.flush(); });
}

Expected<void> SceneWriter::finish() { return file_.commit(); }

}  // namespace verge::emit
