// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "verge/core/vec.hpp"
#include "verge/detect/line_fit/box.hpp"
#include "verge/detect/line_fit/objects.hpp"
#include "verge/model/scene.hpp"

namespace verge::detect::line_fit {

/// What an outline is taken for.
struct Kind {
  ObjectClass type = ObjectClass::kUnknown;
  double confidence = 0.0;      ///< Of the class.
  std::size_t length_edge = 0;  ///< The edge of the outline that the object's length runs along.
  double length_m = 0.0;        ///< Usual size of the class.
  double width_m = 0.0;
};

/// A straight line that cars stand along.
struct Row {
  Vec2 place;
  Vec2 along;  ///< Unit vector.
};

/// By size, as far as it was seen and can be, and by place. What is small because the rest of it is hidden is
/// a car where it stands in one of the rows.
[[nodiscard]] Kind kind_of(const Outline& outline, const ObjectsConfig& config, const RoadSides& road,
                           std::span<const Row> rows = {});

/// The flank of a car that is known to be one by its size; none of others.
[[nodiscard]] std::optional<Row> row_of(const Outline& outline, const Kind& kind);

}  // namespace verge::detect::line_fit
