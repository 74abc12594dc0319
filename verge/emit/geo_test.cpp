// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/emit/geo.hpp"

#include <cmath>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "verge/core/angle.hpp"

namespace verge::emit {
namespace {

// WGS 84.
constexpr double kEquatorRadius = 6378137.0;
constexpr double kEccentricity2 = 6.69437999014e-3;

/// Metres north a degree of latitude, and metres east a degree of longitude, from the ellipsoid's own radii
/// of curvature.
double metres_a_degree_north(double latitude_deg) {
  const double s = std::sin(deg_to_rad(latitude_deg));
  const double w2 = 1.0 - kEccentricity2 * s * s;
  return deg_to_rad(kEquatorRadius * (1.0 - kEccentricity2) / (w2 * std::sqrt(w2)));
}
double metres_a_degree_east(double latitude_deg) {
  const double s = std::sin(deg_to_rad(latitude_deg));
  return deg_to_rad(kEquatorRadius * std::cos(deg_to_rad(latitude_deg)) /
                    std::sqrt(1.0 - kEccentricity2 * s * s));
}

TEST(ParseOrigin, ReadsLatitudeLongitudeHeading) {
  const auto origin = parse_origin("48.1372,-11.5756,270");
  ASSERT_TRUE(origin.has_value());
  EXPECT_EQ(origin->latitude_deg, 48.1372);
  EXPECT_EQ(origin->longitude_deg, -11.5756);
  EXPECT_EQ(origin->heading_deg, 270.0);
}

TEST(ParseOrigin, RefusesWhatIsNoOrigin) {
  for (const auto* text : {"", "1", "1,2", "1,2,3,", "1,2,3,4", "1,2,x", "1;2;3", "91,0,0", "0,181,0",
                           "0,0,361", "nan,0,0", "0,inf,0", "1, 2,3"}) {
    const auto origin = parse_origin(text);
    ASSERT_FALSE(origin.has_value()) << text;
    EXPECT_EQ(origin.error().code, ErrorCode::kUsage);
  }
}

TEST(ToWgs84, TheOriginIsItself) {
  const LonLat place = to_wgs84({48.0, 11.0, 77.0}, {0.0, 0.0, 0.0});
  EXPECT_NEAR(place.latitude_deg, 48.0, 1e-12);
  EXPECT_NEAR(place.longitude_deg, 11.0, 1e-12);
}

TEST(ToWgs84, AHundredMetresNorthMoveTheLatitudeByTheMeridiansCurvature) {
  const LonLat place = to_wgs84({48.0, 11.0, 0.0}, {100.0, 0.0, 0.0});
  EXPECT_NEAR(place.latitude_deg - 48.0, 100.0 / metres_a_degree_north(48.0), 2e-8);
  EXPECT_NEAR(place.longitude_deg, 11.0, 1e-12);
}

TEST(ToWgs84, LeftOfAHeadingNorthIsWest) {
  const LonLat place = to_wgs84({48.0, 11.0, 0.0}, {0.0, 100.0, 0.0});
  EXPECT_NEAR(place.longitude_deg - 11.0, -100.0 / metres_a_degree_east(48.0), 2e-8);
  EXPECT_NEAR(place.latitude_deg, 48.0, 1e-7);
}

TEST(ToWgs84, HeadingTurnsClockwise) {
  const LonLat east = to_wgs84({48.0, 11.0, 90.0}, {100.0, 0.0, 0.0});
  EXPECT_NEAR(east.longitude_deg - 11.0, 100.0 / metres_a_degree_east(48.0), 2e-8);
  const Vec3 left_of_east = to_east_north_up({0.0, 0.0, 90.0}, {0.0, 5.0, 1.5});
  EXPECT_NEAR(left_of_east.x, 0.0, 1e-12);
  EXPECT_NEAR(left_of_east.y, 5.0, 1e-12);
  EXPECT_EQ(left_of_east.z, 1.5);
}

RC_GTEST_PROP(ToWgs84Law, DistancesOnTheGroundAreKept, ()) {
  const double latitude = *rc::gen::inRange(-800, 801) / 10.0;
  const double heading = *rc::gen::inRange(-360, 361);
  const Vec3 p{*rc::gen::inRange(-2000, 2001) / 10.0, *rc::gen::inRange(-2000, 2001) / 10.0, 0.0};
  const LonLat place = to_wgs84({latitude, 20.0, heading}, p);
  const double north = (place.latitude_deg - latitude) * metres_a_degree_north(latitude);
  const double east =
      (place.longitude_deg - 20.0) * metres_a_degree_east((latitude + place.latitude_deg) / 2.0);
  RC_ASSERT(std::fabs(std::hypot(north, east) - norm(p)) < 0.02);
}

}  // namespace
}  // namespace verge::emit
