// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/emit/scene_parts.hpp"

namespace verge::emit {
namespace {

using nlohmann::json;

/// One object of a record, with a reader for each type of member. A member that is missing leaves its target
/// as it is.
class Part {
 public:
  Part(RecordReader& reader, const json& value, const Place& place)
      : reader_(reader), value_(value), place_(place) {}

  template <class Enum>
  void named(std::string_view name, Enum& out) {
    member(name, [&](const json& v, const Place& at) { out = reader_.named<Enum>(v, at); });
  }
  template <class Enum>
  void named(std::string_view name, std::optional<Enum>& out) {
    member(name, [&](const json& v, const Place& at) { out = reader_.named<Enum>(v, at); });
  }
  void integer(std::string_view name, int& out) {
    member(name, [&](const json& v, const Place& at) { out = reader_.integer<int>(v, at); });
  }
  void share(std::string_view name, double& out) {
    out = 1.0;
    member(name, [&](const json& v, const Place& at) { out = reader_.share(v, at); });
  }
  void number(std::string_view name, double& out) {
    member(name, [&](const json& v, const Place& at) { out = reader_.number(v, at); });
  }
  void size(std::string_view name, double& out) {
    member(name, [&](const json& v, const Place& at) { out = not_negative(v, at); });
  }
  void size(std::string_view name, std::optional<double>& out) {
    member(name, [&](const json& v, const Place& at) { out = not_negative(v, at); });
  }
  void number(std::string_view name, std::optional<double>& out) {
    member(name, [&](const json& v, const Place& at) { out = reader_.number(v, at); });
  }

  /// Those without which the part makes no sense.
  template <class Read>
  void needed(std::string_view name, Read&& read) {
    reader_.needed_member(value_, place_, name, read);
  }
  template <class Read>
  void member(std::string_view name, Read&& read) {
    reader_.member(value_, place_, name, read);
  }

 private:
  double not_negative(const json& value, const Place& place) {
    const double number = reader_.number(value, place);
    if (number < 0.0) reader_.fail(place, "a negative size", fmt::format("{}", number), ">= 0");
    return number;
  }

  RecordReader& reader_;
  const json& value_;
  const Place& place_;
};

void read(RecordReader& reader, Part& part, Opening& opening) {
  part.needed("ends", [&](const json& v, const Place& at) {
    std::size_t count = 0;
    reader.each(v, at, [&](const json& end, const Place& in) {
      const Vec2 p = reader.pair(end, in);
      if (count < opening.ends.size()) opening.ends.at(count) = p;
      ++count;
    });
    if (count != opening.ends.size()) {
      reader.fail(at, "an opening without two ends", fmt::format("{} points", count), "2");
    }
  });
  opening.width_m = distance(opening.ends[0], opening.ends[1]);
  part.size("width_m", opening.width_m);
  part.share("confidence", opening.confidence);
}

void read(RecordReader& reader, Part& part, Corner& corner) {
  part.integer("id", corner.id);
  part.named("side", corner.side);
  part.needed("position", [&](const json& v, const Place& at) { corner.position = reader.pair(v, at); });
  part.size("sigma_m", corner.sigma_m);
  part.number("distance_m", corner.distance_m);
  part.size("width_m", corner.width_m);
  part.number("exit_m", corner.exit_m);
  part.share("confidence", corner.confidence);
}

void read(RecordReader& reader, Part& part, Junction& junction) {
  part.named("type", junction.type);
  part.needed("center", [&](const json& v, const Place& at) { junction.center = reader.pair(v, at); });
  part.member("branches_rad", [&](const json& v, const Place& at) {
    reader.each(v, at, [&](const json& branch, const Place& in) {
      junction.branches_rad.push_back(reader.number(branch, in));
    });
  });
  part.share("confidence", junction.confidence);
}

BoxSize read_size(RecordReader& reader, const json& value, const Place& place) {
  const auto size = reader.numbers<3>(value, place, "a size");
  for (const double side_m : size) {
    if (side_m < 0.0) reader.fail(place, "a negative size", fmt::format("{}", side_m), ">= 0");
  }
  return {size[0], size[1], size[2]};
}

void read(RecordReader& reader, Part& part, Object& object) {
  part.integer("id", object.id);
  part.named("class", object.type);
  part.named("shape", object.shape);
  part.needed("center", [&](const json& v, const Place& at) { object.center = reader.point(v, at); });
  part.needed("size", [&](const json& v, const Place& at) { object.size = read_size(reader, v, at); });
  part.number("yaw_rad", object.yaw_rad);
  part.share("confidence", object.confidence);
}

void read(RecordReader& reader, Part& part, RoadSurface& road) {
  part.member("width_m", [&](const json& v, const Place& at) {
    reader.each(v, at, [&](const json& width, const Place& in) {
      const Vec2 pair = reader.pair(width, in);
      road.width_m.push_back({pair.x, pair.y});
    });
  });
  part.member("polygon", [&](const json& v, const Place& at) {
    reader.each(v, at, [&](const json& p, const Place& in) { road.polygon.push_back(reader.pair(p, in)); });
  });
}

template <class Value>
Value read_one(RecordReader& reader, const json& value, const Place& place) {
  Value out;
  if (!reader.expect(value.is_object(), value, place, "an object")) return out;
  Part part(reader, value, place);
  read(reader, part, out);
  return out;
}

template <class Value>
void read_list(RecordReader& reader, const json& record, const Place& root, std::string_view name,
               std::vector<Value>& out) {
  reader.member(record, root, name, [&](const json& list, const Place& at) {
    reader.each(list, at, [&](const json& value, const Place& in) {
      out.push_back(read_one<Value>(reader, value, in));
    });
  });
}

}  // namespace

void read_parts(RecordReader& reader, const json& record, const Place& root, Scene& scene) {
  read_list(reader, record, root, "openings", scene.openings);
  read_list(reader, record, root, "corners", scene.corners);
  read_list(reader, record, root, "junctions", scene.junctions);
  read_list(reader, record, root, "objects", scene.objects);
  reader.member(record, root, "road", [&](const json& value, const Place& at) {
    scene.road = read_one<RoadSurface>(reader, value, at);
  });
}

}  // namespace verge::emit
