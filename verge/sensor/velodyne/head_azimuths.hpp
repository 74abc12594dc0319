// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace verge::sensor::velodyne {

/// Where the head looked when a laser fired, as a point tells it.
struct HeadSample {
  double azimuth = 0.0;  ///< Hundredths of a degree, [0, 36000).
  double share = 0.0;    ///< Of the step that had passed, [0, 1).
};

/// Azimuths of a packet's steps.
struct HeadAzimuths {
  std::vector<std::uint16_t> azimuth{};  ///< Of each step, as on the wire.
  double turn = 0.0;                     ///< From a step to the next, on average.
};

/// The whole azimuths, one a step, that bring the samples of all steps nearest to where the decoder will put
/// them: from each step's azimuth linearly to the next one's, from the last one by the turn of the one
/// before. `turn`: what the head was last known to turn in a step, for steps that say too little. Samples of
/// decoded points (a thousandth of a unit off) give back the packet's azimuths where one is decided by them
/// at all. Without any sample the azimuths are those from `begin` on.
[[nodiscard]] HeadAzimuths fit_azimuths(std::span<const std::vector<HeadSample>> steps, double turn,
                                        double begin);

}  // namespace verge::sensor::velodyne
