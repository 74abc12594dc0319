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

/// A gap between two boundaries through which one can leave the road: a side road's mouth, a driveway.
struct Opening {
  std::array<Vec2, 2> ends;  ///< Where the boundary stops and where it goes on, near end first.
  double width_m = 0.0;      ///< From end to end.
  double confidence = 0.0;   ///< 0..1
};

/// To which side the road can be left at a corner.
enum class CornerSide : std::uint8_t { kLeft, kRight, kBoth };
template <>
inline constexpr std::array enum_names<CornerSide> =
    std::to_array<std::string_view>({"left", "right", "both"});

/// Where a side road begins ahead: the corner at which the boundary turns away.
struct Corner {
  int id = 0;
  CornerSide side = CornerSide::kLeft;
  Vec2 position;                       ///< Of the near corner.
  std::optional<double> sigma_m{};     ///< Standard deviation of the position.
  std::optional<double> distance_m{};  ///< To the corner along the road, from the sensor.
  std::optional<double> width_m{};     ///< Of the side road.
  std::optional<double> exit_m{};      ///< To where the side road has been passed, along the road.
  double confidence = 0.0;             ///< 0..1
};

/// What kind of meeting of roads lies ahead, as seen from the vehicle's road: a side road to the left or to
/// the right, the end at a road across (T), one that goes on across, a roundabout, an end without a way on.
enum class JunctionType : std::uint8_t { kLeft, kRight, kT, kCrossing, kRoundabout, kDeadEnd };
template <>
inline constexpr std::array enum_names<JunctionType> =
    std::to_array<std::string_view>({"left", "right", "T", "crossing", "roundabout", "dead_end"});

struct Junction {
  JunctionType type = JunctionType::kCrossing;
  Vec2 center;
  /// Directions from the center in which a road leaves, from +x counter-clockwise; that to the vehicle
  /// included.
  std::vector<double> branches_rad{};
  double confidence = 0.0;  ///< 0..1
};

enum class ObjectClass : std::uint8_t { kCar, kVan, kTruck, kCyclist, kPerson, kPole, kRoadside, kUnknown };
template <>
inline constexpr std::array enum_names<ObjectClass> = std::to_array<std::string_view>(
    {"car", "van", "truck", "cyclist", "person", "pole", "roadside", "unknown"});

/// Which faces of an object the sensor sees, drawn as from above with the sensor below (paper 2): the near
/// face alone, also the right flank, also the left flank.
enum class ObjectShape : std::uint8_t { kFace, kJ, kL };
template <>
inline constexpr std::array enum_names<ObjectShape> = std::to_array<std::string_view>({"-", "J", "L"});

/// Length, width and height of a box, metres.
struct BoxSize {
  double length_m = 0.0;
  double width_m = 0.0;
  double height_m = 0.0;

  friend bool operator==(const BoxSize&, const BoxSize&) = default;
};

/// What stands or moves on the road or beside it, as an upright box.
struct Object {
  int id = 0;
  ObjectClass type = ObjectClass::kUnknown;
  std::optional<ObjectShape> shape{};  ///< None where the method does not tell.
  Vec3 center;                         ///< Of the box.
  BoxSize size{};                      ///< Along its heading, across it, upright.
  double yaw_rad = 0.0;                ///< Heading from +x, counter-clockwise.
  double confidence = 0.0;             ///< 0..1
};

/// Width of the road at a distance ahead.
struct RoadWidth {
  double distance_m = 0.0;
  double width_m = 0.0;

  friend bool operator==(const RoadWidth&, const RoadWidth&) = default;
};

/// The road as a surface.
struct RoadSurface {
  std::vector<RoadWidth> width_m{};  ///< In order of distance.
  std::vector<Vec2> polygon{};  ///< Outline of the drivable surface that was seen, counter-clockwise; what
                                ///< lies outside was not seen, and is never to be read as blocked or free.
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
/// Parts that a method does not make are empty and left out of the output (boundaries are always written).
/// Everything is in the scan's sensor frame, metres and radians; what is flat has no height.
struct Scene {
  std::string frame;                     ///< The scan's name: file name without suffix, or a running number.
  std::optional<std::int64_t> stamp_ns;  ///< Time of the scan's first point, ns since the Unix epoch.
  std::string frame_id = "sensor";
  std::vector<Boundary> boundaries;
  std::vector<Opening> openings{};
  std::vector<Corner> corners{};
  std::vector<Junction> junctions{};
  std::vector<Object> objects{};
  std::optional<RoadSurface> road{};
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
