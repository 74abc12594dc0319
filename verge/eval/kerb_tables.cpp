// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/eval/kerb_tables.hpp"

#include <array>
#include <cmath>
#include <optional>
#include <set>
#include <string_view>
#include <utility>

#include "verge/core/polyline.hpp"
#include "verge/eval/join_points.hpp"
#include "verge/eval/labelled_set.hpp"
#include "verge/io/input.hpp"
#include "verge/io/text.hpp"

namespace verge::eval {
namespace {

/// Calls take(line, token of it) for every line; the first that take() refuses is the error.
template <class Take>
Expected<void> each_line(const std::filesystem::path& path, std::string_view need, Take&& take) {
  auto input = io::Input::open(path, {});
  if (!input) return Unexpected(input.error());
  if (auto allowed = input->allow(0, input->size()); !allowed) return allowed;
  const auto bytes = input->read(0, input->size());
  if (!bytes) return Unexpected(bytes.error());
  io::LineReader lines(io::as_text(*bytes));
  while (const auto line = lines.next()) {
    if (take(*line)) continue;
    return Unexpected(io::error_at(*input, ErrorCode::kUnusable, {{}, lines.number(), 1},
                                   "line cannot be used", io::quoted(*line), std::string(need)));
  }
  return {};
}

bool is_blank(std::string_view line) { return line.find_first_not_of(" \t") == std::string_view::npos; }

/// A number as CSV holds it: spaces around it do not count.
std::optional<double> cell_number(std::string_view cell) {
  io::WordReader words(cell, 1);
  const auto word = words.next();
  if (!word || words.next()) return std::nullopt;
  const auto value = io::parse_number<double>(word->text);
  return value && std::isfinite(*value) ? value : std::nullopt;
}

struct KerbRow {
  std::string frame;
  Vec2 place;
};

std::optional<KerbRow> kerb_row(std::string_view line) {
  std::array<std::string_view, 4> cells;
  for (std::string_view& cell : cells) {
    const std::size_t comma = line.find(',');
    cell = line.substr(0, comma);
    line.remove_prefix(comma == std::string_view::npos ? line.size() : comma + 1);
  }
  const auto x = cell_number(cells[2]);
  const auto y = cell_number(cells[3]);
  if (!x || !y) return std::nullopt;
  return KerbRow{frame_stem(cells[0]), {*x, *y}};
}

/// A corner of a polygon, in whole thousandths of a millimetre, so that corners can be compared.
using Vertex = std::pair<std::int64_t, std::int64_t>;

std::optional<Vertex> corner_of(std::string_view line) {
  constexpr double kGreatest_mm = 1e9;
  io::WordReader words(line, 1);
  std::array<std::int64_t, 2> xy{};
  for (std::int64_t& value : xy) {
    const auto word = words.next();
    const auto number = word ? io::parse_number<double>(word->text) : std::nullopt;
    if (!number || !(std::fabs(*number) <= kGreatest_mm)) return std::nullopt;
    value = std::llround(*number * 1e3);
  }
  return words.next() ? std::nullopt : std::optional(Vertex(xy[0], xy[1]));
}

Vec2 metres(Vertex corner) {
  constexpr double kPerMetre = 1e6;
  return {static_cast<double>(corner.first) / kPerMetre, static_cast<double>(corner.second) / kPerMetre};
}

using Polygon = std::vector<Vertex>;

/// Edges that stand in two polygons, whichever way around, in order.
std::vector<Segment> shared_edges(const std::vector<Polygon>& polygons) {
  std::map<std::pair<Vertex, Vertex>, std::set<std::size_t>> owners;
  for (std::size_t p = 0; p < polygons.size(); ++p) {
    const Polygon& polygon = polygons[p];
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      owners[std::minmax(polygon[i], polygon[(i + 1) % polygon.size()])].insert(p);
    }
  }
  std::vector<Segment> edges;
  for (const auto& [edge, who] : owners) {
    if (who.size() > 1) edges.push_back({metres(edge.first), metres(edge.second)});
  }
  return edges;
}

}  // namespace

Expected<std::map<std::string, std::vector<Vec2>>> read_kerb_table(const std::filesystem::path& path) {
  std::map<std::string, std::vector<Vec2>> frames;
  bool is_header = true;
  const auto read = each_line(path, "frame,side,x,y,z", [&](std::string_view line) {
    if (std::exchange(is_header, false) || is_blank(line)) return true;
    auto row = kerb_row(line);
    if (row) frames[std::move(row->frame)].push_back(row->place);
    return row.has_value();
  });
  if (!read) return Unexpected(read.error());
  return frames;
}

LabelledTruth truth_of_kerb_points(std::span<const Vec2> kerb) {
  LabelledTruth truth;
  for (const Vec2 place : kerb) truth.points.push_back({place, std::nullopt});
  truth.segments = join_near(kerb);
  return truth;
}

Expected<LabelledTruth> read_kerb_polygons(const std::filesystem::path& path) {
  constexpr double kStep_m = 0.1;
  std::vector<Polygon> polygons(1);
  const auto read = each_line(path, "x y in millimetres", [&](std::string_view line) {
    if (is_blank(line)) {
      polygons.emplace_back();
      return true;
    }
    const auto corner = corner_of(line);
    if (corner) polygons.back().push_back(*corner);
    return corner.has_value();
  });
  if (!read) return Unexpected(read.error());
  LabelledTruth truth;
  truth.segments = shared_edges(polygons);
  for (const Segment& edge : truth.segments) {
    for (const Vec2 p : resample(std::array{edge.a, edge.b}, kStep_m))
      truth.points.push_back({p, std::nullopt});
  }
  return truth;
}

}  // namespace verge::eval
