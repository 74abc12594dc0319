// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "verge/core/fields.hpp"
#include "verge/detect/line_fit/layer_points.hpp"
#include "verge/fit/line.hpp"
#include "verge/model/scene.hpp"

namespace verge::detect::line_fit {

/// Settings of kerb_pieces and kerb_edges.
struct KerbConfig {
  double kerb_low_m = -0.5;
  double kerb_high_m = 0.2;
  double kerb_range_m = 35.0;
  double beneath_m = 0.4;
  double around_m = 0.12;
  double straight_m = 0.08;
  double close_m = 0.05;
  double slope_max = 0.5;
  double piece_m = 0.35;
  double joined_m = 0.12;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor&& visit) {
    visit(self.kerb_low_m,
          {"kerb_low_m", "m", -5.0, 0.0,
           "kerbs are looked for down to this height: roads fall towards their edges", "ours"});
    visit(self.kerb_high_m, {"kerb_high_m", "m", 0.02, 2.0, "and up to this one", "ours"});
    visit(self.kerb_range_m, {"kerb_range_m", "m", 1.0, 200.0, "and no farther away", "ours"});
    visit(self.beneath_m,
          {"beneath_m", "m", 0.0, 5.0,
           "a return so near to something higher, from above, is of its foot and not of a kerb", "ours"});
    visit(self.around_m,
          {"around_m", "m", 0.0, 2.0, "nor is one that lies within an object, or so near to it", "ours"});
    visit(self.straight_m, {"straight_m", "m", 0.01, 1.0,
                            "returns of a layer follow a kerb while they are so near to its line", "ours"});
    visit(self.close_m,
          {"close_m", "m", 0.01, 1.0, "and count where they are so near to the line of them all", "ours"});
    visit(self.slope_max,
          {"slope_max", "1", 0.05, 5.0, "a kerb goes aside by so much a metre at the most", "ours"});
    visit(self.piece_m,
          {"piece_m", "m", 0.05, 10.0, "a layer must follow a kerb so far, with three returns", "ours"});
    visit(self.joined_m, {"joined_m", "m", 0.02, 1.0,
                          "pieces so near to one line, and returns then, are of one kerb", "ours"});
  }
};

/// A stretch along which a layer hits a kerb's face. It runs along the road, where the road's own returns lie
/// on circles round the sensor.
struct KerbPiece {
  std::vector<std::size_t> points{};  ///< Into the layer points, outward.
  fit::Line line;
};

/// Which of the points are low enough for a kerb, have nothing high above them, and are not within the
/// footprints of objects (level frame), whose wheels and undersides are low too.
[[nodiscard]] std::vector<bool> low_points(std::span<const LayerPoint> points,
                                           std::span<const Object> objects, const KerbConfig& config);

/// The stretches of all layers, `low` as low_points() tells, layer by layer, outward on the left, then on the
/// right.
[[nodiscard]] std::vector<KerbPiece> kerb_pieces(std::span<const LayerPoint> points,
                                                 const std::vector<bool>& low, const KerbConfig& config);

}  // namespace verge::detect::line_fit
