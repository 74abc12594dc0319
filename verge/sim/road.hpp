// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "verge/core/vec.hpp"
#include "verge/model/scene.hpp"
#include "verge/sim/world.hpp"

namespace verge::sim {

/// A stretch of the road's centre line with one curvature.
struct Piece {
  double length_m = 0.0;
  double curvature_1pm = 0.0;  ///< 1 / radius; positive turns left, 0 is straight.
};

/// Blocks behind both sidewalks, in a row with gaps.
struct Houses {
  double setback_m = 1.0;  ///< From the sidewalk's outer edge to the wall.
  double length_m = 10.0;  ///< Along the road.
  double gap_m = 4.0;      ///< Between two houses.
  double depth_m = 6.0;
  double height_m = 6.0;
};

/// A road between two kerbs. Its crown lies on the centre line at height 0; the carriageway falls to both
/// sides; the sidewalk rises outward by the same slope; behind it a verge falls to the flat ground.
struct RoadConfig {
  std::vector<Piece> pieces = {{200.0, 0.0}};
  double width_m = 8.0;           ///< From kerb to kerb.
  double cross_fall = 0.02;       ///< Fall for each metre sideways.
  double curb_height_m = 0.12;    ///< Of the vertical face; 0 = no kerb.
  double sidewalk_width_m = 2.0;  ///< 0 = none.
  std::optional<Houses> houses;
};

/// A place on the centre line.
struct Station {
  Vec2 position;
  double heading_rad = 0.0;  ///< Of the road, from +x counter-clockwise.
};

/// A vertex of the road's section; lateral is measured from the centre line to the left.
struct SectionPoint {
  double lateral_m = 0.0;
  double height_m = 0.0;
  Surface outward = Surface::kGround;  ///< Surface from here to the next vertex outward.
};

/// The road as geometry, without a mesh. World frame: station 0 at the origin, heading +x, z up. Beyond its
/// ends the centre line goes on straight.
class Road {
 public:
  /// Throws std::invalid_argument where a length, width, height or slope makes no road, or where a curve is
  /// so tight that the inner side would fold over.
  explicit Road(RoadConfig config);

  [[nodiscard]] const RoadConfig& config() const { return config_; }
  [[nodiscard]] double length_m() const { return length_m_; }

  /// The centre line at `station` metres from its start.
  [[nodiscard]] Station at(double station) const;

  /// Whether all of the centre line from station `from` to station `to` is straight.
  [[nodiscard]] bool is_straight(double from, double to) const;

  /// Height of the surface at `lateral` metres to the left of the centre line; on the kerb's face the foot's.
  [[nodiscard]] double height_at(double lateral) const;

  /// The point of the surface at (station, lateral).
  [[nodiscard]] Vec3 point(double station, double lateral) const;

  /// The left half of the section from the centre line outward; the right half is its mirror image.
  [[nodiscard]] const std::vector<SectionPoint>& section() const { return section_; }

  /// Foot of the kerb on the road's side from station 0 to the end, one vertex every `step_m` of the centre
  /// line and one at the end. `side` is kLeft or kRight.
  [[nodiscard]] std::vector<Vec3> curb_foot(Side side, double step_m = 0.1) const;

 private:
  struct Joint {  // where a piece begins
    double station = 0.0;
    Station place;
    double curvature_1pm = 0.0;
  };

  RoadConfig config_;
  double length_m_ = 0.0;
  std::vector<Joint> joints_;  // one a piece, and one at the end
  std::vector<SectionPoint> section_;
};

}  // namespace verge::sim
