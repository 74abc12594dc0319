// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "verge/emit/record_reader.hpp"
#include "verge/emit/scene_json.hpp"
#include "verge/emit/scene_parts.hpp"
#include "verge/model/json_text.hpp"

namespace verge::emit {
namespace {

using nlohmann::json;

/// An array that tells something of each point: as long as the points.
template <class Value, class Read>
std::vector<Value> read_of_each_point(RecordReader& reader, const json& array, const Place& place,
                                      std::size_t points, Read&& read) {
  std::vector<Value> values;
  reader.each(array, place, [&](const json& v, const Place& at) { values.push_back(read(v, at)); });
  if (values.size() != points) {
    reader.fail(place, "not one value a point", std::to_string(values.size()), std::to_string(points));
  }
  return values;
}

void read_point_properties(RecordReader& reader, const json& value, const Place& place, Boundary& boundary) {
  const std::size_t count = boundary.points.size();
  reader.member(value, place, "height_m", [&](const json& v, const Place& at) {
    boundary.height_m = read_of_each_point<double>(
        reader, v, at, count, [&](const json& h, const Place& in) { return reader.number(h, in); });
  });
  reader.member(value, place, "state", [&](const json& v, const Place& at) {
    boundary.state = read_of_each_point<PointState>(
        reader, v, at, count,
        [&](const json& s, const Place& in) { return reader.named<PointState>(s, in); });
  });
}

Boundary read_boundary(RecordReader& reader, const json& value, const Place& place) {
  Boundary boundary;
  boundary.confidence = 1.0;
  if (!reader.expect(value.is_object(), value, place, "an object")) return boundary;
  const auto member = [&](std::string_view name, auto&& read) { reader.member(value, place, name, read); };
  member("id", [&](const json& v, const Place& at) { boundary.id = reader.integer<int>(v, at); });
  member("side", [&](const json& v, const Place& at) { boundary.side = reader.named<Side>(v, at); });
  member("model", [&](const json& v, const Place& at) { boundary.model = reader.named<Model>(v, at); });
  member("kind", [&](const json& v, const Place& at) { boundary.kind = reader.named<BoundaryKind>(v, at); });
  member("confidence", [&](const json& v, const Place& at) { boundary.confidence = reader.share(v, at); });
  member("points", [&](const json& v, const Place& at) {
    reader.each(v, at,
                [&](const json& p, const Place& in) { boundary.points.push_back(reader.point(p, in)); });
  });
  read_point_properties(reader, value, place, boundary);
  return boundary;
}

/// A point that belongs to no line.
Boundary loose_point(Vec3 point) {
  Boundary boundary;
  boundary.confidence = 1.0;
  boundary.points = {point};
  return boundary;
}

Sector read_sector(RecordReader& reader, const json& value, const Place& place) {
  const auto ends = reader.numbers<2>(value, place, "a sector");
  return {ends[0], ends[1]};
}

Health read_health(RecordReader& reader, const json& value, const Place& place) {
  Health health;
  if (!reader.expect(value.is_object(), value, place, "an object")) return health;
  const auto member = [&](std::string_view name, auto&& read) { reader.member(value, place, name, read); };
  member("state", [&](const json& v, const Place& at) { health.state = reader.text(v, at); });
  member("completeness", [&](const json& v, const Place& at) { health.completeness = reader.share(v, at); });
  member("unobserved", [&](const json& v, const Place& at) {
    reader.each(v, at, [&](const json& s, const Place& in) {
      health.unobserved.push_back(read_sector(reader, s, in));
    });
  });
  return health;
}

void check_schema(RecordReader& reader, const json& record, const Place& root) {
  reader.member(record, root, "schema", [&](const json& v, const Place& at) {
    if (reader.integer<int>(v, at) != 1) reader.fail(at, "an unknown schema", v.dump(), "1");
  });
}

std::vector<Boundary> read_boundaries(RecordReader& reader, const json& record, const Place& root) {
  std::vector<Boundary> boundaries;
  bool found = false;
  reader.member(record, root, "points", [&](const json& v, const Place& at) {
    found = true;
    reader.each(v, at, [&](const json& p, const Place& in) {
      boundaries.push_back(loose_point(reader.point(p, in)));
    });
  });
  if (found) return boundaries;
  reader.member(record, root, "boundaries", [&](const json& v, const Place& at) {
    found = true;
    reader.each(v, at,
                [&](const json& b, const Place& in) { boundaries.push_back(read_boundary(reader, b, in)); });
  });
  if (!found) reader.fail(root, "a record without boundaries", {}, R"("boundaries" or "points")");
  return boundaries;
}

/// Some programs number their frames.
std::string frame_of(RecordReader& reader, const json& value, const Place& place) {
  return value.is_number_integer() ? value.dump() : reader.text(value, place);
}

Scene read_scene(RecordReader& reader, const json& record) {
  const Place root;
  Scene scene;
  if (!reader.expect(record.is_object(), record, root, "an object")) return scene;
  check_schema(reader, record, root);
  const auto member = [&](std::string_view name, auto&& read) { reader.member(record, root, name, read); };
  const auto text = [&](std::string_view name, std::string& out) {
    member(name, [&](const json& v, const Place& at) { out = reader.text(v, at); });
  };
  if (record.value("frame", json()).is_null()) reader.fail(root, "a record without a frame", {}, "\"frame\"");
  member("frame", [&](const json& v, const Place& at) { scene.frame = frame_of(reader, v, at); });
  member("stamp_ns",
         [&](const json& v, const Place& at) { scene.stamp_ns = reader.integer<std::int64_t>(v, at); });
  text("frame_id", scene.frame_id);
  scene.boundaries = read_boundaries(reader, record, root);
  read_parts(reader, record, root, scene);
  member("health", [&](const json& v, const Place& at) { scene.health = read_health(reader, v, at); });
  text("method", scene.method);
  text("version", scene.version);
  text("config_hash", scene.config_hash);
  return scene;
}

}  // namespace

Expected<Scene> parse_scene(std::string_view line, std::size_t line_number) {
  if (const auto fault = model::find_syntax_fault(line)) {
    return Unexpected({ErrorCode::kUnusable,
                       {},
                       fmt::format("{}:{}", line_number, fault->column),
                       fmt::format("not JSON: {}", fault->what),
                       {},
                       {}});
  }
  RecordReader reader(line, line_number);
  Scene scene = read_scene(reader, json::parse(line));
  if (reader.fault()) return Unexpected(*reader.fault());
  return scene;
}

}  // namespace verge::emit
