// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/detect/road_width/layers.hpp"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "verge/core/angle.hpp"
#include "verge/scan/organise.hpp"

namespace verge::detect::road_width {
namespace {

constexpr double kHeight_m = 1.0;

/// Where rings of these angles from the vertical meet flat ground, all around, turned by `turn_deg`.
Scan rings(const std::vector<double>& from_vertical_deg, double turn_deg = 0.0) {
  Cloud cloud;
  for (std::size_t ring = 0; ring < from_vertical_deg.size(); ++ring) {
    const double radius_m = kHeight_m * std::tan(deg_to_rad(from_vertical_deg[ring]));
    for (int i = 0; i < 720; ++i) {
      const double azimuth = deg_to_rad(0.5 * i + 0.25 + turn_deg);
      cloud.x.push_back(static_cast<float>(radius_m * std::cos(azimuth)));
      cloud.y.push_back(static_cast<float>(radius_m * std::sin(azimuth)));
      cloud.z.push_back(static_cast<float>(-kHeight_m));
      cloud.ring.push_back(static_cast<std::int64_t>(ring));
    }
  }
  return organise(cloud).scan;
}

std::vector<LayerLine> lines_of(const Scan& scan, const Mount& mount) {
  return four_lines(scan, LevelFrame(mount), mount, RoadWidthConfig{});
}

}  // namespace

TEST(Layers, AreTakenFarthestFirst) {
  const auto lines = lines_of(rings({75.0, 76.07, 77.13, 78.2}), {.height_m = kHeight_m});
  ASSERT_EQ(lines.size(), 4U);
  EXPECT_NEAR(lines[0].tangent, std::tan(deg_to_rad(78.2)), 1e-3);
  EXPECT_NEAR(lines[3].tangent, std::tan(deg_to_rad(75.0)), 1e-3);
  EXPECT_NEAR(lines[0].step_rad, deg_to_rad(0.5), 1e-4);
  EXPECT_LT(lines[0].points.front().x, 0.0);  // from left to right
  EXPECT_GT(lines[0].points.back().x, 0.0);
}

TEST(Layers, OfADenserSensorAreTheRingsNearestToWhereTheLinesWouldBe) {
  const auto lines =
      lines_of(rings({60.0, 70.0, 74.8, 75.9, 77.0, 78.3, 80.0, 83.0}), {.height_m = kHeight_m});
  ASSERT_EQ(lines.size(), 4U);
  const std::vector<double> expected = {78.3, 77.0, 75.9, 74.8};
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(lines[i].tangent, std::tan(deg_to_rad(expected[i])), 1e-3);
}

// Wherever the sensor's own axis points: the lines lie about the road's direction, behind it as well.
TEST(Layers, TurnWithTheMount) {
  const auto straight = lines_of(rings({75.0, 76.07, 77.13, 78.2}), {.height_m = kHeight_m});
  for (const double turn_deg : {90.0, -90.0, 170.0, 180.0, -120.0}) {
    const auto turned = lines_of(rings({75.0, 76.07, 77.13, 78.2}, turn_deg),
                                 {.height_m = kHeight_m, .forward_rad = deg_to_rad(turn_deg)});
    ASSERT_EQ(turned.size(), 4U);
    for (std::size_t i = 0; i < 4; ++i) {
      ASSERT_EQ(turned[i].points.size(), straight[i].points.size()) << turn_deg;
      for (std::size_t k = 0; k < turned[i].points.size(); ++k) {
        EXPECT_NEAR(turned[i].points[k].x, straight[i].points[k].x, 1e-5);
        EXPECT_NEAR(turned[i].points[k].y, straight[i].points[k].y, 1e-5);
      }
    }
  }
}

TEST(Layers, AreNoneWithoutHeightOrPoints) {
  EXPECT_TRUE(lines_of(rings({75.0}), Mount{}).empty());
  EXPECT_TRUE(lines_of(Scan{}, {.height_m = kHeight_m}).empty());
}

}  // namespace verge::detect::road_width
