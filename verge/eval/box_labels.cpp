// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/eval/box_labels.hpp"

#include <algorithm>
#include <array>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "verge/core/angle.hpp"
#include "verge/io/input.hpp"
#include "verge/io/text.hpp"
#include "verge/model/json_text.hpp"

namespace verge::eval {
namespace {

using nlohmann::json;

constexpr auto kClasses = std::to_array<std::pair<std::string_view, ObjectClass>>({
    {"car", ObjectClass::kCar},
    {"truck", ObjectClass::kTruck},
    {"bus", ObjectClass::kTruck},
    {"trailer", ObjectClass::kTruck},
    {"construction_vehicle", ObjectClass::kTruck},
    {"pedestrian", ObjectClass::kPerson},
    {"bicycle", ObjectClass::kCyclist},
    {"motorcycle", ObjectClass::kCyclist},
    {"barrier", ObjectClass::kRoadside},
    {"traffic_cone", ObjectClass::kRoadside},
});

ObjectClass class_named(std::string_view name) {
  const auto* const known = std::ranges::find(kClasses, name, &decltype(kClasses)::value_type::first);
  return known == kClasses.end() ? ObjectClass::kUnknown : known->second;
}

/// What cannot be used, and the way to it from the file's root.
struct Fault {
  std::vector<model::JsonStep> path;
  std::string what;
  std::string got;
  std::string need;
};

/// The member of an object and the way to it.
struct Member {
  std::vector<model::JsonStep> path;
  const json& value;
};

tl::expected<Member, Fault> member_of(const json& object, std::vector<model::JsonStep> path,
                                      std::string_view name) {
  if (!object.is_object())
    return tl::unexpected(
        Fault{std::move(path), "a value of the wrong type", object.type_name(), "an object"});
  const auto found = object.find(name);
  if (found == object.end())
    return tl::unexpected(Fault{std::move(path), "an object without what it needs", {}, std::string(name)});
  path.emplace_back(name);
  return Member{std::move(path), *found};
}

/// x, y, z, length, width, height, yaw, turned by a quarter.
std::optional<Fault> place_box(const Member& member, Object& object) {
  constexpr std::size_t kNumbers = 7;
  constexpr double kGreatest_m = 1000.0;
  const json& value = member.value;
  const auto is_number = [](const json& one) { return one.is_number(); };
  if (!value.is_array() || value.size() != kNumbers || !std::ranges::all_of(value, is_number)) {
    return Fault{member.path, "a box that is not seven numbers",
                 fmt::format("{} of {}", value.type_name(), value.size()),
                 "x, y, z, length, width, height, yaw"};
  }
  const auto box = value.get<std::array<double, kNumbers>>();
  object.center = {box[1], -box[0], box[2]};
  object.size = {box[3], box[4], box[5]};
  object.yaw_rad = wrap_pi(box[6] - 0.5 * std::numbers::pi);
  const auto [least, greatest] = std::minmax({box[3], box[4], box[5]});
  if (least > 0.0 && greatest <= kGreatest_m) return std::nullopt;
  return Fault{member.path, "a size out of range", fmt::format("{} x {} x {}", box[3], box[4], box[5]),
               "above 0, up to 1000 m"};
}

tl::expected<Object, Fault> read_box(const json& value, std::vector<model::JsonStep> path) {
  const auto type = member_of(value, path, "class");
  if (!type) return tl::unexpected(type.error());
  if (!type->value.is_string()) {
    return tl::unexpected(
        Fault{type->path, "a value of the wrong type", type->value.type_name(), "a string"});
  }
  const auto box = member_of(value, std::move(path), "box_xyz_lwh_yaw_lidar");
  if (!box) return tl::unexpected(box.error());
  Object object;
  object.type = class_named(type->value.get<std::string>());
  object.confidence = 1.0;
  if (auto fault = place_box(*box, object)) return tl::unexpected(*std::move(fault));
  return object;
}

tl::expected<std::vector<Object>, Fault> read_boxes(const json& file) {
  const auto list = member_of(file, {}, "boxes");
  if (!list) return tl::unexpected(list.error());
  if (!list->value.is_array()) {
    return tl::unexpected(
        Fault{list->path, "a value of the wrong type", list->value.type_name(), "an array"});
  }
  std::vector<Object> boxes;
  for (std::size_t i = 0; i < list->value.size(); ++i) {
    auto box = read_box(list->value[i], {"boxes", i});
    if (!box) return tl::unexpected(std::move(box).error());
    box->id = static_cast<int>(i);
    boxes.push_back(*std::move(box));
  }
  return boxes;
}

/// Puts "" in the place of a word that begins at `at` and is no number of JSON; how many bytes it has beyond
/// the first.
std::size_t blanked(std::string& text, std::size_t at) {
  for (const std::string_view word : {"NaN", "Infinity", "-Infinity"}) {
    if (!std::string_view(text).substr(at).starts_with(word)) continue;
    text.replace(at, word.size(), "\"\"" + std::string(word.size() - 2, ' '));
    return word.size() - 1;
  }
  return 0;
}

/// The file with "" in the place of NaN, Infinity and -Infinity outside of strings, which Python writes and
/// JSON does not have. All else keeps its place.
std::string as_json(std::string_view text) {
  std::string out(text);
  bool is_quoted = false;
  for (std::size_t i = 0; i < out.size(); ++i) {
    if (is_quoted && out[i] == '\\') {
      ++i;
    } else if (out[i] == '"') {
      is_quoted = !is_quoted;
    } else if (!is_quoted) {
      i += blanked(out, i);
    }
  }
  return out;
}

}  // namespace

Expected<std::vector<Object>> read_nuscenes_boxes(const std::filesystem::path& path) {
  constexpr std::uint64_t kMemory = 32;  // bytes for each byte of "[1,1,1,..."
  auto input = io::Input::open(path, {});
  if (!input) return Unexpected(std::move(input).error());
  if (auto allowed = input->allow(0, kMemory * input->size()); !allowed) return Unexpected(allowed.error());
  const auto bytes = input->read(0, input->size());
  if (!bytes) return Unexpected(bytes.error());
  const std::string text = as_json(io::as_text(*bytes));
  if (const auto fault = model::find_syntax_fault(text)) {
    return Unexpected(Error{ErrorCode::kUnusable,
                            input->name(),
                            model::line_and_column(text, fault->column, 1),
                            fmt::format("not JSON: {}", fault->what),
                            {},
                            {}});
  }
  auto boxes = read_boxes(json::parse(text));
  if (boxes) return *std::move(boxes);
  const Fault& fault = boxes.error();
  return Unexpected(Error{ErrorCode::kUnusable, input->name(),
                          model::line_and_column(text, model::column_of(text, fault.path), 1), fault.what,
                          fault.got, fault.need});
}

}  // namespace verge::eval
