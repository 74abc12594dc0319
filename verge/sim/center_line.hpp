// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "verge/core/fields.hpp"
#include "verge/core/vec.hpp"

namespace verge::sim {

/// A stretch of a centre line: a line, an arc, or a clothoid, whose curvature changes by the same amount on
/// every metre.
struct Piece {
  double length_m = 50.0;
  double curvature_1pm = 0.0;         ///< At its start: 1 / radius; positive turns left, 0 is straight.
  double curvature_change_1pm = 0.0;  ///< From its start to its end; 0 = line or arc.

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor&& visit) {
    visit(self.length_m, {"length_m", "m", 0.01, 2000.0, "length along the line", "ours"});
    visit(self.curvature_1pm, {"curvature_1pm", "1/m", -1.0, 1.0,
                               "1 / radius at the start; positive turns left, 0 is straight", "ours"});
    visit(self.curvature_change_1pm,
          {"curvature_change_1pm", "1/m", -1.0, 1.0,
           "change of the curvature from start to end; not 0 makes the piece a clothoid", "ours"});
  }
};

/// A place on a centre line.
struct Station {
  Vec2 position;
  double heading_rad = 0.0;  ///< Of the line, from +x counter-clockwise.
  double curvature_1pm = 0.0;
};

/// Where a point lies beside a line.
struct Beside {
  double station_m = 0.0;  ///< Of the nearest place on the line.
  double lateral_m = 0.0;  ///< Distance from it, positive to the left.
};

/// Unit vectors along a heading, and to its left.
[[nodiscard]] Vec2 along(double heading_rad);
[[nodiscard]] Vec2 left_of(double heading_rad);

/// The line in the plane along which a road or a vehicle runs. Beyond its ends an open one goes on straight;
/// a closed one goes round.
class CenterLine {
 public:
  /// `closed`: station length_m() is station 0 again. Throws std::invalid_argument where there is no piece, a
  /// length is not positive, a number is not finite, or a closed line does not come back to its start within
  /// 1 mm and 1 mrad.
  explicit CenterLine(std::vector<Piece> pieces, const Station& start = {}, bool closed = false);

  [[nodiscard]] double length_m() const { return joints_.back().station_m; }
  [[nodiscard]] bool closed() const { return closed_; }

  /// The place `station_m` metres from the start; exact to about 1e-12 of the length.
  [[nodiscard]] Station at(double station_m) const;

  /// The point `lateral_m` to the left of the line.
  [[nodiscard]] Vec2 point(double station_m, double lateral_m) const;

  /// Whether all of it from station `from` to station `to` is straight.
  [[nodiscard]] bool is_straight(double from, double to) const;

  /// Stations where a piece begins or ends, 0 and the length among them.
  [[nodiscard]] std::vector<double> joints() const;

  /// The place of the line nearest to `p`, between station 0 and the length.
  [[nodiscard]] Beside nearest(Vec2 p) const;
  /// No place of the line between station 0 and the length is nearer to `p` than this: cheap, for those that
  /// look for the nearest of many lines.
  [[nodiscard]] double at_least_m(Vec2 p) const;

 private:
  struct Joint {  // where a piece begins
    double station_m = 0.0;
    Station place;
    double change_1pm2 = 0.0;  // of the curvature, a metre
  };

  [[nodiscard]] double wrapped(double station_m) const;

  std::vector<Joint> joints_;     // one a piece, and one at the end
  std::vector<Vec2> milestones_;  // every kMilestone_m, to find the nearest place
  Vec2 low_, high_;               // corners of a box that holds all of the line
  bool closed_ = false;
};

}  // namespace verge::sim
