// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/emit/geo.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <optional>

#include <GeographicLib/LocalCartesian.hpp>
#include <fmt/core.h>

#include "verge/core/angle.hpp"

namespace verge::emit {
namespace {

/// Exactly three numbers with commas between.
std::optional<std::array<double, 3>> three_numbers(std::string_view text) {
  std::array<double, 3> numbers{};
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const char* const end = text.data() + text.size();
    const auto [rest, error] = std::from_chars(text.data(), end, numbers[i]);
    if (error != std::errc() || !std::isfinite(numbers[i])) return std::nullopt;
    text = std::string_view(rest, static_cast<std::size_t>(end - rest));
    const bool last = i + 1 == numbers.size();
    if (last != text.empty() || (!last && text.front() != ',')) return std::nullopt;
    if (!last) text.remove_prefix(1);
  }
  return numbers;
}

}  // namespace

Expected<GeoOrigin> parse_origin(std::string_view text) {
  const auto fail = [&](std::string_view need) {
    return Unexpected(
        {ErrorCode::kUsage, {}, {}, "an origin that cannot be read", std::string(text), std::string(need)});
  };
  const auto numbers = three_numbers(text);
  if (!numbers) return fail("LAT,LON,HEADING in decimal degrees");
  const auto [latitude, longitude, heading] = *numbers;
  if (std::fabs(latitude) > 90.0) return fail("a latitude of -90 to 90");
  if (std::fabs(longitude) > 180.0) return fail("a longitude of -180 to 180");
  if (std::fabs(heading) > 360.0) return fail("a heading of -360 to 360");
  return GeoOrigin{latitude, longitude, heading};
}

Vec3 to_east_north_up(const GeoOrigin& origin, Vec3 p) {
  const double heading = deg_to_rad(origin.heading_deg);
  const double sine = std::sin(heading);
  const double cosine = std::cos(heading);
  return {p.x * sine - p.y * cosine, p.x * cosine + p.y * sine, p.z};
}

LonLat to_wgs84(const GeoOrigin& origin, Vec3 p_local) {
  const GeographicLib::LocalCartesian tangent(origin.latitude_deg, origin.longitude_deg);
  const Vec3 enu = to_east_north_up(origin, p_local);
  LonLat place;
  double height_m = 0.0;
  tangent.Reverse(enu.x, enu.y, enu.z, place.latitude_deg, place.longitude_deg, height_m);
  return place;
}

}  // namespace verge::emit
