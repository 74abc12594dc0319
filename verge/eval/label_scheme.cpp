// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/eval/label_scheme.hpp"

#include <algorithm>
#include <span>

namespace verge::eval {
namespace {

struct Classes {
  std::span<const std::uint32_t> drivable;
  std::span<const std::uint32_t> either;
  std::span<const std::uint32_t> off;
  std::span<const std::uint32_t> ground;
  std::uint32_t vegetation;
  std::uint32_t last_unlabelled;  // from 0 on
};

// nuScenes lidarseg: 0 noise, 9 barrier, 12 debris, 24 drivable surface, 25 other flat, 26 sidewalk, 27
// terrain, 28 man-made, 30 vegetation.
constexpr std::uint32_t kNuscenesDrivable[] = {24};
constexpr std::uint32_t kNuscenesOff[] = {9, 12, 25, 26, 27, 28, 30};
constexpr std::uint32_t kNuscenesGround[] = {24, 25, 26, 27, 30};
constexpr std::uint32_t kNuscenesVegetation = 30;
constexpr std::uint32_t kNuscenesNoise = 0;

// SemanticKITTI: 0 unlabelled, 1 outlier, 40 road, 44 parking, 48 sidewalk, 49 other ground, 50 building, 51
// fence, 52 other structure, 60 lane marking, 70 vegetation, 71 trunk, 72 terrain, 80 pole, 81 traffic sign,
// 99 other object.
constexpr std::uint32_t kKittiDrivable[] = {40, 60};
constexpr std::uint32_t kKittiEither[] = {44};
constexpr std::uint32_t kKittiOff[] = {48, 49, 50, 51, 52, 70, 71, 72, 80, 81, 99};
constexpr std::uint32_t kKittiGround[] = {40, 44, 48, 49, 60, 72};
constexpr std::uint32_t kKittiVegetation = 70;
constexpr std::uint32_t kKittiOutlier = 1;

Classes classes_of(LabelScheme scheme) {
  if (scheme == LabelScheme::kNuscenes)
    return {kNuscenesDrivable, {}, kNuscenesOff, kNuscenesGround, kNuscenesVegetation, kNuscenesNoise};
  return {kKittiDrivable, kKittiEither, kKittiOff, kKittiGround, kKittiVegetation, kKittiOutlier};
}

bool contains(std::span<const std::uint32_t> classes, std::uint32_t label) {
  return std::find(classes.begin(), classes.end(), label) != classes.end();
}

}  // namespace

Surface surface_of(LabelScheme scheme, std::uint32_t label) {
  const Classes classes = classes_of(scheme);
  if (contains(classes.drivable, label)) return Surface::kDrivable;
  if (contains(classes.off, label)) return Surface::kOff;
  return contains(classes.either, label) ? Surface::kEither : Surface::kUnknown;
}

GroundClass ground_class_of(LabelScheme scheme, std::uint32_t label) {
  const Classes classes = classes_of(scheme);
  if (label <= classes.last_unlabelled) return GroundClass::kUnlabelled;
  if (label == classes.vegetation) return GroundClass::kVegetation;
  return contains(classes.ground, label) ? GroundClass::kGround : GroundClass::kOther;
}

bool is_ground(LabelScheme scheme, std::uint32_t label) { return contains(classes_of(scheme).ground, label); }

}  // namespace verge::eval
