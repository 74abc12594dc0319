// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "verge/core/vec.hpp"
#include "verge/detect/line_fit/edge_curve.hpp"
#include "verge/detect/line_fit/groups.hpp"
#include "verge/detect/line_fit/hough_lines.hpp"
#include "verge/detect/line_fit/layer_points.hpp"
#include "verge/detect/line_fit/objects.hpp"
#include "verge/model/trace.hpp"
#include "verge/scan/mount.hpp"

namespace verge::detect::line_fit {

/// Writes the method's intermediates into a Trace, in the sensor's frame; does nothing where there is no
/// trace.
class Recorder {
 public:
  Recorder(Trace* trace, const LevelFrame& frame) : trace_(trace), frame_(frame) {}

  [[nodiscard]] bool is_on() const { return trace_ != nullptr; }

  void points(std::string name, std::span<const LayerPoint> points);
  void objects(std::span<const FoundObject> objects);
  void groups(std::string name, std::span<const LayerPoint> points, const Groups& groups);
  void edge(std::string name, const Edge& edge);
  void hough(const HoughSteps& steps);

 private:
  /// On the road, or at the height of the sensor's own plane where that is not known.
  [[nodiscard]] Vec3 to_sensor(Vec2 place) const { return frame_.to_sensor({place.x, place.y, 0.0}); }
  void line(std::string name, std::span<const Vec2> path);

  Trace* trace_;
  const LevelFrame& frame_;
};

}  // namespace verge::detect::line_fit
