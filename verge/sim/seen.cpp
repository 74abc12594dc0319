// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/sim/seen.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <unordered_map>

#include "verge/core/vec.hpp"

namespace verge::sim {
namespace {

/// A side of a box, in its own frame: x along its length.
struct Face {
  Vec2 outward;
  double from_center_m = 0.0;
  std::size_t returns = 0;
};

Vec2 turned(Vec2 p, double angle_rad) {
  const double c = std::cos(angle_rad);
  const double s = std::sin(angle_rad);
  return {c * p.x - s * p.y, s * p.x + c * p.y};
}

/// What a scan saw of an object.
class Sighting {
 public:
  explicit Sighting(const Object& object) : center_(object.center.xy()), yaw_rad_(object.yaw_rad) {
    const Vec2 sensor = in_box({});
    const double ahead_m = 0.5 * object.size.length_m;
    const double aside_m = 0.5 * object.size.width_m;
    for (const Face& face : {Face{{1.0, 0.0}, ahead_m}, Face{{-1.0, 0.0}, ahead_m}, Face{{0.0, 1.0}, aside_m},
                             Face{{0.0, -1.0}, aside_m}}) {
      if (dot(face.outward, sensor) > face.from_center_m) faces_.push_back(face);
    }
  }

  void add(Vec2 place) {
    constexpr double kOnFace_m = 0.15;  // five deviations of the range, and wheels that stand back
    ++returns_;
    Face* nearest = nullptr;
    double least_m = kOnFace_m;
    for (Face& face : faces_) {
      const double off_m = std::fabs(dot(face.outward, in_box(place)) - face.from_center_m);
      if (off_m < least_m) nearest = &face;
      least_m = std::min(off_m, least_m);
    }
    if (nearest != nullptr) ++nearest->returns;
  }

  [[nodiscard]] std::optional<ObjectShape> shape() const {
    if (returns_ < kSeenReturns) return std::nullopt;
    const bool two =
        faces_.size() == 2 && faces_[0].returns >= kSeenReturns && faces_[1].returns >= kSeenReturns;
    if (!two) return ObjectShape::kFace;
    const Vec2 a = turned(faces_[0].outward, yaw_rad_);
    const Vec2 b = turned(faces_[1].outward, yaw_rad_);
    const Vec2 flank = std::fabs(a.x) > std::fabs(b.x) ? b : a;
    return flank.y < 0.0 ? ObjectShape::kJ : ObjectShape::kL;
  }

 private:
  [[nodiscard]] Vec2 in_box(Vec2 p) const { return turned(p - center_, -yaw_rad_); }

  Vec2 center_;
  double yaw_rad_;
  std::vector<Face> faces_;  // that look towards the sensor
  std::size_t returns_ = 0;
};

}  // namespace

void tell_seen(std::vector<Object>& objects, const Scan& scan) {
  std::unordered_map<std::uint32_t, std::size_t> place_of;
  std::vector<Sighting> sightings;
  for (const Object& object : objects) {
    place_of.emplace(static_cast<std::uint32_t>(object.id), sightings.size());
    sightings.emplace_back(object);
  }
  for (std::size_t i = 0; i < scan.size(); ++i) {
    const auto found = place_of.find(scan.label[i] >> 16U);
    if (found != place_of.end()) sightings[found->second].add(scan.point(i).xy());
  }
  for (std::size_t i = 0; i < objects.size(); ++i) {
    objects[i].shape = sightings[i].shape();
    if (!objects[i].shape) objects[i].confidence = 0.0;
  }
}

}  // namespace verge::sim
