// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/detect/road_width/kerb_foot.hpp"

#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

namespace verge::detect::road_width {
namespace {

constexpr double kAhead_m = 4.5;  // where the line runs across the road
constexpr double kFoot_m = 2.53;  // from the axis
constexpr double kSpacing_m = 0.07;

/// A line on a road of height 0, to the left: across it, up a face of `height_m` in `face_points` steps and
/// back along it (1 m down the way for 0.2 m up), and outward on top. The face stands at the foot and runs
/// `turn_deg` off the road's direction.
struct Profile {
  LayerLine line;
  std::size_t last_on_road = 0;
};

Profile profile_of(double height_m, int face_points, double turn_deg, bool left = true) {
  std::vector<Vec3> outward;
  for (int i = 0; kSpacing_m * i < kFoot_m; ++i) outward.push_back({kAhead_m, kSpacing_m * i, 0.0});
  const std::size_t last = outward.size() - 1;
  const double turn = turn_deg * std::numbers::pi / 180.0;
  Vec3 top{};
  for (int i = 1; i <= face_points; ++i) {
    const double z = height_m * i / face_points;
    const double back = 5.0 * z;
    top = {kAhead_m - back * std::cos(turn), kFoot_m - back * std::sin(turn), z};
    outward.push_back(top);
  }
  for (int i = 1; i <= 15; ++i) outward.push_back(top + Vec3{0.0, kSpacing_m * i, 0.0});
  Profile profile;
  for (Vec3 p : outward) {
    if (!left) p.y = -p.y;
    profile.line.level.push_back(p);
    profile.line.points.push_back({.x = -p.y, .y = p.x});
  }
  profile.last_on_road = last;
  if (!left) return profile;
  profile.line.level = {profile.line.level.rbegin(), profile.line.level.rend()};
  profile.line.points = {profile.line.points.rbegin(), profile.line.points.rend()};
  profile.line.middle = profile.line.points.size() - 1;
  profile.last_on_road = profile.line.middle - last;
  return profile;
}

}  // namespace

TEST(KerbFoot, IsWhereRoadAndFaceMeetHoweverFarShortTheEdge) {
  for (const bool left : {true, false}) {
    for (const double turn_deg : {0.0, 20.0, 35.0}) {
      const Profile profile = profile_of(0.12, 5, turn_deg, left);
      for (std::size_t before = 0; before <= 3; ++before) {
        const std::size_t edge = left ? profile.last_on_road + before : profile.last_on_road - before;
        const auto foot = kerb_foot(profile.line, edge, left);
        ASSERT_TRUE(foot) << turn_deg << ' ' << before;
        EXPECT_NEAR(foot->x, kAhead_m, 1e-9);
        EXPECT_NEAR(foot->y, left ? kFoot_m : -kFoot_m, 1e-9);
      }
    }
  }
}

TEST(KerbFoot, IsNotToldFromAFaceOfOnePoint) {
  const Profile profile = profile_of(0.12, 2, 0.0);  // the other one is the top
  EXPECT_FALSE(kerb_foot(profile.line, profile.last_on_road, true));
}

TEST(KerbFoot, IsNotToldFromWhatHardlyRises) {
  const Profile profile = profile_of(0.05, 6, 0.0);
  EXPECT_FALSE(kerb_foot(profile.line, profile.last_on_road, true));
}

TEST(KerbFoot, NeedsTheRoadBeforeIt) {
  Profile profile = profile_of(0.12, 5, 0.0);
  profile.line.middle = profile.last_on_road + 2;
  EXPECT_FALSE(kerb_foot(profile.line, profile.last_on_road, true));
  EXPECT_FALSE(kerb_foot(profile.line, 0, true)) << "nothing lies behind the last point";
}

}  // namespace verge::detect::road_width
