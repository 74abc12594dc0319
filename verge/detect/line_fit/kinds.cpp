// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/detect/line_fit/kinds.hpp"

#include <algorithm>
#include <cmath>

namespace verge::detect::line_fit {
namespace {

// Sizes that part the classes, metres.
constexpr double kPole_m = 0.3;
constexpr double kPerson_m = 0.7;
constexpr double kVehicle_m = 1.2;
constexpr double kWide_m = 2.3;
constexpr double kCar_m = 5.2;
constexpr double kVan_m = 6.5;
constexpr double kWall_m = 8.0;  // with one face alone
constexpr double kTruck_m = 13.0;
constexpr double kCorner_m = 3.0;  // both ways: two walls
constexpr double kRough_m = 0.1;
constexpr std::size_t kFewReturns = 3;

/// The edge that the length of a vehicle runs along: a side wider than a vehicle, not one that is known to be
/// shorter than a car, and else that which runs along the road.
std::size_t length_edge(const Outline& outline) {
  const auto& [a, b] = outline.extent;
  if (std::max(a.seen_m(), b.seen_m()) > kWide_m) return a.seen_m() >= b.seen_m() ? 0 : 1;
  const bool a_is_short = a.bound_m() < kWide_m;
  const bool b_is_short = b.bound_m() < kWide_m;
  if (a_is_short != b_is_short) return a_is_short ? 1 : 0;
  return std::fabs(outline.onward[0].x) >= std::fabs(outline.onward[1].x) ? 0 : 1;
}

/// How far the seen part lies beyond the road's edge, metres; negative: on the road or nobody knows.
double beyond_m(const Outline& outline, const RoadSides& road) {
  const double y = outline.corner.y;
  if (road.left_m && y > 0.0) return y - *road.left_m;
  if (road.right_m && y < 0.0) return *road.right_m - y;
  return -1.0;
}

/// How long its faces can be.
double bound_m(const Outline& outline) {
  return std::max(outline.face[0] ? outline.extent[0].bound_m() : 0.0,
                  outline.face[1] ? outline.extent[1].bound_m() : 0.0);
}

/// Sizes of what is not completed to a known size.
Kind shown(ObjectClass type, double confidence, const ObjectsConfig& config) {
  return {.type = type, .confidence = confidence, .length_m = config.person_m, .width_m = config.person_m};
}

Kind small_kind(const Outline& outline, const ObjectsConfig& config, double beyond) {
  if (beyond > config.sidewalk_m) return shown(ObjectClass::kRoadside, 0.8, config);
  if (bound_m(outline) < kPole_m) return shown(ObjectClass::kPole, 0.5, config);
  return shown(ObjectClass::kPerson, outline.returns > kFewReturns ? 0.99 : 0.95, config);
}

ObjectClass vehicle_of(const Extent& length) {
  if (length.seen_m() > kVan_m) return ObjectClass::kTruck;
  return length.seen_m() > kCar_m ? ObjectClass::kVan : ObjectClass::kCar;
}

/// Shares of boxes that were right on drives of suite paper2 that its table does not show (1001 to 1030).
double vehicle_confidence(const Outline& outline, const Extent& length) {
  if (outline.face[0] && outline.face[1]) return 0.99;
  if (outline.returns <= kFewReturns) return 0.88;
  return length.seen_m() > kWide_m ? 0.99 : 0.96;
}

/// Whether it is longer than any vehicle, or rougher than any, as hedges and banks are.
bool is_no_vehicle(const Outline& outline, const Extent& length, const Extent& width) {
  const bool one_face = !(outline.face[0] && outline.face[1]);
  return outline.rough_m > kRough_m || length.seen_m() > (one_face ? kWall_m : kTruck_m) ||
         width.seen_m() > kCorner_m;
}

Kind large_kind(const Outline& outline, const ObjectsConfig& config, double beyond) {
  constexpr double kBeyond_m = 0.3;
  const std::size_t edge = length_edge(outline);
  const Extent& length = outline.extent.at(edge);
  const Extent& width = outline.extent.at(1 - edge);
  Kind kind{.type = vehicle_of(length),
            .confidence = vehicle_confidence(outline, length),
            .length_m = config.car_length_m,
            .width_m = config.car_width_m};
  if (beyond > kBeyond_m || is_no_vehicle(outline, length, width)) {
    kind = shown(ObjectClass::kRoadside, 0.8, config);
  } else if (bound_m(outline) < kVehicle_m) {
    kind = shown(ObjectClass::kUnknown, 0.5, config);
  }
  kind.length_edge = edge;
  return kind;
}

/// Whether it stands in a row of cars.
bool is_in_row(const Outline& outline, std::span<const Row> rows) {
  constexpr double kBeside_m = 0.3;
  return std::ranges::any_of(rows, [&](const Row& row) {
    return std::fabs(cross(row.along, outline.corner - row.place)) < kBeside_m;
  });
}

/// Whether it may be a part of a car: a face goes on where the scan ends; or in a row of cars, behind what
/// stands nearer, or because there are too few returns to tell.
bool is_part(const Outline& outline, std::span<const Row> rows) {
  const auto any_face = [&](bool (Extent::*is)() const) {
    return (outline.face[0] && (outline.extent[0].*is)()) || (outline.face[1] && (outline.extent[1].*is)());
  };
  if (any_face(&Extent::is_cut)) return true;
  return (outline.returns <= kFewReturns || any_face(&Extent::is_hidden)) && is_in_row(outline, rows);
}

}  // namespace

Kind kind_of(const Outline& outline, const ObjectsConfig& config, const RoadSides& road,
             std::span<const Row> rows) {
  const auto& [a, b] = outline.extent;
  const double beyond = beyond_m(outline, road);
  const bool is_small = std::max(a.seen_m(), b.seen_m()) <= kPerson_m && !is_part(outline, rows);
  return is_small ? small_kind(outline, config, beyond) : large_kind(outline, config, beyond);
}

std::optional<Row> row_of(const Outline& outline, const Kind& kind) {
  constexpr double kKnown_m = 1.5;
  const bool is_known =
      outline.face.at(kind.length_edge) && outline.extent.at(kind.length_edge).seen_m() > kKnown_m;
  if (kind.type != ObjectClass::kCar || !is_known) return std::nullopt;
  return Row{outline.corner, outline.onward.at(kind.length_edge)};
}

}  // namespace verge::detect::line_fit
