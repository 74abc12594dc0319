// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "verge/core/fields.hpp"
#include "verge/core/vec.hpp"
#include "verge/sim/center_line.hpp"
#include "verge/sim/thing.hpp"

namespace verge::sim {

/// Left or right of a road, looking along it.
enum class RoadSide : std::uint8_t { kLeft, kRight };

/// What bounds a carriageway.
enum class Edge : std::uint8_t {
  kKerb,   ///< A step up to a sidewalk.
  kFlush,  ///< A sidewalk at the same height: a painted edge.
  kGrass,  ///< Ground that falls away slowly.
  kDitch,  ///< A shoulder of 1 m and a ditch 0.6 m deep.
  kWall,   ///< A wall.
};

/// The section of a kerb's face.
enum class KerbFace : std::uint8_t {
  kVertical,
  kSloped,  ///< As wide as 0.6 of its height.
  kWorn,    ///< Rounded: as wide as half of its height.
};

}  // namespace verge::sim

namespace verge {
template <>
inline constexpr std::array enum_names<sim::RoadSide> = std::to_array<std::string_view>({"left", "right"});
template <>
inline constexpr std::array enum_names<sim::Edge> =
    std::to_array<std::string_view>({"kerb", "flush", "grass", "ditch", "wall"});
template <>
inline constexpr std::array enum_names<sim::KerbFace> =
    std::to_array<std::string_view>({"vertical", "sloped", "worn"});
}  // namespace verge

namespace verge::sim {

/// A width at a station; between two of them it changes evenly.
struct WidthAt {
  double at_m = 0.0;
  double width_m = 8.0;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor&& visit) {
    visit(self.at_m, {"at_m", "m", 0.0, 1e4, "station along the road", "ours"});
    visit(self.width_m,
          {"width_m", "m", 1.0, 40.0,
           "width there; it changes evenly from the one before, at first from the road's own", "ours"});
  }
};

/// A height at a station; between two of them the road climbs evenly.
struct HeightAt {
  double at_m = 0.0;
  double height_m = 0.0;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor&& visit) {
    visit(self.at_m, {"at_m", "m", 0.0, 1e4, "station along the road", "ours"});
    visit(self.height_m,
          {"height_m", "m", -200.0, 200.0, "height of the road there; even slopes between, rounded", "ours"});
  }
};

/// A stretch of lowered kerb.
struct Gap {
  RoadSide side = RoadSide::kRight;
  double at_m = 0.0;
  double width_m = 2.0;
  double height_m = 0.0;
  double ramp_m = 0.3;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor&& visit) {
    visit(self.side, {"side", "", 0, 0, "side of the road", "ours"});
    visit(self.at_m, {"at_m", "m", 0.0, 1e4, "station of its middle", "ours"});
    visit(self.width_m, {"width_m", "m", 0.2, 50.0, "width at the lowered height", "ours"});
    visit(self.height_m, {"height_m", "m", 0.0, 0.2, "height of the lowered kerb; 0 = a gap", "ours"});
    visit(self.ramp_m, {"ramp_m", "m", 0.05, 5.0, "length of the ramp to each side of it", "ours"});
  }
};

/// A stretch where the carriageway is wider on one side.
struct Bay {
  RoadSide side = RoadSide::kRight;
  double at_m = 0.0;
  double length_m = 20.0;
  double depth_m = 2.0;
  double taper_m = 1.5;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor&& visit) {
    visit(self.side, {"side", "", 0, 0, "side of the road", "ours"});
    visit(self.at_m, {"at_m", "m", 0.0, 1e4, "station where it begins", "ours"});
    visit(self.length_m, {"length_m", "m", 1.0, 500.0, "length at full depth", "ours"});
    visit(self.depth_m, {"depth_m", "m", 0.2, 10.0, "how much wider the carriageway is", "ours"});
    visit(self.taper_m, {"taper_m", "m", 0.1, 30.0, "length over which it widens, at both ends", "ours"});
  }
};

/// A kerbed island in the carriageway, with round ends.
struct Island {
  double at_m = 0.0;
  double lateral_m = 0.0;
  double length_m = 8.0;
  double width_m = 1.6;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor&& visit) {
    visit(self.at_m, {"at_m", "m", 0.0, 1e4, "station where it begins", "ours"});
    visit(self.lateral_m, {"lateral_m", "m", -20.0, 20.0, "its middle, left of the centre line", "ours"});
    visit(self.length_m, {"length_m", "m", 1.0, 200.0, "length", "ours"});
    visit(self.width_m, {"width_m", "m", 0.4, 20.0, "width; not more than the length", "ours"});
  }
};

/// Things in a row along a road, all alike. A mouth of a branch stays free.
struct Row {
  Thing what = Thing::kCar;
  RoadSide side = RoadSide::kRight;
  double from_m = 0.0;
  double to_m = 1e4;
  double beside_m = 0.5;
  double gap_m = 1.5;
  double length_m = 0.0;
  double width_m = 0.0;
  double height_m = 0.0;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor&& visit) {
    visit(self.what, {"what", "", 0, 0, "what stands there", "ours"});
    visit(self.side, {"side", "", 0, 0, "side of the road", "ours"});
    visit(self.from_m, {"from_m", "m", 0.0, 1e4, "station where the row begins", "ours"});
    visit(self.to_m, {"to_m", "m", 0.0, 1e4, "station where it ends; at most the road's end", "ours"});
    visit(self.beside_m,
          {"beside_m", "m", -20.0, 100.0,
           "from the edge of the carriageway outward to the nearer side of the row; negative: on "
           "the carriageway",
           "ours"});
    visit(self.gap_m, {"gap_m", "m", 0.0, 500.0, "from one to the next; of no use for walls, rails, hedges",
                       "paper 1: gaps between parked cars"});
    visit(self.length_m, {"length_m", "m", 0.0, 50.0, "length of each; 0 = usual", "ours"});
    visit(self.width_m, {"width_m", "m", 0.0, 50.0, "width; 0 = usual", "ours"});
    visit(self.height_m, {"height_m", "m", 0.0, 50.0, "height; 0 = usual", "ours"});
  }
};

/// One thing on a road or beside it, at rest or moving.
struct Item {
  Thing what = Thing::kCar;
  double at_m = 0.0;
  double lateral_m = 0.0;
  double yaw_deg = 0.0;
  double speed_mps = 0.0;
  double across_mps = 0.0;
  double length_m = 0.0;
  double width_m = 0.0;
  double height_m = 0.0;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor&& visit) {
    visit(self.what, {"what", "", 0, 0, "what it is; not a wall, guard_rail or hedge", "ours"});
    visit(self.at_m, {"at_m", "m", 0.0, 1e4, "station of its middle at the start", "ours"});
    visit(self.lateral_m,
          {"lateral_m", "m", -100.0, 100.0, "its middle then, left of the centre line", "ours"});
    visit(self.yaw_deg,
          {"yaw_deg", "deg", -360.0, 360.0, "turn of its length from the road's direction", "ours"});
    visit(self.speed_mps, {"speed_mps", "m/s", -60.0, 60.0,
                           "how fast it moves along the road; negative: against it", "ours"});
    visit(self.across_mps, {"across_mps", "m/s", -20.0, 20.0, "how fast it moves to the left", "ours"});
    visit(self.length_m, {"length_m", "m", 0.0, 50.0, "length; 0 = usual", "ours"});
    visit(self.width_m, {"width_m", "m", 0.0, 50.0, "width; 0 = usual", "ours"});
    visit(self.height_m, {"height_m", "m", 0.0, 50.0, "height; 0 = usual", "ours"});
  }
};

/// A road: where it runs, how wide it is, and what bounds it. A road that stands by itself begins at a place
/// of the plane; a branch begins on the centre line of a road before it in the list, and kerb returns join
/// the edges of both.
// NOLINTNEXTLINE(clang-analyzer-optin.performance.Padding): in the order in which the keys are told
struct RoadConfig {
  std::int64_t branch_of = 0;
  double at_m = 0.0;
  RoadSide side = RoadSide::kRight;
  double angle_deg = 90.0;
  double radius_m = 3.0;
  bool driveway = false;
  double x_m = 0.0;
  double y_m = 0.0;
  double heading_deg = 0.0;
  bool closed = false;
  bool dead_end = false;
  double width_m = 8.0;
  Edge left = Edge::kKerb;
  Edge right = Edge::kKerb;
  double kerb_m = 0.12;
  KerbFace face = KerbFace::kVertical;
  double sidewalk_m = 2.0;
  double wall_m = 2.5;
  double vertical_curve_m = 20.0;
  std::vector<Piece> pieces{};
  std::vector<WidthAt> widths{};
  std::vector<HeightAt> heights{};
  std::vector<Gap> gaps{};
  std::vector<Bay> bays{};
  std::vector<Island> islands{};
  std::vector<Row> rows{};
  std::vector<Item> items{};

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor&& visit) {
    visit(self.branch_of,
          {"branch_of", "1", 0, 1000,
           "number of the road that it branches off, 1 is the first; 0 = stands by itself", "ours"});
    visit(self.at_m, {"at_m", "m", 0.0, 1e4, "of a branch: station on the other road's centre line", "ours"});
    visit(self.side, {"side", "", 0, 0, "of a branch: side of the other road", "ours"});
    visit(self.angle_deg, {"angle_deg", "deg", 30.0, 150.0,
                           "of a branch: turn from the other road's direction to its own", "ours"});
    visit(self.radius_m, {"radius_m", "m", 0.05, 50.0, "of a branch: radius of its kerb returns", "paper 1"});
    visit(self.driveway, {"driveway", "", 0, 0,
                          "of a branch: no road to turn into, so an opening but neither corner nor junction",
                          "paper 1: false corners"});
    visit(self.x_m, {"x_m", "m", -2000.0, 2000.0, "where a road by itself begins, east", "ours"});
    visit(self.y_m, {"y_m", "m", -2000.0, 2000.0, "where a road by itself begins, north", "ours"});
    visit(self.heading_deg,
          {"heading_deg", "deg", -360.0, 360.0,
           "direction in which a road by itself begins, from east counter-clockwise", "ours"});
    visit(self.closed, {"closed", "", 0, 0, "it comes back to its start: a loop", "ours"});
    visit(self.dead_end, {"dead_end", "", 0, 0, "its edge goes round its end; else it ends open", "ours"});
    visit(self.width_m, {"width_m", "m", 1.0, 40.0, "from edge to edge", "paper 1: 4-5, paper 3: 6 and 13"});
    visit(self.left, {"left", "", 0, 0, "what bounds it on the left", "ours"});
    visit(self.right, {"right", "", 0, 0, "what bounds it on the right", "ours"});
    visit(self.kerb_m, {"kerb_m", "m", 0.0, 0.3, "height of its kerbs", "paper 1: 0.12-0.15"});
    visit(self.face, {"face", "", 0, 0, "section of its kerbs' faces", "ours"});
    visit(self.sidewalk_m, {"sidewalk_m", "m", 0.0, 20.0, "width of its sidewalks", "ours"});
    visit(self.wall_m, {"wall_m", "m", 0.1, 20.0, "height of its walls, where a wall bounds it", "ours"});
    visit(self.vertical_curve_m, {"vertical_curve_m", "m", 0.0, 500.0,
                                  "length over which one slope of its heights turns into the next", "ours"});
  }
};

/// A place on an edge of a road.
struct EdgePoint {
  Vec2 position;
  Vec2 outward;  ///< Unit normal away from the carriageway.
};

/// A road as geometry. Stations are counted along its centre line from its start.
class Road {
 public:
  /// `start` is where its centre line begins. Throws std::invalid_argument where the line makes no sense, or
  /// a curve is tighter than the road is wide.
  Road(RoadConfig config, const Station& start);

  [[nodiscard]] const RoadConfig& config() const { return config_; }
  [[nodiscard]] const CenterLine& line() const { return line_; }
  [[nodiscard]] double length_m() const { return line_.length_m(); }

  /// Half the width without bays.
  [[nodiscard]] double half_width(double station_m) const;
  /// Distance of the edge from the centre line, bays included.
  [[nodiscard]] double edge_offset(RoadSide side, double station_m) const;
  [[nodiscard]] EdgePoint edge_point(RoadSide side, double station_m) const;
  [[nodiscard]] Edge edge(RoadSide side) const {
    return side == RoadSide::kLeft ? config_.left : config_.right;
  }
  /// Height of the step at the edge: of kerb or wall, lowered in gaps; 0 without.
  [[nodiscard]] double step_height(RoadSide side, double station_m) const;
  /// Stations where that edge has a corner or its height one, in order.
  [[nodiscard]] std::vector<double> breaks(RoadSide side) const;

  /// Height of the centre line over that of the world's origin.
  [[nodiscard]] double profile(double station_m) const;

 private:
  [[nodiscard]] double profile_area(double station_m) const;

  RoadConfig config_;
  CenterLine line_;
};

/// +1 for left, -1 for right.
[[nodiscard]] double sign_of(RoadSide side);
[[nodiscard]] RoadSide opposite(RoadSide side);

/// The roads of a list, each where it begins. Throws std::invalid_argument with the number of the road that
/// makes no sense.
[[nodiscard]] std::vector<Road> make_roads(const std::vector<RoadConfig>& configs);

}  // namespace verge::sim
