// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "verge/sim/furniture.hpp"

namespace verge::sim {

/// What was hit, in the class numbers of public labelled sets.
///
/// | what | SemanticKITTI | nuScenes lidarseg |
/// |---|---|---|
/// | road | 40 road | 24 driveable surface |
/// | kerb, sidewalk | 48 sidewalk (neither set has kerbs) | 26 sidewalk |
/// | other ground | 72 terrain | 27 terrain |
/// | house; wall, guard rail | 50 building; 51 fence | 28 manmade |
/// | pole; plate of a sign | 80 pole; 81 traffic sign | 28 manmade |
/// | bin; barrel | 99 other object | 11 pushable; 12 traffic cone |
/// | hedge, tree | 70 vegetation | 30 vegetation |
/// | car, van; truck; trailer | 10 car; 18 truck; 20 other vehicle, or 252, 258, 259 where it moves | 17; 23;
/// 22 | | person; cyclist | 30 person; 31 bicyclist, or 254, 253 where they move | 2 adult; 14 bicycle | |
/// drop, dirt, mirror image | 1 outlier | 0 noise |
class ClassNumbers {
 public:
  /// Of these things, by their ids.
  explicit ClassNumbers(const std::vector<Placed>& things);

  /// For a label_of(): the class, and in the upper 16 bits the object.
  [[nodiscard]] std::uint32_t semantic_kitti(std::uint32_t label) const;
  /// For a label_of(): the class.
  [[nodiscard]] std::uint8_t nuscenes(std::uint32_t label) const;

 private:
  struct Classes {
    std::uint16_t semantic_kitti = 0;
    std::uint8_t nuscenes = 0;
  };
  [[nodiscard]] static Classes of_surface(Surface surface);
  [[nodiscard]] static Classes of_thing(const Placed& thing);
  [[nodiscard]] Classes of(std::uint32_t label) const;

  std::vector<Classes> of_object_;  // by id; class 0: as its surface
};

}  // namespace verge::sim
