// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/detect/line_fit/layer_points.hpp"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "verge/core/angle.hpp"
#include "verge/scan/organise.hpp"

namespace verge::detect::line_fit {
namespace {

const Mount kMount{.height_m = 0.5, .pitch_rad = deg_to_rad(1.5)};

struct Row {
  double azimuth_deg = 0.0;
  double range_m = 0.0;
  int layer = 0;
  int echo = 0;
};

Scan scan_of(const std::vector<Row>& rows) {
  Cloud cloud;
  for (const Row& row : rows) {
    cloud.x.push_back(static_cast<float>(row.range_m * std::cos(deg_to_rad(row.azimuth_deg))));
    cloud.y.push_back(static_cast<float>(row.range_m * std::sin(deg_to_rad(row.azimuth_deg))));
    cloud.z.push_back(0.0F);
    cloud.ring.push_back(row.layer);
    cloud.echo.push_back(static_cast<std::uint8_t>(row.echo));
  }
  return organise(cloud).scan;
}

std::vector<LayerPoint> points_of(const Scan& scan, const Mount& mount = kMount) {
  return layer_points(scan, LevelFrame(mount), mount, {});
}

}  // namespace

TEST(LayerPoints, StandLayerByLayerFromLeftToRightInTheLevelFrame) {
  const auto points = points_of(scan_of({{-20.0, 10.0, 0}, {0.0, 12.0, 1}, {5.0, 9.0, 0}, {30.0, 7.0, 1}}));
  ASSERT_EQ(points.size(), 4U);
  EXPECT_EQ(points[0].layer, 0U);
  EXPECT_NEAR(points[0].azimuth_rad, deg_to_rad(5.0), 1e-6);
  EXPECT_NEAR(points[1].azimuth_rad, deg_to_rad(-20.0), 1e-6);
  EXPECT_EQ(points[3].layer, 1U);
  EXPECT_NEAR(points[3].range_m, 12.0, 1e-5);
  EXPECT_NEAR(points[3].place.x, 12.0 * std::cos(kMount.pitch_rad), 1e-5);
  EXPECT_NEAR(points[3].place.z, 0.5 - 12.0 * std::sin(kMount.pitch_rad), 1e-5);
}

// P2 rows 44, 45: the same level and azimuth, two ranges.
TEST(LayerPoints, KeepAllEchoesOfAShotTogether) {
  const auto points =
      points_of(scan_of({{10.0, 8.0, 2}, {9.0, 11.0, 2}, {10.0, 13.0, 2, 1}, {11.0, 8.0, 2}}));
  ASSERT_EQ(points.size(), 4U);
  EXPECT_NEAR(points[1].azimuth_rad, points[2].azimuth_rad, 1e-6);
  EXPECT_NEAR(points[1].range_m + points[2].range_m, 21.0, 1e-5);
}

// Fig. 6: what is rejected is dropped, and does not stand at the origin.
TEST(LayerPoints, EndAtTheRangeGate) {
  const auto points = points_of(scan_of({{0.0, 49.9, 0}, {1.0, 50.1, 0}, {2.0, 150.0, 0}}));
  ASSERT_EQ(points.size(), 1U);
  EXPECT_GT(points[0].place.x, 49.0);
  EXPECT_TRUE(points_of(Scan{}).empty());
}

TEST(LayerPoints, TurnWithTheMount) {
  const Mount turned{.height_m = 0.5, .forward_rad = deg_to_rad(120.0)};
  const auto points = points_of(scan_of({{120.0, 10.0, 0}, {150.0, 10.0, 0}, {-90.0, 10.0, 0}}), turned);
  ASSERT_EQ(points.size(), 2U);  // the last one lies behind
  EXPECT_NEAR(points[0].place.y, 5.0, 1e-5);
  EXPECT_NEAR(points[1].place.x, 10.0, 1e-5);
}

}  // namespace verge::detect::line_fit
