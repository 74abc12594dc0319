// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "apps/verge/scene_file.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <ios>
#include <iostream>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "verge/emit/scene_json.hpp"
#include "verge/eval/labelled_set.hpp"

namespace verge::app {
namespace {

Error error_of(ErrorCode code, const std::filesystem::path& file, std::string what) {
  return {code, file.string(), {}, std::move(what), {}, {}};
}

/// Takes a file's bytes in pieces and makes Scenes of its lines.
class SceneLines {
 public:
  explicit SceneLines(std::filesystem::path file) : file_(std::move(file)) {}

  [[nodiscard]] Expected<void> take(std::string_view bytes) {
    while (true) {
      const std::size_t end = bytes.find('\n');
      pending_ += bytes.substr(0, end);
      if (pending_.size() > kSceneLineMax) return Unexpected(too_long());
      if (end == std::string_view::npos) return {};
      if (auto ended = end_line(); !ended) return ended;
      bytes.remove_prefix(end + 1);
    }
  }

  [[nodiscard]] Expected<SceneFile> finish() {
    if (auto ended = end_line(); !ended) return Unexpected(std::move(ended).error());
    return std::move(file_of_scenes_);
  }

 private:
  [[nodiscard]] Error too_long() const {
    Error error = error_of(ErrorCode::kLimit, file_, "a line is too long");
    error.where = fmt::format("{}:1", line_number_);
    error.need = fmt::format("<= {} B", kSceneLineMax);
    return error;
  }

  [[nodiscard]] Expected<void> end_line() {
    const std::string line = std::exchange(pending_, {});
    const std::size_t number = line_number_++;
    if (line.find_first_not_of(" \t\r") == std::string::npos) return {};
    auto scene = emit::parse_scene(line, number);
    if (!scene) {
      Error error = std::move(scene).error();
      error.file = file_.string();
      return Unexpected(std::move(error));
    }
    return keep(*std::move(scene), number);
  }

  [[nodiscard]] Expected<void> keep(Scene scene, std::size_t line_number) {
    scene.frame = eval::frame_stem(scene.frame);
    std::vector<Scene>& scenes = file_of_scenes_.scenes;
    if (!file_of_scenes_.by_frame.emplace(scene.frame, scenes.size()).second) {
      Error error = error_of(ErrorCode::kUnusable, file_, "a frame stands twice");
      error.where = fmt::format("{}:1", line_number);
      error.got = scene.frame;
      return Unexpected(std::move(error));
    }
    scenes.push_back(std::move(scene));
    return {};
  }

  std::filesystem::path file_;
  std::string pending_;
  std::size_t line_number_ = 1;
  SceneFile file_of_scenes_;
};

Expected<SceneFile> read_stream(std::istream& in, const std::filesystem::path& file) {
  SceneLines lines(file);
  std::array<char, 1U << 16U> buffer{};
  while (in) {
    in.read(buffer.data(), static_cast<std::streamsize>(buffer.size()));
    const auto count = static_cast<std::size_t>(in.gcount());
    if (auto taken = lines.take({buffer.data(), count}); !taken) return Unexpected(std::move(taken).error());
  }
  if (in.bad()) return Unexpected(error_of(ErrorCode::kCannotOpen, file, "cannot be read"));
  return lines.finish();
}

/// The first frames, in order of their names.
std::string some_of(std::vector<std::string> frames) {
  constexpr std::size_t kMost = 3;
  std::sort(frames.begin(), frames.end());
  if (frames.size() > kMost) frames.resize(kMost);
  return frames.empty() ? "none" : fmt::format("{}", fmt::join(frames, ", "));
}

}  // namespace

const Scene* SceneFile::find(std::string_view frame) const {
  const auto found = by_frame.find(frame);
  return found == by_frame.end() ? nullptr : &scenes[found->second];
}

Error no_frame_matches(const std::string& file, const SceneFile& predictions,
                       std::span<const std::string> known) {
  std::vector<std::string> predicted;
  for (const Scene& scene : predictions.scenes) predicted.push_back(scene.frame);
  Error error = error_of(ErrorCode::kUnusable, file, "no frame matches");
  error.got = some_of(std::move(predicted));
  error.need = some_of({known.begin(), known.end()});
  return error;
}

Expected<SceneFile> read_scenes(const std::filesystem::path& file) {
  if (file == "-") return read_stream(std::cin, file);
  std::error_code ignored;
  if (std::filesystem::is_directory(file, ignored)) {
    return Unexpected(error_of(ErrorCode::kCannotOpen, file, "is a folder"));
  }
  std::ifstream opened(file, std::ios::binary);
  if (!opened) return Unexpected(error_of(ErrorCode::kCannotOpen, file, std::strerror(errno)));
  return read_stream(opened, file);
}

}  // namespace verge::app
