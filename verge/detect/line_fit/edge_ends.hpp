// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "verge/core/vec.hpp"
#include "verge/detect/line_fit/layer_points.hpp"

namespace verge::detect::line_fit {

/// How an edge of an object may go on beyond the last of its returns.
struct EdgeEnd {
  double unseen_m = std::numeric_limits<double>::infinity();  ///< At the most; infinite where nobody knows.
  bool is_hidden = false;  ///< Something that stands nearer hides how it goes on.
  bool is_cut = false;     ///< The scan ends there.
};

/// What the layers see beside an object.
class Beside {
 public:
  /// `cluster` are the object's points, indices into `points`; of a sensor height_m above the road. What is
  /// lower than low_m tells nothing: rays pass below objects there.
  Beside(std::span<const LayerPoint> points, const std::vector<std::size_t>& cluster, double height_m,
         double low_m);

  /// Of an edge that was seen up to `end` and may go on in the direction `onward`: the next ray of each layer
  /// either met something that stands nearer than the edge would, or it passed where the edge cannot be.
  [[nodiscard]] EdgeEnd after(Vec2 end, Vec2 onward) const;

 private:
  double height_m_;
  double low_m_;
  bool left_is_cut_ = false;  // the scan ends beside the object
  bool right_is_cut_ = false;
  std::vector<Vec3> left_;   // of each layer, the next return to the left
  std::vector<Vec3> right_;  // and to the right
};

}  // namespace verge::detect::line_fit
