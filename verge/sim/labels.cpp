// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/sim/labels.hpp"

#include <array>
#include <cstddef>

namespace verge::sim {

ClassNumbers::Classes ClassNumbers::of_surface(Surface surface) {
  static constexpr std::array<Classes, enum_names<Surface>.size()> kClasses = {{{40, 24},
                                                                                {48, 26},
                                                                                {48, 26},
                                                                                {72, 27},
                                                                                {51, 28},
                                                                                {51, 28},
                                                                                {70, 30},
                                                                                {10, 17},
                                                                                {30, 2},
                                                                                {99, 12},
                                                                                {81, 28},
                                                                                {1, 0}}};
  return kClasses.at(static_cast<std::size_t>(surface));
}

ClassNumbers::Classes ClassNumbers::of_thing(const Placed& thing) {
  const auto moving = [&](std::uint16_t at_rest, std::uint16_t moves) {
    return thing.moves() ? moves : at_rest;
  };
  switch (thing.what) {
    case Thing::kCar:
    case Thing::kVan:
      return {moving(10, 252), 17};
    case Thing::kTruck:
      return {moving(18, 258), 23};
    case Thing::kTrailer:
      return {moving(20, 259), 22};
    case Thing::kCyclist:
      return {moving(31, 253), 14};
    case Thing::kPerson:
      return {moving(30, 254), 2};
    case Thing::kPole:
      return {80, 28};
    case Thing::kBin:
      return {99, 11};
    case Thing::kHouse:
      return {50, 28};
    default:
      return {};
  }
}

ClassNumbers::ClassNumbers(const std::vector<Placed>& things) {
  for (const Placed& thing : things) {
    if (of_object_.size() <= thing.id) of_object_.resize(thing.id + std::size_t{1});
    of_object_[thing.id] = of_thing(thing);
  }
}

ClassNumbers::Classes ClassNumbers::of(std::uint32_t label) const {
  const std::size_t object = label >> 16U;
  if (object < of_object_.size() && of_object_[object].semantic_kitti != 0) return of_object_[object];
  return of_surface(static_cast<Surface>(label & 0xFFFFU));
}

std::uint32_t ClassNumbers::semantic_kitti(std::uint32_t label) const {
  return (label & 0xFFFF0000U) | of(label).semantic_kitti;
}

std::uint8_t ClassNumbers::nuscenes(std::uint32_t label) const { return of(label).nuscenes; }

}  // namespace verge::sim
