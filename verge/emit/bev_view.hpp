// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "verge/core/vec.hpp"
#include "verge/emit/bev_plot.hpp"

namespace verge::emit {

/// From the sensor frame, metres, to the picture, pixels.
class BevView {
 public:
  explicit BevView(const BevPlot::Config& config)
      : size_(static_cast<double>(config.size_px)),
        scale_(size_ / std::max(config.ahead_m + config.behind_m, 2.0 * config.side_m)),
        forward_{std::cos(config.up_rad), std::sin(config.up_rad)},
        origin_{0.5 * size_, 0.5 * (size_ + scale_ * (config.ahead_m - config.behind_m))} {}

  [[nodiscard]] double size() const { return size_; }
  [[nodiscard]] double pixels_a_metre() const { return scale_; }
  /// Lengths on the picture are given for one of 1200 pixels and grow with it.
  [[nodiscard]] double px(double length) const { return length * size_ / 1200.0; }
  [[nodiscard]] Vec2 origin() const { return origin_; }

  [[nodiscard]] Vec2 at(Vec2 p) const {
    return {origin_.x - scale_ * cross(forward_, p), origin_.y - scale_ * dot(forward_, p)};
  }

  /// Whether a dot there would be seen. False where the place is not finite.
  [[nodiscard]] bool shows(Vec2 at) const {
    constexpr double kRim = 20.0;
    return at.x > -kRim && at.x < size_ + kRim && at.y > -kRim && at.y < size_ + kRim;
  }

  /// A line for cairo, whose numbers end at 8e6: far points are pulled in, still far outside the picture.
  [[nodiscard]] std::vector<Vec2> line(std::span<const Vec3> points) const {
    constexpr double kFar = 1e5;
    std::vector<Vec2> pixels;
    for (const Vec3 p : points) {
      const Vec2 q = at(p.xy());
      if (std::isfinite(q.x) && std::isfinite(q.y)) {
        pixels.push_back({std::clamp(q.x, -kFar, kFar), std::clamp(q.y, -kFar, kFar)});
      }
    }
    return pixels;
  }

 private:
  double size_;
  double scale_;
  Vec2 forward_;
  Vec2 origin_;
};

}  // namespace verge::emit
