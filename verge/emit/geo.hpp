// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "verge/core/error.hpp"
#include "verge/core/vec.hpp"

namespace verge::emit {

/// Where a local frame (x forward, y left, z up) stands on the WGS 84 ellipsoid. The frame is taken as level:
/// its x-y plane touches the ellipsoid at its origin.
struct GeoOrigin {
  double latitude_deg = 0.0;   ///< -90 to 90.
  double longitude_deg = 0.0;  ///< -180 to 180.
  double heading_deg = 0.0;    ///< Of the x axis, clockwise from north; -360 to 360.
};

/// Longitude first, as GeoJSON orders them.
struct LonLat {
  double longitude_deg = 0.0;  ///< -180 to 180.
  double latitude_deg = 0.0;
};

/// The origin spelled "LAT,LON,HEADING" in decimal degrees. Fails with kUsage.
[[nodiscard]] Expected<GeoOrigin> parse_origin(std::string_view text);

/// p in east, north, up at the origin, metres.
[[nodiscard]] Vec3 to_east_north_up(const GeoOrigin& origin, Vec3 p_local);

/// The point of the ellipsoid below or above p, exact at any distance (Karney's GeographicLib).
[[nodiscard]] LonLat to_wgs84(const GeoOrigin& origin, Vec3 p_local);

}  // namespace verge::emit
