// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <vector>

#include <nlohmann/json.hpp>

#include "verge/core/pose.hpp"
#include "verge/core/vec.hpp"
#include "verge/emit/geo.hpp"

namespace verge::emit {

/// Makes GeoJSON geometries of points in one scan's sensor frame: rounded as the writer's documentation says,
/// in local metres or, with an origin, in longitude and latitude.
class GeoPlacer {
 public:
  /// Without a pose the scan has no place, and every geometry is null.
  GeoPlacer(const std::optional<Pose>& T_local_sensor, const std::optional<GeoOrigin>& origin)
      : T_local_sensor_(T_local_sensor), origin_(origin) {}

  /// LineString; Point for one point; null for none; across the antimeridian a MultiLineString cut there.
  [[nodiscard]] nlohmann::ordered_json line(std::span<const Vec3> points) const;

  /// Polygon of a ring that is given open; with fewer than three corners as line(). Across the antimeridian
  /// its outline alone, as line().
  [[nodiscard]] nlohmann::ordered_json polygon(std::span<const Vec3> corners) const;

 private:
  using Position = std::vector<double>;
  using Line = std::vector<Position>;
  [[nodiscard]] Line positions(std::span<const Vec3> points) const;
  [[nodiscard]] nlohmann::ordered_json geometry_of(const Line& line) const;
  [[nodiscard]] static std::vector<Line> cut_at_antimeridian(const Line& line);

  std::optional<Pose> T_local_sensor_;
  std::optional<GeoOrigin> origin_;
};

}  // namespace verge::emit
