// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/sensor/velodyne/calibration.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <string_view>
#include <utility>

namespace verge::sensor::velodyne {
namespace {

constexpr std::size_t kMostBytes = 1U << 20U;
constexpr std::size_t kMostLasers = 128;

/// Where something stands in the file, from 1.
struct Place {
  std::size_t line = 1;
  std::size_t column = 1;
};

/// One `key: value`.
struct Entry {
  std::string_view key;
  std::string_view value;
  Place place;
};

/// A laser as the file tells it.
struct LaserEntry {
  std::map<std::string_view, Entry> entries;
  Place place;
};

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kBlank = " \t\r";
  const std::size_t begin = text.find_first_not_of(kBlank);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(kBlank) - begin + 1);
}

/// Reads the list of lasers, piece by piece: lines, cut at commas and braces.
class Reader {
 public:
  Reader(std::string_view text, std::string name) : text_(text), name_(std::move(name)) {}

  Expected<std::vector<LaserEntry>> read() {
    std::size_t at = 0;
    while (at < text_.size()) {
      std::string_view line = text_.substr(at, text_.find('\n', at) - at);
      at += line.size() + 1;
      if (auto read = read_line(line.substr(0, line.find('#'))); !read) return Unexpected(read.error());
      ++place_.line;
    }
    return std::move(lasers_);
  }

  [[nodiscard]] Error error(Place place, std::string what, std::string_view got = {},
                            std::string need = {}) const {
    constexpr std::size_t kShown = 40;
    return {ErrorCode::kUnusable,
            name_,
            std::to_string(place.line) + ":" + std::to_string(place.column),
            std::move(what),
            std::string(got.substr(0, kShown)),
            std::move(need)};
  }

 private:
  Expected<void> read_line(std::string_view line) {
    const std::string_view content = trimmed(line);
    if (content.empty() || content == "---" || content == "...") return {};
    const bool top = line.front() != ' ' && line.front() != '-' && depth_ == 0;
    if (top) in_lasers_ = content.starts_with("lasers:");
    if (!in_lasers_) return {};
    std::size_t begin = top ? std::string_view("lasers:").size() : 0;
    for (std::size_t i = begin; i <= line.size(); ++i) {
      const bool cut = i == line.size() || line[i] == ',' || line[i] == '{' || line[i] == '}' ||
                       line[i] == '[' || line[i] == ']';
      if (!cut) continue;
      place_.column = begin + 1;
      if (auto read = read_piece(line.substr(begin, i - begin)); !read) return Unexpected(read.error());
      if (i < line.size()) read_brace(line[i], i);
      begin = i + 1;
    }
    return {};
  }

  void read_brace(char brace, std::size_t column) {
    if (brace == '{' && !dash_pending_) lasers_.push_back({{}, {place_.line, column + 1}});
    if (brace == '{' || brace == '[') ++depth_;
    if ((brace == '}' || brace == ']') && depth_ > 0) --depth_;
    dash_pending_ = false;
  }

  Expected<void> read_piece(std::string_view piece) {
    std::string_view content = trimmed(piece);
    if (content.starts_with("- ") || content == "-") {
      if (lasers_.size() == kMostLasers)
        return Unexpected(error(place_, "too many lasers", "> 128", "<= 128"));
      lasers_.push_back({{}, place_});
      content = trimmed(content.substr(1));
      dash_pending_ = content.empty();
    }
    if (content.empty()) return {};
    const std::size_t colon = content.find(':');
    if (colon == std::string_view::npos) return Unexpected(error(place_, "not a key and its value", content));
    if (lasers_.empty()) return Unexpected(error(place_, "a value outside the list of lasers", content));
    dash_pending_ = false;
    const std::string_view key = trimmed(content.substr(0, colon));
    lasers_.back().entries[key] = {key, trimmed(content.substr(colon + 1)), place_};
    return {};
  }

  std::string_view text_;
  std::string name_;
  Place place_;
  std::vector<LaserEntry> lasers_;
  bool in_lasers_ = false;
  bool dash_pending_ = false;  // a dash has begun the laser that the next brace opens
  std::size_t depth_ = 0;
};

Expected<double> number_of(const LaserEntry& laser, std::string_view key, const Reader& reader) {
  const auto found = laser.entries.find(key);
  if (found == laser.entries.end()) return 0.0;
  const Entry& entry = found->second;
  double value = 0.0;
  const char* const end = entry.value.data() + entry.value.size();
  const auto [stop, error] = std::from_chars(entry.value.data(), end, value);
  if (error != std::errc() || stop != end || !std::isfinite(value)) {
    return Unexpected(reader.error(entry.place, std::string(key) + " is not a finite number", entry.value));
  }
  return value;
}

Expected<std::size_t> id_of(const LaserEntry& laser, std::size_t lasers, const Reader& reader) {
  const std::string need = "0.." + std::to_string(lasers - 1);
  const auto found = laser.entries.find("laser_id");
  if (found == laser.entries.end())
    return Unexpected(reader.error(laser.place, "laser_id is missing", {}, need));
  const auto value = number_of(laser, "laser_id", reader);
  if (!value) return Unexpected(value.error());
  const bool fits = *value >= 0.0 && *value < static_cast<double>(lasers) && *value == std::floor(*value);
  if (!fits) {
    return Unexpected(reader.error(found->second.place, "no such laser_id", found->second.value, need));
  }
  return static_cast<std::size_t>(*value);
}

/// The model's azimuth offset goes with the turn; the file's rot_correction goes against it.
Expected<LaserCorrection> correction_of(const LaserEntry& laser, const Reader& reader) {
  LaserCorrection out;
  NearCorrection near;
  const std::pair<std::string_view, double*> numbers[] = {
      {"vert_correction", &out.elevation_rad},  {"rot_correction", &out.azimuth_rad},
      {"dist_correction", &out.distance_m},     {"vert_offset_correction", &out.up_m},
      {"horiz_offset_correction", &out.left_m}, {"dist_correction_x", &near.side_m},
      {"dist_correction_y", &near.ahead_m}};
  for (const auto& [key, value] : numbers) {
    const auto number = number_of(laser, key, reader);
    if (!number) return Unexpected(number.error());
    *value = *number;
  }
  out.azimuth_rad = -out.azimuth_rad;
  const auto two_points = laser.entries.find("two_pt_correction_available");
  if (two_points != laser.entries.end() && two_points->second.value == "true") out.near = near;
  return out;
}

Expected<void> check_elevations(const Calibration& calibration, const std::vector<LaserEntry>& lasers,
                                const Reader& reader) {
  std::map<double, std::size_t> seen;
  for (std::size_t laser = 0; laser < calibration.size(); ++laser) {
    const auto [other, added] = seen.emplace(calibration[laser].elevation_rad, laser);
    if (added) continue;
    return Unexpected(reader.error(
        lasers[laser].place, "two lasers have the same vert_correction",
        "lasers " + std::to_string(other->second) + " and " + std::to_string(laser), "all different"));
  }
  return {};
}

}  // namespace

Expected<Calibration> read_calibration(Bytes bytes, const std::string& name, std::size_t lasers) {
  Reader reader({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, name);
  if (bytes.size() > kMostBytes) {
    return Unexpected(
        reader.error({}, "too long for a calibration", std::to_string(bytes.size()) + " B", "<= 1 MiB"));
  }
  const auto entries = reader.read();
  if (!entries) return Unexpected(entries.error());
  if (entries->empty()) return Unexpected(reader.error({}, "no lasers in the calibration"));
  Calibration calibration(entries->size());
  std::vector<bool> told(entries->size(), false);
  std::vector<LaserEntry> by_id(entries->size());
  for (const LaserEntry& entry : *entries) {
    const auto id = id_of(entry, entries->size(), reader);
    if (!id) return Unexpected(id.error());
    if (told[*id]) return Unexpected(reader.error(entry.place, "laser_id comes twice", std::to_string(*id)));
    const auto correction = correction_of(entry, reader);
    if (!correction) return Unexpected(correction.error());
    told[*id] = true;
    by_id[*id] = entry;
    calibration[*id] = *correction;
  }
  if (auto checked = check_elevations(calibration, by_id, reader); !checked)
    return Unexpected(checked.error());
  if (calibration.size() != lasers) {
    Error error =
        reader.error({}, "the calibration is of another sensor",
                     std::to_string(calibration.size()) + " lasers", std::to_string(lasers) + " lasers");
    error.code = ErrorCode::kUsage;
    return Unexpected(error);
  }
  return calibration;
}

}  // namespace verge::sensor::velodyne
