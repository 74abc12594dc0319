// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "apps/verge/pose_file.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string_view>
#include <utility>

#include <fmt/core.h>

#include "verge/io/input.hpp"
#include "verge/io/text.hpp"

namespace verge::app {
namespace {

constexpr std::array<std::string_view, 8> kNames = {"frame", "x_m", "y_m", "z_m", "qw", "qx", "qy", "qz"};
constexpr std::string_view kStamp = "stamp_ns";

/// Fields of a line, parted by commas, each with its column.
std::vector<io::Token> fields_of(std::string_view line, std::size_t number) {
  std::vector<io::Token> fields;
  std::size_t at = 0;
  while (true) {
    const std::size_t comma = line.find(',', at);
    fields.push_back({line.substr(at, comma == std::string_view::npos ? comma : comma - at), number, at + 1});
    if (comma == std::string_view::npos) return fields;
    at = comma + 1;
  }
}

/// Reads one file's lines.
class PoseLines {
 public:
  explicit PoseLines(std::string file) : file_(std::move(file)) {}

  [[nodiscard]] Error error_at(const io::Token& place, std::string what, std::string need = {}) const {
    return {ErrorCode::kUsage,
            file_,
            fmt::format("{}:{}", place.line, place.column),
            std::move(what),
            std::string(place.text),
            std::move(need)};
  }

  [[nodiscard]] Expected<void> take_names(std::string_view line) {
    const auto fields = fields_of(line, 1);
    const auto column_of = [&](std::string_view name) -> std::optional<std::size_t> {
      const auto found = std::ranges::find(fields, name, &io::Token::text);
      if (found == fields.end()) return std::nullopt;
      return static_cast<std::size_t>(found - fields.begin());
    };
    for (std::size_t i = 0; i < kNames.size(); ++i) {
      const auto column = column_of(kNames.at(i));
      if (!column)
        return Unexpected(error_at(io::Token{{}, 1, 1}, fmt::format("no column '{}'", kNames.at(i))));
      columns_.at(i) = *column;
    }
    stamp_column_ = column_of(kStamp);
    width_ = fields.size();
    return {};
  }

  /// A line as frame, time and pose.
  struct Line {
    std::string frame;
    std::optional<std::int64_t> stamp_ns;
    Pose pose;
  };

  [[nodiscard]] Expected<Line> take(std::string_view line, std::size_t number) const {
    const auto fields = fields_of(line, number);
    if (fields.size() != width_) {
      return Unexpected(error_at({{}, number, 1}, fmt::format("{} fields", fields.size()),
                                 fmt::format("{}, as in the first line", width_)));
    }
    std::array<double, 7> values{};
    for (std::size_t i = 0; i < values.size(); ++i) {
      const io::Token& field = fields[columns_.at(i + 1)];
      const auto value = io::parse_number<double>(field.text);
      if (!value || !std::isfinite(*value))
        return Unexpected(error_at(field, fmt::format("{} is no number", kNames.at(i + 1))));
      values.at(i) = *value;
    }
    Line read{std::string(fields[columns_[0]].text), std::nullopt, {}};
    if (stamp_column_) read.stamp_ns = io::parse_number<std::int64_t>(fields[*stamp_column_].text);
    const auto [x, y, z, qw, qx, qy, qz] = values;
    read.pose = {{qw, qx, qy, qz}, {x, y, z}};
    const double length = std::sqrt(qw * qw + qx * qx + qy * qy + qz * qz);
    constexpr double kNearOne = 1e-3;
    if (std::fabs(length - 1.0) > kNearOne)
      return Unexpected(error_at(fields[columns_[4]], "the quaternion is no rotation", "length 1"));
    return read;
  }

 private:
  std::string file_;
  std::array<std::size_t, kNames.size()> columns_{};
  std::optional<std::size_t> stamp_column_;
  std::size_t width_ = 0;
};

}  // namespace

Expected<PoseFile> PoseFile::read(const std::filesystem::path& file) {
  auto input = io::Input::open(file, {});
  if (!input) return Unexpected(std::move(input).error());
  const auto bytes = input->read(0, input->size());
  if (!bytes) return Unexpected(bytes.error());
  PoseLines lines(file.string());
  io::LineReader reader(io::as_text(*bytes));
  if (auto named = lines.take_names(reader.next().value_or("")); !named)
    return Unexpected(std::move(named).error());
  PoseFile poses;
  while (const auto line = reader.next()) {
    if (line->empty()) continue;
    auto read = lines.take(*line, reader.number());
    if (!read) return Unexpected(std::move(read).error());
    if (!poses.row_of_.emplace(read->frame, poses.rows_.size()).second) {
      return Unexpected(
          lines.error_at({read->frame, reader.number(), 1}, "the frame stands here a second time"));
    }
    poses.rows_.push_back({read->stamp_ns, read->pose});
  }
  return poses;
}

void PoseFile::give(Scan& scan) {
  const auto found = row_of_.find(scan.frame);
  if (found == row_of_.end()) return;
  used_ = true;
  const Row& row = rows_[found->second];
  scan.T_world_sensor = row.T_world_sensor;
  if (scan.motion || scan.deskewed || scan.time_offset_ns.empty()) return;
  if (found->second + 1 == rows_.size()) return;
  const Row& next = rows_[found->second + 1];
  if (!row.stamp_ns || !next.stamp_ns || *next.stamp_ns <= *row.stamp_ns) return;
  scan.motion = Motion{row.T_world_sensor, next.T_world_sensor, *next.stamp_ns - *row.stamp_ns};
}

}  // namespace verge::app
