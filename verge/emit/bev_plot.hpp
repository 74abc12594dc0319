// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "verge/core/error.hpp"
#include "verge/core/fields.hpp"
#include "verge/model/scene.hpp"
#include "verge/model/trace.hpp"
#include "verge/scan/scan.hpp"

namespace verge::emit {

/// What one picture shows; all in the scan's sensor frame. Trace and truth may be null.
struct BevContent {
  const Scan& scan;
  const Scene& scene;
  const Trace* trace = nullptr;
  const Scene* truth = nullptr;
};

/// Bird's-eye pictures of scans, heading up: points by their height above the road, the layers of the trace,
/// the boundaries by side (dashed where bridged, dotted where occluded), the objects by class, truth dashed
/// on top; with range rings, scale bar, colour bar, legend and caption.
///
/// Heights need scan.mount; without it they are counted from the lowest twentieth of the points, and the
/// colour bar says so. A picture of the same content is the same bytes on one machine (the letters come from
/// the machine's fonts). Drawing may be done by several threads at once.
class BevPlot {
 public:
  struct Config {
    double ahead_m = 30.0;
    double behind_m = 30.0;
    double side_m = 30.0;
    double up_rad = 0.0;
    double height_min_m = -0.2;
    double height_max_m = 1.0;
    double ceiling_m = 4.0;
    std::int64_t size_px = 1200;

    template <class Self, class Visitor>
    static void fields(Self& self, Visitor&& visit) {
      visit(self.ahead_m, {"ahead_m", "m", 1.0, 1000.0, "how far the picture reaches ahead", "ours"});
      visit(self.behind_m, {"behind_m", "m", 1.0, 1000.0, "how far the picture reaches behind", "ours"});
      visit(self.side_m, {"side_m", "m", 1.0, 1000.0, "how far the picture reaches to each side", "ours"});
      visit(self.up_rad, {"up_rad", "rad", -6.2832, 6.2832,
                          "direction in the sensor frame that points up, from +x counter-clockwise", "ours"});
      visit(self.height_min_m,
            {"height_min_m", "m", -100.0, 100.0, "height above the road of the darkest colour", "ours"});
      visit(self.height_max_m,
            {"height_max_m", "m", -100.0, 100.0, "height above the road of the brightest colour", "ours"});
      visit(self.ceiling_m, {"ceiling_m", "m", -100.0, 1000.0,
                             "points higher above the road are not shown: bridges, branches", "ours"});
      visit(self.size_px, {"size_px", "px", 300, 4096, "width and height of the picture", "ours"});
    }
  };

  BevPlot() = default;
  /// Throws std::invalid_argument where a value is outside its range, or height_max_m is not above
  /// height_min_m.
  explicit BevPlot(const Config& config);

  /// The picture as PNG. Fails with kLimit where memory does not suffice.
  [[nodiscard]] Expected<std::string> png(const BevContent& content) const;

  /// The picture as a file, whole or not at all. Fails also with kCannotWrite.
  [[nodiscard]] Expected<void> write(const std::filesystem::path& target, const BevContent& content) const;

 private:
  Config config_;
};

}  // namespace verge::emit
