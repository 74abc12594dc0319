// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "verge/core/error.hpp"
#include "verge/core/vec.hpp"
#include "verge/model/json_text.hpp"
#include "verge/model/scene.hpp"

namespace verge::emit {

/// Where in the record a value stands: a chain up to the record itself, which has no step.
struct Place {
  const Place* parent = nullptr;
  model::JsonStep step = std::size_t{0};
};

/// Reads values out of a parsed record and remembers the first one that cannot be used. After that the rest
/// is still read, to no purpose: the record is refused as a whole.
class RecordReader {
 public:
  RecordReader(std::string_view line, std::size_t line_number) : line_(line), line_number_(line_number) {}

  [[nodiscard]] const std::optional<Error>& fault() const { return fault_; }

  void fail(const Place& place, std::string what, std::string got, std::string need) {
    if (fault_) return;
    std::vector<model::JsonStep> path;
    for (const Place* p = &place; p->parent != nullptr; p = p->parent) path.push_back(p->step);
    std::reverse(path.begin(), path.end());
    fault_ = Error{ErrorCode::kUnusable,
                   {},
                   fmt::format("{}:{}", line_number_, model::column_of(line_, path)),
                   std::move(what),
                   std::move(got),
                   std::move(need)};
  }

  /// True where `value` has the type; else the reader fails.
  bool expect(bool is, const nlohmann::json& value, const Place& place, std::string_view need) {
    if (!is) fail(place, "a value of the wrong type", value.type_name(), std::string(need));
    return is;
  }

  /// Calls read(value, place) for the member, where it is there and not null.
  template <class Read>
  void member(const nlohmann::json& object, const Place& place, std::string_view name, Read&& read) {
    const auto found = object.find(name);
    if (found != object.end() && !found->is_null()) read(*found, Place{&place, name});
  }

  /// As member(); without the member the reader fails.
  template <class Read>
  void needed_member(const nlohmann::json& object, const Place& place, std::string_view name, Read&& read) {
    bool found = false;
    member(object, place, name, [&](const nlohmann::json& value, const Place& at) {
      found = true;
      read(value, at);
    });
    if (!found) fail(place, "an object without what it needs", {}, fmt::format("\"{}\"", name));
  }

  /// Calls read(element, place) for every element of an array.
  template <class Read>
  void each(const nlohmann::json& array, const Place& place, Read&& read) {
    if (!expect(array.is_array(), array, place, "an array")) return;
    for (std::size_t i = 0; i < array.size(); ++i) read(array[i], Place{&place, i});
  }

  [[nodiscard]] double number(const nlohmann::json& value, const Place& place) {
    return expect(value.is_number(), value, place, "a number") ? value.get<double>() : 0.0;
  }

  /// An array of so many numbers; `what` stands in the error.
  template <std::size_t kCount>
  [[nodiscard]] std::array<double, kCount> numbers(const nlohmann::json& value, const Place& place,
                                                   std::string_view what) {
    std::vector<double> read;
    each(value, place, [&](const nlohmann::json& v, const Place& at) { read.push_back(number(v, at)); });
    std::array<double, kCount> numbers{};
    if (read.size() == kCount) {
      std::copy(read.begin(), read.end(), numbers.begin());
    } else {
      fail(place, fmt::format("{} of the wrong length", what), fmt::format("{} numbers", read.size()),
           std::to_string(kCount));
    }
    return numbers;
  }

  [[nodiscard]] Vec2 pair(const nlohmann::json& value, const Place& place) {
    const auto xy = numbers<2>(value, place, "a point");
    return {xy[0], xy[1]};
  }

  /// [x, y] or [x, y, z, ...]; z is 0 where it is missing, and what stands behind it is not looked at.
  [[nodiscard]] Vec3 point(const nlohmann::json& value, const Place& place) {
    if (!expect(value.is_array(), value, place, "an array")) return {};
    if (value.size() < 2) {
      fail(place, "a point of the wrong length", fmt::format("{} numbers", value.size()), "2 or 3");
      return {};
    }
    const auto coordinate = [&](std::size_t i) { return number(value[i], Place{&place, i}); };
    return {coordinate(0), coordinate(1), value.size() > 2 ? coordinate(2) : 0.0};
  }

  [[nodiscard]] double share(const nlohmann::json& value, const Place& place) {
    const double number_read = number(value, place);
    if (number_read < 0.0 || number_read > 1.0) {
      fail(place, "a share out of range", fmt::format("{}", number_read), "0 to 1");
    }
    return number_read;
  }

  template <class Int>
  [[nodiscard]] Int integer(const nlohmann::json& value, const Place& place) {
    if (!expect(value.is_number_integer(), value, place, "an integer")) return 0;
    const bool fits = value.is_number_unsigned() ? std::in_range<Int>(value.get<std::uint64_t>())
                                                 : std::in_range<Int>(value.get<std::int64_t>());
    if (fits) return value.get<Int>();
    fail(place, "an integer out of range", value.dump(),
         fmt::format("{} to {}", std::numeric_limits<Int>::min(), std::numeric_limits<Int>::max()));
    return 0;
  }

  [[nodiscard]] std::string text(const nlohmann::json& value, const Place& place) {
    return expect(value.is_string(), value, place, "a string") ? value.get<std::string>() : std::string();
  }

  template <class Enum>
  [[nodiscard]] Enum named(const nlohmann::json& value, const Place& place) {
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

}  // namespace verge::emit
