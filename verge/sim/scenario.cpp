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

void mirror(Scenario& scenario) {
  for (RoadConfig& road : scenario.roads) {
    road.side = opposite(road.side);
    for (Gap& gap : road.gaps) gap.side = opposite(gap.side);
    for (Bay& bay : road.bays) bay.side = opposite(bay.side);
    for (Row& row : road.rows) row.side = opposite(row.side);
  }
}

}  // namespace verge::sim
