// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "verge/core/field_io.hpp"
#include "verge/detect/detector.hpp"

namespace verge::detect {

/// What a method says of a scan. Corners and objects that it does not say are not judged; nor, where no
/// method is named, are boundaries that it gives only a piece of.
struct Says {
  bool boundaries = true;
  bool corners = false;
  bool objects = false;
};

/// A method by name: what it is, where it comes from, and how to make it.
struct Method {
  std::string_view name;      ///< As in --method, and the section of its settings in a file.
  std::string_view summary;   ///< One line.
  std::string_view citation;  ///< The paper.
  Order order = Order::kSequential;
  Says says;
  /// Its settings with the overrides applied. Throws std::invalid_argument as set_field().
  std::vector<FieldRow> (*fields)(std::span<const Setting> overrides);
  /// The detector with the overrides applied. Throws std::invalid_argument as set_field().
  std::unique_ptr<Detector> (*make)(std::span<const Setting> overrides);
};

/// Every method there is, the default one first.
[[nodiscard]] std::span<const Method> methods();

/// The method of that name. Throws std::invalid_argument with the nearest known name where there is none.
[[nodiscard]] const Method& method_named(std::string_view name);

/// A detector by the name of its method, with its defaults but for the overrides:
/// make("gradient", {{"height_max_m", "0.4"}}). Throws std::invalid_argument where there is no such method
/// or key, or a value is outside its range.
[[nodiscard]] std::unique_ptr<Detector> make(std::string_view name,
                                             const std::vector<Setting>& overrides = {});

}  // namespace verge::detect
