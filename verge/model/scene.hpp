// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "verge/core/fields.hpp"
#include "verge/core/vec.hpp"

namespace verge {

/// Which side of the vehicle's road a boundary bounds, looking forward.
enum class Side : std::uint8_t { kLeft, kRight, kIsland, kOther };
template <>
inline constexpr std::array enum_names<Side> =
    std::to_array<std::string_view>({"left", "right", "island", "other"});

/// What a boundary's points are the vertices of.
enum class Model : std::uint8_t { kLine, kSpline, kPolyline };
template <>
inline constexpr std::array enum_names<Model> =
    std::to_array<std::string_view>({"line", "spline", "polyline"});

enum class BoundaryKind : std::uint8_t { kCurb, kVerge, kWall, kBarrier, kFlush, kUnknown };
template <>
inline constexpr std::array enum_names<BoundaryKind> =
    std::to_array<std::string_view>({"curb", "verge", "wall", "barrier", "flush", "unknown"});

/// How a boundary point is known: seen in this scan, bridged over a stretch without evidence between seen
/// ones, or inferred behind something that hides it.
enum class PointState : std::uint8_t { kVisible, kBridged, kOccluded };
template <>
inline constexpr std::array enum_names<PointState> =
    std::to_array<std::string_view>({"visible", "bridged", "occluded"});

/// One edge of the road as an ordered polyline, at the foot of the step on the road's side.
/// Frame: the scan's sensor frame (x forward, y left, z up), metres.
struct Boundary {
  int id = 0;
  Side side = Side::kOther;
  Model model = Model::kPolyline;
  BoundaryKind kind = BoundaryKind::kUnknown;
  double confidence = 0.0;        ///< 0..1
  std::vector<Vec3> points;       ///< In order along the road, front last.
  std::vector<double> height_m;   ///< Step height at each point; empty where the method does not measure it.
  std::vector<PointState> state;  ///< For each point; empty where the method does not tell.
};

/// What the sensor could not see from (counter-clockwise) to, radians in [-pi, pi].
struct Sector {
  double from_rad = 0.0;
  double to_rad = 0.0;
};

/// Whether the scan itself was fit to be used.
struct Health {
  std::string state = "ok";        ///< "ok" or "degraded".
  double completeness = 1.0;       ///< Share of the directions of a full turn that gave a return, 0..1.
  std::vector<Sector> unobserved;  ///< Never to be read as free.
};

/// What verge says about one scan, and what truth says of it: results and truth share this vocabulary.
/// Parts that a method does not make are empty and left out of the output.
struct Scene {
  std::string frame;                     ///< The scan's name: file name without suffix, or a running number.
  std::optional<std::int64_t> stamp_ns;  ///< Time of the scan's first point, ns since the Unix epoch.
  std::string frame_id = "sensor";
  std::vector<Boundary> boundaries;
  std::optional<Health> health;
  std::string method;
  std::string version;
  std::string config_hash;
};

/// The spelling of an enum value in every output.
template <class Enum>
[[nodiscard]] constexpr std::string_view name_of(Enum value) {
  return enum_names<Enum>.at(static_cast<std::size_t>(value));
}

/// The value that is spelled `name`, if any.
template <class Enum>
[[nodiscard]] constexpr std::optional<Enum> value_named(std::string_view name) {
  for (std::size_t i = 0; i < enum_names<Enum>.size(); ++i) {
    if (enum_names<Enum>[i] == name) return static_cast<Enum>(i);
  }
  return std::nullopt;
}

}  // namespace verge
