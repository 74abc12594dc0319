// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/scan/four_layers.hpp"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "verge/core/angle.hpp"
#include "verge/scan/organise.hpp"

namespace verge {
namespace {

constexpr double kHeight_m = 1.9;
const Mount kMount{.height_m = kHeight_m};
const FourLayers kLayers{deg_to_rad(80.0), deg_to_rad(6.0), deg_to_rad(60.0)};

/// Rings that meet flat ground at these angles from the vertical, a point every degree all around; but
/// `wall_m` ahead stands a wall that hides what lies behind it.
Scan rings(const std::vector<double>& from_vertical_deg, double wall_m = 1e3) {
  Cloud cloud;
  for (std::size_t ring = 0; ring < from_vertical_deg.size(); ++ring) {
    const double tangent = std::tan(deg_to_rad(from_vertical_deg[ring]));
    for (int i = 0; i < 360; ++i) {
      const double azimuth = deg_to_rad(i + 0.5);
      const double far_m = std::min(kHeight_m * tangent, wall_m);
      cloud.x.push_back(static_cast<float>(far_m * std::cos(azimuth)));
      cloud.y.push_back(static_cast<float>(far_m * std::sin(azimuth)));
      cloud.z.push_back(static_cast<float>(-far_m / tangent));
      cloud.ring.push_back(static_cast<std::int64_t>(ring));
    }
  }
  return organise(cloud).scan;
}

std::vector<std::size_t> chosen(const Scan& scan, const Mount& mount = kMount) {
  return rings_of_four_layers(scan, LevelFrame(mount), mount, kLayers);
}

}  // namespace

TEST(FourLayers, AreAllRingsWhereThereAreNoMore) {
  EXPECT_EQ(chosen(rings({80.0, 82.0, 84.0})), (std::vector<std::size_t>{0, 1, 2}));
  EXPECT_EQ(chosen(rings({80.0, 82.0, 84.0, 86.0}), Mount{}), (std::vector<std::size_t>{0, 1, 2, 3}));
  EXPECT_TRUE(chosen(Scan{}).empty());
}

TEST(FourLayers, OfADenserSensorAreTheRingsNearestToTheirLines) {
  EXPECT_EQ(chosen(rings({70.0, 75.0, 79.9, 81.0, 82.1, 83.9, 86.2, 88.0})),
            (std::vector<std::size_t>{2, 4, 5, 6}));
}

TEST(FourLayers, MeetTheRoadAhead) {
  // All but the three nearest rings meet the wall more than 0.3 m above the road.
  EXPECT_EQ(chosen(rings({60.0, 70.0, 75.0, 80.0, 82.0, 84.0, 86.0}, 8.0)),
            (std::vector<std::size_t>{0, 1, 2}));
  EXPECT_TRUE(chosen(rings({60.0, 70.0, 75.0, 80.0, 82.0}), Mount{}).empty());  // a height of 0
}

TEST(FourLayers, ARingRunsFromLeftToRightWhereverForwardIs) {
  const Scan scan = rings({80.0});
  for (const double forward_deg : {0.0, 90.0, -90.0, 179.0, -135.0}) {
    const double forward_rad = deg_to_rad(forward_deg);
    const std::vector<std::size_t> order = from_left(scan, 0, forward_rad);
    ASSERT_EQ(order.size(), scan.size());
    for (std::size_t i = 1; i < order.size(); ++i) {
      EXPECT_LT(wrap_pi(double{scan.azimuth[order[i]]} - forward_rad),
                wrap_pi(double{scan.azimuth[order[i - 1]]} - forward_rad))
          << forward_deg;
    }
  }
}

}  // namespace verge
