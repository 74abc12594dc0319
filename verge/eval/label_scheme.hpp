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

/// What a labelled class is to someone who tells the ground from what stands on it.
enum class GroundClass : std::uint8_t {
  kOther,
  kGround,
  kVegetation,  ///< Of unsaid height: lawn or tree.
  kUnlabelled   ///< Without a class, or of no thing (noise, outlier).
};

/// Which data set's class numbers labels are.
enum class LabelScheme : std::uint8_t { kNuscenes, kSemanticKitti };

[[nodiscard]] Surface surface_of(LabelScheme scheme, std::uint32_t label);

/// Terrain and what people walk and drive on is ground, kerbs too.
[[nodiscard]] GroundClass ground_class_of(LabelScheme scheme, std::uint32_t label);

/// Whether the class lies on the ground (drivable or not) so that a boundary could be seen beside it;
/// nuScenes' vegetation, which some make of terrain, does.
[[nodiscard]] bool is_ground(LabelScheme scheme, std::uint32_t label);

}  // namespace verge::eval
