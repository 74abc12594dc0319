// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "verge/core/fields.hpp"
#include "verge/eval/ground_score.hpp"
#include "verge/scan/organise.hpp"

namespace verge::eval {

/// Settings of ground_by_plane().
struct GroundPlaneConfig {
  double tolerance_m = 0.3;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor&& visit) {
    visit(self.tolerance_m, {"tolerance_m", "m", 0.01, 5.0,
                             "points nearer to the road's plane than this are ground: more finds sidewalks "
                             "and slopes, and takes the feet of what stands there",
                             "ours"});
  }
};

/// The simplest ground there is, for others to be better than: the plane of the road as estimate_mount()
/// finds it from the scan alone, and the points near it. None where no plane is found.
[[nodiscard]] std::optional<GroundPrediction> ground_by_plane(const Cloud& cloud,
                                                              const GroundPlaneConfig& config = {});

}  // namespace verge::eval
