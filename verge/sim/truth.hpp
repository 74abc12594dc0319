// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "verge/core/pose.hpp"
#include "verge/core/vec.hpp"
#include "verge/model/scene.hpp"
#include "verge/sim/caster.hpp"
#include "verge/sim/furniture.hpp"
#include "verge/sim/land.hpp"

namespace verge::sim {

/// Where a vehicle is in the network of roads.
struct Whereabouts {
  std::size_t road = 0;
  double station_m = 0.0;
  double direction = 1.0;  ///< +1 along the road, -1 against it.
};

/// The moment of which truth is told.
struct TruthView {
  const Caster& world;  ///< With all that moves where it is at the moment; decides what is visible.
  Pose T_world_sensor;
  double heading_rad = 0.0;  ///< Of the vehicle, in the world.
  std::size_t road = 0;      ///< The road that it is on, where it is on several at once.
  double time_s = 0.0;       ///< After the start.
  double radius_m = 30.0;
  bool lines = true;  ///< Boundaries and openings too; they take most of the time.
};

/// What a perfect detector would say of a land and its furniture.
class Truth {
 public:
  /// The furniture and its land must outlive it.
  Truth(const Land& land, const Furniture& furniture);

  /// The scene in the sensor frame:
  ///
  /// Boundaries at the foot of the step, a vertex every 0.1 m of the outline and at its corners, within
  /// `radius_m` around the sensor in the plane. One that leaves the circle and comes back, or changes its
  /// kind, is given as several. Those that hold a left (right) edge of the vehicle's road have that side,
  /// with all that goes on from it round corners into side roads; the others are islands or `other`. Vertices
  /// run along the vehicle's direction, the last one foremost. Model: kLine where straight, else kPolyline.
  /// kCurb where the kerb is 3 cm high or more, else kFlush. kVisible where nothing stands between the sensor
  /// and a place 2 cm above the foot; the sensor's field of view does not count. Openings: the mouths of
  /// branches and gaps of the kerb of which an end lies within the radius. Corners and junctions: where
  /// branches that are no driveways leave the vehicle's road, up to the radius ahead, until they are passed;
  /// and the end of the vehicle's road. Corners of confidence 0 look like one and are none: driveways, gaps
  /// of the kerb, and gaps of 1 to 8 m between parked vehicles. `exit_m` is the far end of the mouth.
  /// Objects: all things within the radius, seen or not; a crown of a tree counts, a wall, guard rail or
  /// hedge does not.
  /// The road's width every 5 m ahead.
  [[nodiscard]] Scene scene(const TruthView& view) const;

  /// Where a vehicle is: on the road of this number if that is near and runs its way, else on the nearest
  /// that does.
  [[nodiscard]] Whereabouts whereabouts(Vec2 position, double heading_rad, std::size_t road) const;

 private:
  struct Point {
    Vec3 foot;
    double step_m = 0.0;
    BoundaryKind kind = BoundaryKind::kFlush;
  };
  struct EdgeName {
    std::size_t road = 0;
    RoadSide side = RoadSide::kLeft;
    friend bool operator==(const EdgeName&, const EdgeName&) = default;
  };
  struct Chain {  // of the outline between open ends of roads
    std::vector<Point> points;
    std::vector<EdgeName> edges;  // that are part of it
    bool hole = false;            // goes round something that stands in the carriageway
    bool closed = false;          // ends where it begins
  };

  void add_loop(std::size_t loop);
  void add_stretch(Chain& chain, std::size_t loop, std::size_t vertex) const;
  [[nodiscard]] Side side_of(const Chain& chain, const Whereabouts& where) const;
  void add_boundaries(const Chain& chain, const TruthView& view, const Whereabouts& where,
                      Scene& scene) const;
  void add_openings(const TruthView& view, Scene& scene) const;
  /// A stretch of a road's edge that opens, or looks so.
  struct Opened {
    int id = 0;
    RoadSide side = RoadSide::kLeft;
    double begin_m = 0.0;  // stations on the road
    double end_m = 0.0;
    Vec2 begin;
    Vec2 end;
    double width_m = 0.0;
    bool is_road = false;
  };
  struct Parked {
    std::uint32_t id = 0;
    double begin_m = 0.0;  // stations on the road
    double end_m = 0.0;
    double lateral_m = 0.0;  // of the side that shows towards the road's middle
  };

  void add_corner(const TruthView& view, const Whereabouts& where, const Opened& opened, Scene& scene) const;
  void add_false_corners(const TruthView& view, const Whereabouts& where, Scene& scene) const;
  [[nodiscard]] std::vector<Parked> parked_along(std::size_t road, RoadSide side) const;
  void add_corners(const TruthView& view, const Whereabouts& where, Scene& scene) const;
  void add_junctions(const TruthView& view, const Whereabouts& where, Scene& scene) const;
  void add_end(const TruthView& view, const Whereabouts& where, Scene& scene) const;
  void add_objects(const TruthView& view, Scene& scene) const;
  void add_widths(const TruthView& view, const Whereabouts& where, Scene& scene) const;
  [[nodiscard]] std::vector<double> ways_from(std::size_t road, double station,
                                              const std::vector<Mouth>& mouths,
                                              const Pose& T_sensor_world) const;

  const Land& land_;
  const Furniture& furniture_;
  std::vector<Chain> chains_;
};

}  // namespace verge::sim
