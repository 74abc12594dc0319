// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace verge::eval {

/// What a labelled class is to someone who looks for the road's edge.
enum class Surface : std::uint8_t {
  kUnknown,
  kDrivable,  ///< Road, lane marking.
  kOff,       ///< Other ground or a structure.
  kEither     ///< Parking: raised or not.
};

/// Which data set's class numbers labels are.
enum class LabelScheme : std::uint8_t { kNuscenes, kSemanticKitti };

[[nodiscard]] Surface surface_of(LabelScheme scheme, std::uint32_t label);

/// Whether the class lies on the ground (drivable or not).
[[nodiscard]] bool is_ground(LabelScheme scheme, std::uint32_t label);

}  // namespace verge::eval
