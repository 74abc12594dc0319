// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "apps/verge/scene_file.hpp"

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/core.h>

#include "verge/emit/scene_json.hpp"

namespace verge::app {
namespace {

struct CloseFile {
  void operator()(std::FILE* file) const {
    if (file != stdin) (void)std::fclose(file);
  }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

Error error_of(ErrorCode code, const std::filesystem::path& file, std::string what) {
  return {code, file.string(), {}, std::move(what), {}, {}};
}

/// Takes a file's bytes in pieces and makes Scenes of its lines.
class SceneLines {
 public:
  explicit SceneLines(const std::filesystem::path& file) : file_(file) {}

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

  [[nodiscard]] Expected<std::vector<Scene>> finish() {
    if (auto ended = end_line(); !ended) return Unexpected(std::move(ended).error());
    return std::move(scenes_);
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
    scenes_.push_back(*std::move(scene));
    return {};
  }

  std::filesystem::path file_;
  std::string pending_;
  std::size_t line_number_ = 1;
  std::vector<Scene> scenes_;
};

Expected<File> open_file(const std::filesystem::path& file) {
  if (file == "-") return File(stdin);
  std::error_code ignored;
  if (std::filesystem::is_directory(file, ignored)) {
    return Unexpected(error_of(ErrorCode::kCannotOpen, file, "is a folder"));
  }
  File opened(std::fopen(file.c_str(), "rb"));
  if (!opened) return Unexpected(error_of(ErrorCode::kCannotOpen, file, std::strerror(errno)));
  return opened;
}

}  // namespace

Expected<std::vector<Scene>> read_scenes(const std::filesystem::path& file) {
  const auto opened = open_file(file);
  if (!opened) return Unexpected(opened.error());
  SceneLines lines(file);
  std::array<char, 1U << 16U> buffer{};
  while (const std::size_t count = std::fread(buffer.data(), 1, buffer.size(), opened->get())) {
    if (auto taken = lines.take({buffer.data(), count}); !taken) return Unexpected(std::move(taken).error());
  }
  if (std::ferror(opened->get()) != 0) {
    return Unexpected(error_of(ErrorCode::kCannotOpen, file, "cannot be read"));
  }
  return lines.finish();
}

}  // namespace verge::app
