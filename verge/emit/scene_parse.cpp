// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <limits>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "verge/emit/json_text.hpp"
#include "verge/emit/scene_json.hpp"

namespace verge::emit {
namespace {

using nlohmann::json;

/// Where in the record a value stands: a chain up to the record itself, which has no step.
struct Place {
  const Place* parent = nullptr;
  JsonStep step = std::size_t{0};
};

/// Reads values out of a parsed record and remembers the first one that cannot be used. After that the rest
/// is still read, to no purpose: the record is refused as a whole.
class Reader {
 public:
  Reader(std::string_view line, std::size_t line_number) : line_(line), line_number_(line_number) {}

  [[nodiscard]] const std::optional<Error>& fault() const { return fault_; }

  void fail(const Place& place, std::string what, std::string got, std::string need) {
    if (fault_) return;
    std::vector<JsonStep> path;
    for (const Place* p = &place; p->parent != nullptr; p = p->parent) path.push_back(p->step);
    std::reverse(path.begin(), path.end());
    fault_ = Error{ErrorCode::kUnusable,
                   {},
                   fmt::format("{}:{}", line_number_, column_of(line_, path)),
                   std::move(what),
                   std::move(got),
                   std::move(need)};
  }

  /// True where `value` has the type; else the reader fails.
  bool expect(bool is, const json& value, const Place& place, std::string_view need) {
    if (!is) fail(place, "a value of the wrong type", value.type_name(), std::string(need));
    return is;
  }

  /// Calls read(value, place) for the member, where it is there and not null.
  template <class Read>
  void member(const json& object, const Place& place, std::string_view name, Read&& read) {
    const auto found = object.find(name);
    if (found != object.end() && !found->is_null()) read(*found, Place{&place, name});
  }

  /// Calls read(element, place) for every element of an array.
  template <class Read>
  void each(const json& array, const Place& place, Read&& read) {
    if (!expect(array.is_array(), array, place, "an array")) return;
    for (std::size_t i = 0; i < array.size(); ++i) read(array[i], Place{&place, i});
  }

  [[nodiscard]] double number(const json& value, const Place& place) {
    return expect(value.is_number(), value, place, "a number") ? value.get<double>() : 0.0;
  }

  [[nodiscard]] double share(const json& value, const Place& place) {
    const double number_read = number(value, place);
    if (number_read < 0.0 || number_read > 1.0) {
      fail(place, "a share out of range", fmt::format("{}", number_read), "0 to 1");
    }
    return number_read;
  }

  template <class Int>
  [[nodiscard]] Int integer(const json& value, const Place& place) {
    if (!expect(value.is_number_integer(), value, place, "an integer")) return 0;
    const bool fits = value.is_number_unsigned() ? std::in_range<Int>(value.get<std::uint64_t>())
                                                 : std::in_range<Int>(value.get<std::int64_t>());
    if (fits) return value.get<Int>();
    fail(place, "an integer out of range", value.dump(),
         fmt::format("{} to {}", std::numeric_limits<Int>::min(), std::numeric_limits<Int>::max()));
    return 0;
  }

  [[nodiscard]] std::string text(const json& value, const Place& place) {
    return expect(value.is_string(), value, place, "a string") ? value.get<std::string>() : std::string();
  }

  template <class Enum>
  [[nodiscard]] Enum named(const json& value, const Place& place) {
    const std::string name = text(value, place);
    if (const auto known = value_named<Enum>(name)) return *known;
    fail(place, "an unknown name", name, fmt::format("{}", fmt::join(enum_names<Enum>, ", ")));
    return Enum{};
  }

 private:
  std::string_view line_;
  std::size_t line_number_;
  std::optional<Error> fault_;
};

Vec3 read_point(Reader& reader, const json& value, const Place& place) {
  if (!reader.expect(value.is_array(), value, place, "an array")) return {};
  if (value.size() != 2 && value.size() != 3) {
    reader.fail(place, "a point of the wrong length", fmt::format("{} numbers", value.size()), "2 or 3");
    return {};
  }
  std::vector<double> xyz;
  reader.each(value, place, [&](const json& v, const Place& at) { xyz.push_back(reader.number(v, at)); });
  return {xyz[0], xyz[1], xyz.size() == 3 ? xyz[2] : 0.0};
}

/// An array that tells something of each point: as long as the points.
template <class Value, class Read>
std::vector<Value> read_of_each_point(Reader& reader, const json& array, const Place& place,
                                      std::size_t points, Read&& read) {
  std::vector<Value> values;
  reader.each(array, place, [&](const json& v, const Place& at) { values.push_back(read(v, at)); });
  if (values.size() != points) {
    reader.fail(place, "not one value a point", std::to_string(values.size()), std::to_string(points));
  }
  return values;
}

void read_point_properties(Reader& reader, const json& value, const Place& place, Boundary& boundary) {
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

Boundary read_boundary(Reader& reader, const json& value, const Place& place) {
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
    reader.each(
        v, at, [&](const json& p, const Place& in) { boundary.points.push_back(read_point(reader, p, in)); });
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

Sector read_sector(Reader& reader, const json& value, const Place& place) {
  std::vector<double> ends;
  reader.each(value, place, [&](const json& v, const Place& at) { ends.push_back(reader.number(v, at)); });
  if (ends.size() == 2) return {ends[0], ends[1]};
  reader.fail(place, "a sector of the wrong length", fmt::format("{} numbers", ends.size()), "2");
  return {};
}

Health read_health(Reader& reader, const json& value, const Place& place) {
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

void check_schema(Reader& reader, const json& record, const Place& root) {
  reader.member(record, root, "schema", [&](const json& v, const Place& at) {
    if (reader.integer<int>(v, at) != 1) reader.fail(at, "an unknown schema", v.dump(), "1");
  });
}

std::vector<Boundary> read_boundaries(Reader& reader, const json& record, const Place& root) {
  std::vector<Boundary> boundaries;
  bool found = false;
  reader.member(record, root, "points", [&](const json& v, const Place& at) {
    found = true;
    reader.each(v, at, [&](const json& p, const Place& in) {
      boundaries.push_back(loose_point(read_point(reader, p, in)));
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

Scene read_scene(Reader& reader, const json& record) {
  const Place root;
  Scene scene;
  if (!reader.expect(record.is_object(), record, root, "an object")) return scene;
  check_schema(reader, record, root);
  const auto member = [&](std::string_view name, auto&& read) { reader.member(record, root, name, read); };
  const auto text = [&](std::string_view name, std::string& out) {
    member(name, [&](const json& v, const Place& at) { out = reader.text(v, at); });
  };
  if (record.value("frame", json()).is_null()) reader.fail(root, "a record without a frame", {}, "\"frame\"");
  text("frame", scene.frame);
  member("stamp_ns",
         [&](const json& v, const Place& at) { scene.stamp_ns = reader.integer<std::int64_t>(v, at); });
  text("frame_id", scene.frame_id);
  scene.boundaries = read_boundaries(reader, record, root);
  member("health", [&](const json& v, const Place& at) { scene.health = read_health(reader, v, at); });
  text("method", scene.method);
  text("version", scene.version);
  text("config_hash", scene.config_hash);
  return scene;
}

}  // namespace

Expected<Scene> parse_scene(std::string_view line, std::size_t line_number) {
  if (const auto fault = find_syntax_fault(line)) {
    return Unexpected({ErrorCode::kUnusable,
                       {},
                       fmt::format("{}:{}", line_number, fault->column),
                       fmt::format("not JSON: {}", fault->what),
                       {},
                       {}});
  }
  Reader reader(line, line_number);
  Scene scene = read_scene(reader, json::parse(line));
  if (reader.fault()) return Unexpected(*reader.fault());
  return scene;
}

}  // namespace verge::emit
