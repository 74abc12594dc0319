// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "verge/core/fields.hpp"
#include "verge/detect/line_fit/layer_points.hpp"
#include "verge/fit/l_shape.hpp"
#include "verge/model/scene.hpp"
#include "verge/scan/mount.hpp"

namespace verge::detect::line_fit {

/// Settings of find_objects.
struct ObjectsConfig {
  double object_height_min_m = 0.25;
  double range_sigma_m = 0.03;
  double incidence_rad = 0.26179938779914943;  // 15 degrees
  double flat_rad = 0.04363323129985824;       // 2.5 degrees
  std::int64_t look_back = 1;
  double layer_gap_m = 0.35;
  double object_length_max_m = 4.8;
  std::int64_t object_points = 2;
  fit::LShapeCriterion criterion = fit::LShapeCriterion::kCloseness;
  double road_sigma_rad = 0.05235987755982989;  // 3 degrees
  double car_length_m = 4.4;
  double car_width_m = 1.8;
  double person_m = 0.5;
  double sidewalk_m = 2.0;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor&& visit) {
    visit(self.object_height_min_m,
          {"object_height_min_m", "m", 0.05, 2.0,
           "returns lower above the road are of it, of the kerb, of the sidewalk, or from below a car",
           "ours"});
    visit(self.range_sigma_m, {"range_sigma_m", "m", 0.001, 1.0, "deviation of the ranges", "ours"});
    visit(self.incidence_rad,
          {"incidence_rad", "rad", 0.01, 1.0, "lambda: surfaces are followed down to this angle of incidence",
           "Borges and Aldon 2004: 10 degrees; value ours"});
    visit(self.flat_rad, {"flat_rad", "rad", 0.01, 1.0,
                          "and those that go straight on, or run along the road, down to this one", "ours"});
    visit(self.look_back,
          {"look_back", "1", 1, 16, "directions back to which a layer's next point may join", "ours"});
    visit(self.layer_gap_m,
          {"layer_gap_m", "m", 0.0, 5.0,
           "what two layers see nearer together, from above, is one object; parked cars are farther apart",
           "ours"});
    visit(self.object_length_max_m,
          {"object_length_max_m", "m", 1.0, 50.0,
           "what is longer is parted where its outline goes in, as between parked cars", "ours"});
    visit(self.object_points,
          {"object_points", "1", 2, 100, "an object has so many returns or more", "ours"});
    visit(self.criterion, {"criterion", "", 0, 0, "closeness or variance: what makes a heading the best",
                           "Zhang 2017, algorithms 4 and 5"});
    visit(
        self.road_sigma_rad,
        {"road_sigma_rad", "rad", 0.0, 1.0,
         "deviation of headings from the road's direction, or across it; 0: they follow it exactly", "ours"});
    visit(self.car_length_m,
          {"car_length_m", "m", 1.0, 20.0, "length of a car where its end is hidden", "ours"});
    visit(self.car_width_m, {"car_width_m", "m", 0.5, 5.0, "its width", "ours"});
    visit(self.person_m, {"person_m", "m", 0.1, 2.0, "length and width of a person, likewise", "ours"});
    visit(self.sidewalk_m,
          {"sidewalk_m", "m", 0.0, 20.0,
           "small things farther beyond the road's edge are no persons but roadside", "ours"});
  }
};

/// Where the road's edges lie to the side, along the level frame's x axis; what is not known is none.
struct RoadSides {
  std::optional<double> left_m{};   ///< y of the left edge.
  std::optional<double> right_m{};  ///< y of the right one.
};

/// An object and how it was found.
struct FoundObject {
  Object object;                      ///< In the level frame.
  fit::LShape shape;                  ///< Its two edges, likewise.
  std::vector<std::size_t> points{};  ///< Its returns: indices into the layer points.
};

/// Objects on the road and beside it (P2-17, P2-24, P2-25): the returns above object_height_min_m of each
/// layer parted at breakpoints, what the layers see of one thing put together, rows of parked cars parted
/// where their outline goes in; of each an L shape, and from it a box whose hidden sides have the size of its
/// class.
///
/// The heading is that of the longer side, to within half a turn; it leans on the road's direction where the
/// returns tell it badly. `shape`: "-" where one face is seen; J where also the right flank of a thing is
/// seen, L where the left one. Height: of the highest return. Confidence: of the class. `points` as
/// layer_points() gives them, from a sensor `height_m` above the road. Ids from 0, from left to right.
[[nodiscard]] std::vector<FoundObject> find_objects(std::span<const LayerPoint> points, double height_m,
                                                    const ObjectsConfig& config, const RoadSides& road = {});

/// The object in the sensor frame.
[[nodiscard]] Object to_sensor(Object object, const LevelFrame& frame, const Mount& mount);

}  // namespace verge::detect::line_fit
