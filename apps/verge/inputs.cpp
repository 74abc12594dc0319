// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "apps/verge/inputs.hpp"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <filesystem>
#include <utility>

#include <fmt/format.h>
#include <unistd.h>

#include "verge/core/field_io.hpp"
#include "verge/io/formats.hpp"
#include "verge/io/input.hpp"
#include "verge/io/sniff.hpp"
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
  options.topic = request.topic;
  options.sensor_ip = request.sensor_ip;
  options.model = request.model;
  if (request.calibration) options.calibration = *request.calibration;
  if (!request.format) return options;
  options.format = value_named<io::Format>(*request.format);
  if (options.format) return options;
  return Unexpected(
      usage_error(fmt::format("--format {}", *request.format),
                  fmt::format("no such format (known: {})", fmt::join(enum_names<io::Format>, ", "))));
}

/// Scans in one file; none where only reading it tells.
std::optional<std::size_t> scans_in_file(const std::string& path, const io::OpenOptions& options) {
  if (!std::filesystem::is_regular_file(path)) return std::nullopt;
  if (options.format)
    return io::facts_of(*options.format).many_scans ? std::nullopt : std::optional<std::size_t>(1);
  auto input = io::Input::open(path, {options.memory_max_bytes, options.timeout_ms});
  const auto format = input ? io::sniff(*input) : Unexpected(input.error());
  // What no format fits is one damaged scan, said when its turn comes.
  return format && io::facts_of(*format).many_scans ? std::nullopt : std::optional<std::size_t>(1);
}

void add_up(std::vector<io::Counter>& all, const std::vector<io::Counter>& more) {
  for (const io::Counter& counter : more) {
    const auto same =
        std::find_if(all.begin(), all.end(), [&](const auto& c) { return c.name == counter.name; });
    if (same == all.end()) {
      all.push_back(counter);
    } else {
      same->count += counter.count;
    }
  }
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
  if (!is_folder && ::access(path.c_str(), R_OK) == 0) {
    part.count = scans_in_file(path, options);
    return part;
  }
  auto source = io::open(path, options);
  if (!source) return Unexpected(std::move(source).error());
  part.source = *std::move(source);
  part.count = part.source->info().scans;
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
  if (request.poses) {
    auto poses = PoseFile::read(path_of(*request.poses));
    if (!poses) return Unexpected(std::move(poses).error());
    inputs.poses_ = *std::move(poses);
  }
  const bool whole = range->begin == 0 && !range->end;
  io::OpenOptions looking = inputs.options_;
  if (!whole) looking.log = {};  // the frames asked for are opened anew and say what there is to say
  for (const std::string& path : request.paths) {
    auto part = look_at(path_of(path), looking);
    if (!part) return Unexpected(std::move(part).error());
    inputs.parts_.push_back(*std::move(part));
  }
  if (whole) return inputs;
  if (auto kept = inputs.keep(*range); !kept) return Unexpected(std::move(kept).error());
  return inputs;
}

/// Leaves of every part what lies in the range, counted over all parts.
Expected<void> Inputs::keep(const FrameRange& range) {
  const std::string place =
      fmt::format("--frames {}:{}", range.begin, range.end ? fmt::to_string(*range.end) : "");
  std::deque<Part> kept;
  std::size_t before = 0;
  for (Part& part : parts_) {
    if (!part.count && parts_.size() > 1) {
      return Unexpected(usage_error(place, "scans are counted in one recording at a time: name one"));
    }
    part.source.reset();
    const std::size_t begin = before;
    before += part.count.value_or(0);
    part.begin = std::max(range.begin, begin) - begin;
    if (range.end) part.end = std::max(*range.end, begin) - begin;
    const std::size_t end = std::min(part.end.value_or(SIZE_MAX), part.count.value_or(SIZE_MAX));
    if (part.begin < end) kept.push_back(std::move(part));
  }
  parts_ = std::move(kept);
  if (!parts_.empty()) return {};
  return Unexpected(usage_error(place, fmt::format("is past the last of {} scans", before)));
}

std::optional<std::size_t> Inputs::total() const {
  std::size_t total = 0;
  for (const Part& part : parts_) {
    if (!part.count) return std::nullopt;
    total += std::min(part.end.value_or(*part.count), *part.count) - part.begin;
  }
  return total;
}

std::vector<io::Counter> Inputs::counters() const {
  std::vector<io::Counter> all = counters_;
  if (!parts_.empty() && parts_.front().source) add_up(all, parts_.front().source->counters());
  return all;
}

void Inputs::done_with_part() {
  counters_ = counters();
  parts_.pop_front();
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
    if (poses_ && scan && *scan) poses_->give(**scan);
    if (!scan || *scan) return scan;
    done_with_part();
  }
  if (poses_ && !poses_->was_used())
    warn(options_.log, "--poses: none of the scans' frames stands in the file");
  poses_.reset();
  return std::optional<Scan>{};
}

}  // namespace verge::app
