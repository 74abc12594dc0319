// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0

// The pieces of which the combined reading is made, on kerbs in closed form.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include <gtest/gtest.h>

#include "verge/detect/road_width/corner_tracks.hpp"
#include "verge/detect/road_width/kerb_profile.hpp"
#include "verge/detect/road_width/kerb_return.hpp"
#include "verge/detect/road_width/opening.hpp"

namespace verge::detect::road_width {
namespace {

constexpr double kSigma_m = 0.03;

/// Noise that is the same in every run: the sum of twelve numbers that a hash makes of i.
double noise(int i) {
  double sum = -6.0;
  for (int k = 0; k < 12; ++k) {
    const double hashed = std::sin(12.9898 * (12 * i + k)) * 43758.5453;
    sum += hashed - std::floor(hashed);
  }
  return kSigma_m * sum;
}

/// A kerb that leaves its line at 0 along a circle, seen every `step_m` from -2.5 to `to_m`.
std::vector<KerbPoint> circle(double radius_m, double to_m, double step_m) {
  std::vector<KerbPoint> points;
  for (int i = 0; step_m * i - 2.5 <= to_m; ++i) {
    const double s = step_m * i - 2.5;
    double out = 0.0;
    if (s > 0.0) out = s < radius_m ? radius_m - std::sqrt(radius_m * radius_m - s * s) : 4.0;
    points.push_back({s, out + noise(i)});
  }
  return points;
}

double first_beyond(const std::vector<KerbPoint>& points) {
  return std::find_if(points.begin(), points.end(), [](const KerbPoint& p) { return p.outward_m > 0.1; })
      ->along_m;
}

std::vector<KerbPoint> points_at(const std::vector<double>& outward_m) {
  std::vector<KerbPoint> points;
  for (std::size_t i = 0; i < outward_m.size(); ++i) points.push_back({static_cast<double>(i), outward_m[i]});
  return points;
}

KerbSight edge_at(double along_m, double lateral_m, double opposite_m = -2.5) {
  return {.along_m = along_m, .end = {along_m, lateral_m}, .opposite = {along_m, opposite_m}};
}

KerbProfile straight_to(double end_m, double lateral_m, double opposite_m = -2.5) {
  KerbProfile profile;
  for (int i = 0; 0.25 * i <= end_m; ++i)
    profile.see(edge_at(0.25 * i, lateral_m + noise(i), opposite_m + noise(i + 1000)));
  return profile;
}

}  // namespace

TEST(KerbReturn, IsFoundWhereItBegins) {
  for (const double radius_m : {0.5, 1.0, 3.0, 8.0}) {
    const auto points = circle(radius_m, std::min(3.5, radius_m + 1.0), 0.2);
    const auto turn = fit_kerb_return(points, first_beyond(points), kSigma_m, {2.5, 12.0});
    ASSERT_TRUE(turn);
    EXPECT_NEAR(turn->begin_m, 0.0, 0.3) << radius_m;
    EXPECT_NEAR(std::log2(turn->radius_m / radius_m), 0.0, 0.8) << radius_m;
    EXPECT_LT(turn->sigma_m, 0.3);
    EXPECT_GT(turn->share, 0.7);
    EXPECT_NEAR(turn->wide, radius_m > 2.0 ? 1.0 : 0.0, 0.1) << radius_m;
  }
}

TEST(KerbReturn, OfMorePointsIsSurer) {
  const auto few = circle(8.0, 2.5, 0.4);
  const auto many = circle(8.0, 3.5, 0.1);
  const auto unsure = fit_kerb_return(few, first_beyond(few), kSigma_m, {2.5, 12.0});
  const auto sure = fit_kerb_return(many, first_beyond(many), kSigma_m, {2.5, 12.0});
  ASSERT_TRUE(unsure && sure);
  EXPECT_LT(sure->sigma_m, unsure->sigma_m);
}

// Lines that are open because the kerb has turned away from whoever looks say nothing of how deep it is.
TEST(KerbReturn, ThatTurnsAwayIsHidden) {
  const double radius_m = 3.0;
  const double aside_m = 2.5;
  const double ahead_m = 4.5;
  std::vector<KerbPoint> told;
  std::vector<KerbPoint> not_told;
  for (KerbPoint p : circle(radius_m, 3.4, 0.2)) {
    const double s = p.along_m;
    const bool visible = s * ahead_m < std::sqrt(std::max(0.0, radius_m * radius_m - s * s)) *
                                           (aside_m + radius_m - std::sqrt(radius_m * radius_m - s * s));
    if (s > 0.5 && !visible) p = {.along_m = s, .outward_m = 4.0, .open = Vec2{ahead_m, aside_m}};
    told.push_back(p);
    p.open.reset();
    not_told.push_back(p);
  }
  const auto turn = fit_kerb_return(told, first_beyond(told), kSigma_m, {2.5, 12.0});
  const auto taken_for_deep = fit_kerb_return(not_told, first_beyond(told), kSigma_m, {2.5, 12.0});
  ASSERT_TRUE(turn && taken_for_deep);
  EXPECT_NEAR(turn->begin_m, 0.0, 0.12);
  EXPECT_GT(turn->share, 0.9);
  EXPECT_GT(taken_for_deep->begin_m, turn->begin_m + 0.15);
  EXPECT_LT(taken_for_deep->share, turn->share);
}

TEST(KerbReturn, ALongStepAsideIsNone) {
  std::vector<KerbPoint> points = circle(8.0, 0.0, 0.2);
  for (int i = 0; i < 20; ++i) points.push_back({0.2 + 0.2 * i, 0.25 + noise(i)});
  const auto turn = fit_kerb_return(points, 0.2, kSigma_m, {2.5, 12.0});
  ASSERT_TRUE(turn);
  EXPECT_FALSE(turn->wide > 0.95 && turn->share > 0.7) << turn->wide << ' ' << turn->share;
  EXPECT_FALSE(fit_kerb_return({}, 0.0, kSigma_m, {2.5, 12.0}));
}

TEST(Opening, TakesTwoPointsToBeginAndToEnd) {
  const auto open = last_opening(points_at({0, 0, 0, 1, 0, 2, 3, 0, 4, 4}), 0.1);
  ASSERT_TRUE(open);
  EXPECT_EQ(open->inside_m, 2.0);
  EXPECT_EQ(open->first_m, 5.0);
  EXPECT_EQ(open->last_m, 9.0);
  EXPECT_EQ(open->depth_m, 4.0);  // the median from 7 on
  EXPECT_FALSE(last_opening(points_at({0, 0, 2, 3, 0, 0}), 0.1)) << "ended";
  EXPECT_FALSE(last_opening(points_at({2, 3, 4}), 0.1)) << "where it began is not known";
  EXPECT_FALSE(last_opening({}, 0.1));
}

TEST(Opening, EndsBetweenTheLastPointBeyondAndTheFirstOnTheKerb) {
  EXPECT_EQ(end_of_opening(points_at({0, 3, 3, 0, 3, 0, 0, 0}), 1.0, 0.1), 4.5);
  EXPECT_FALSE(end_of_opening(points_at({0, 3, 3, 0}), 1.0, 0.1));
  EXPECT_FALSE(end_of_opening({}, 1.0, 0.1));
}

TEST(KerbProfile, IsStraightButForWhatIsApart) {
  KerbProfile profile = straight_to(8.0, 2.5);
  for (int i = 0; i < 8; ++i) profile.see(edge_at(3.0 + 0.1 * i, 4.5));  // a bay
  KerbSight car = edge_at(5.0, 1.6);
  car.kind = SightKind::kThing;
  profile.see(car);
  const auto left = profile.straight(0.0, 8.0, {1.0, 0.0}, true);
  ASSERT_TRUE(left);
  EXPECT_NEAR(left->outward_m({12.0, 2.5}), 0.0, 0.05);
  EXPECT_NEAR(left->outward_m({4.0, 3.5}), 1.0, 0.02);
  EXPECT_NEAR(left->sigma_m, kSigma_m, 0.01);
  const auto right = straight_to(8.0, -2.5).straight(0.0, 8.0, {1.0, 0.0}, false);
  ASSERT_TRUE(right);
  EXPECT_NEAR(right->outward_m({4.0, -3.5}), 1.0, 0.02);
  EXPECT_FALSE(profile.straight(0.0, 2.5, {1.0, 0.0}, true)) << "less than 3 m";
  EXPECT_FALSE(KerbProfile{}.straight(0.0, 8.0, {1.0, 0.0}, true));
}

TEST(KerbProfile, TellsABendFromACorner) {
  KerbProfile left = straight_to(8.0, 2.5);
  KerbProfile right = straight_to(8.0, -2.5, 2.5);
  const auto left_kerb = left.straight(0.0, 8.0, {1.0, 0.0}, true);
  const auto right_kerb = right.straight(0.0, 8.0, {1.0, 0.0}, false);
  ASSERT_TRUE(left_kerb && right_kerb);
  left.see(edge_at(10.0, 2.8, -2.2));  // both sides 0.3 m to the left
  left.see(edge_at(11.0, 2.8, -2.5));  // the left one alone
  const auto points = left.against(*left_kerb, &*right_kerb, 9.0);
  ASSERT_EQ(points.size(), 2U);
  EXPECT_NEAR(points[0].outward_m, 0.0, 0.08);
  EXPECT_NEAR(points[1].outward_m, 0.3, 0.08);
  EXPECT_NEAR(left.against(*left_kerb, nullptr, 9.0)[0].outward_m, 0.3, 0.05);
}

TEST(KerbProfile, ACarBesideTheKerbStandsOnIt) {
  KerbProfile profile = straight_to(8.0, 2.5);
  const auto kerb = profile.straight(0.0, 8.0, {1.0, 0.0}, true);
  ASSERT_TRUE(kerb);
  for (const double lateral_m : {1.6, 2.7, 4.0}) {
    KerbSight thing = edge_at(10.0, lateral_m);
    thing.kind = SightKind::kThing;
    profile.see(thing);
  }
  const auto points = profile.against(*kerb, nullptr, 9.0);
  ASSERT_EQ(points.size(), 3U);
  EXPECT_NEAR(points[0].outward_m, -0.9, 0.05);
  EXPECT_EQ(points[1].outward_m, 0.0);
  EXPECT_NEAR(points[2].outward_m, 1.5, 0.05);  // beyond where cars stand
}

TEST(KerbProfile, AnOpenLineGoesOn) {
  KerbProfile profile = straight_to(8.0, 2.5);
  const auto kerb = profile.straight(0.0, 8.0, {1.0, 0.0}, true);
  ASSERT_TRUE(kerb);
  for (const double lateral_m : {2.0, 3.4}) {
    KerbSight open = edge_at(10.0, lateral_m);
    open.kind = SightKind::kOpen;
    open.from = {6.0, 0.0};
    open.ahead_m = 4.0;
    profile.see(open);
  }
  const auto points = profile.against(*kerb, nullptr, 9.0);
  ASSERT_EQ(points.size(), 2U);
  EXPECT_NEAR(points[0].outward_m, -0.5, 0.05) << "the field of view ends before the kerb";
  EXPECT_EQ(points[1].outward_m, 4.0);
  EXPECT_FALSE(points[0].open);
  ASSERT_TRUE(points[1].open);
  EXPECT_EQ(points[1].open->x, 4.0);
  EXPECT_NEAR(points[1].open->y, 2.5, 0.05);
}

TEST(CornerTracks, GoByUntilTheirExitIsPassed) {
  CornerTracks tracks;
  tracks.add({.side = CornerSide::kLeft, .at_m = 10.0, .lateral_m = 2.5, .sigma_m = 0.1, .radius_m = 0.5});
  const auto ahead = tracks.at(8.0, std::nullopt);
  ASSERT_EQ(ahead.size(), 1U);
  EXPECT_EQ(ahead[0].distance_m, 2.0);
  EXPECT_EQ(ahead[0].position, (Vec2{2.0, 2.5}));
  EXPECT_FALSE(ahead[0].exit_m);
  tracks.leave(CornerSide::kRight, 14.0, 0.5);  // none there
  tracks.leave(CornerSide::kLeft, 15.0, 0.5);
  const auto within = tracks.at(11.0, std::nullopt);
  ASSERT_EQ(within.size(), 1U);
  EXPECT_EQ(within[0].id, ahead[0].id);
  EXPECT_EQ(within[0].distance_m, -1.0);
  EXPECT_EQ(within[0].exit_m, 4.0);
  EXPECT_EQ(within[0].width_m, 4.0);  // without the two returns
  EXPECT_TRUE(tracks.at(15.5, std::nullopt).empty());
}

TEST(CornerTracks, TurnWithTheVehicle) {
  CornerTracks tracks;
  tracks.add({.at_m = 10.0, .place = Vec2{10.0, 2.5}});
  const Pose turned_left{from_yaw_pitch_roll(std::numbers::pi / 2.0, 0.0, 0.0), {8.0, 0.0, 0.0}};
  const auto corners = tracks.at(8.0, turned_left);
  ASSERT_EQ(corners.size(), 1U);
  EXPECT_NEAR(corners[0].position.x, 2.5, 1e-12);
  EXPECT_NEAR(corners[0].position.y, -2.0, 1e-12);
}

TEST(CornerTracks, WithoutAnExitEndAfterThirtyMetres) {
  CornerTracks tracks;
  tracks.add({.at_m = 10.0});
  EXPECT_EQ(tracks.at(39.0, std::nullopt).size(), 1U);
  EXPECT_TRUE(tracks.at(41.0, std::nullopt).empty());
}

}  // namespace verge::detect::road_width
