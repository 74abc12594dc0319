// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/sim/scenario.hpp"

#include "verge/core/angle.hpp"

namespace verge::sim {

Mount mount_of(const Stand& stand) {
  return {.height_m = stand.height_m,
          .pitch_rad = deg_to_rad(stand.pitch_deg),
          .roll_rad = deg_to_rad(stand.roll_deg),
          .forward_rad = deg_to_rad(stand.forward_deg)};
}

}  // namespace verge::sim
