// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "apps/verge/inputs.hpp"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <utility>

#include <fmt/format.h>
#include <unistd.h>

#include "verge/core/field_io.hpp"
#include "verge/model/scene.hpp"

namespace verge::app {
namespace {

Error usage_error(std::string place, std::string what) {
  return {ErrorCode::kUsage, std::move(place), {}, std::move(what), {}, {}};
}

/// A whole number; outer none: not a number; inner none: nothing there.
std::optional<std::optional<std::size_t>> bound_of(std::string_view text) {
  if (text.empty()) return std::optional<std::size_t>{};
  std::size_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

Expected<io::OpenOptions> options_of(const InputRequest& request, const Log& log) {
  io::OpenOptions options;
  options.memory_max_bytes = request.max_mem_mib << 20U;
  options.log = log;
  if (!request.format) return options;
  options.format = value_named<io::Format>(*request.format);
  if (options.format) return options;
  return Unexpected(
      usage_error(fmt::format("--format {}", *request.format),
                  fmt::format("no such format (known: {})", fmt::join(enum_names<io::Format>, ", "))));
}

std::string path_of(const std::string& argument) { return argument == "-" ? "/dev/stdin" : argument; }

}  // namespace

Expected<FrameRange> parse_frames(std::string_view text) {
  const std::size_t colon = text.find(':');
  const auto begin = bound_of(text.substr(0, colon));
  const auto end = colon == std::string_view::npos ? std::nullopt : bound_of(text.substr(colon + 1));
  const std::string place = fmt::format("--frames {}", text);
  if (!begin || !end) return Unexpected(usage_error(place, "is not A:B, as in 0:100, 50: or :20"));
  const FrameRange range{begin->value_or(0), *end};
  if (range.end && *range.end <= range.begin) return Unexpected(usage_error(place, "holds no scan"));
  return range;
}

Expected<Inputs::Part> Inputs::look_at(const std::string& path, const io::OpenOptions& options) {
  std::error_code ignored;
  Part part;
  part.path = path;
  const bool is_folder = std::filesystem::is_directory(path, ignored);
  if (!is_folder && ::access(path.c_str(), R_OK) == 0) return part;
  auto source = io::open(path, options);
  if (!source) return Unexpected(std::move(source).error());
  part.source = *std::move(source);
  part.count = part.end = part.source->info().files.size();
  return part;
}

Expected<Inputs> Inputs::open(const InputRequest& request, const Log& log) {
  if (request.paths.empty()) return Unexpected(usage_error({}, "no input: name a file or a folder of scans"));
  const auto range = parse_frames(request.frames);
  if (!range) return Unexpected(range.error());
  auto options = options_of(request, log);
  if (!options) return Unexpected(std::move(options).error());
  Inputs inputs;
  inputs.options_ = *std::move(options);
  std::size_t count = 0;
  const bool whole = range->begin == 0 && !range->end;
  io::OpenOptions looking = inputs.options_;
  if (!whole) looking.log = {};  // the frames asked for are opened anew and say what there is to say
  for (const std::string& path : request.paths) {
    auto part = look_at(path_of(path), looking);
    if (!part) return Unexpected(std::move(part).error());
    count += part->count;
    inputs.parts_.push_back(*std::move(part));
  }
  inputs.keep(*range);
  if (inputs.total_ > 0) return inputs;
  return Unexpected(usage_error(fmt::format("--frames {}", request.frames),
                                fmt::format("is past the last of {} scans", count)));
}

/// Leaves of every part what lies in the range, counted over all parts.
void Inputs::keep(const FrameRange& range) {
  const bool whole = range.begin == 0 && !range.end;
  std::deque<Part> kept;
  std::size_t before = 0;
  for (Part& part : parts_) {
    const std::size_t after = before + part.count;
    part.begin = std::clamp(range.begin, before, after) - before;
    part.end = std::clamp(range.end.value_or(after), before, after) - before;
    before = after;
    if (part.begin >= part.end) continue;
    if (!whole) part.source.reset();
    total_ += part.end - part.begin;
    kept.push_back(std::move(part));
  }
  parts_ = std::move(kept);
}

Expected<void> Inputs::ready(Part& part) {
  if (part.source) return {};
  io::OpenOptions options = options_;
  options.frames_begin = part.begin;
  options.frames_end = part.end;
  auto source = io::open(part.path, options);
  if (!source) return Unexpected(std::move(source).error());
  part.source = *std::move(source);
  return {};
}

Expected<std::optional<Scan>> Inputs::next() {
  while (!parts_.empty()) {
    if (auto opened = ready(parts_.front()); !opened) {
      parts_.pop_front();
      return Unexpected(std::move(opened).error());
    }
    io::Source& source = *parts_.front().source;
    format_ = source.info().format;
    auto scan = source.next();
    if (!scan || *scan) return scan;
    parts_.pop_front();
  }
  return std::optional<Scan>{};
}

}  // namespace verge::app
