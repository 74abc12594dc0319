// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/eval/label_edges.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "verge/eval/label_rings.hpp"

namespace verge::eval {
namespace {

constexpr std::uint32_t kRoad = 24;
constexpr std::uint32_t kSidewalk = 26;
constexpr std::uint32_t kCar = 17;
constexpr double kGap = 0.6;

/// Points along x = 10 from y = -2 to y = 2, every 0.2 m: road below y = 0.1, else `beyond`, `step_m` higher.
/// The ring is closed far away by a car.
LabelledRing across_a_kerb(double step_m, std::uint32_t beyond = kSidewalk) {
  LabelledRing ring;
  for (int i = -10; i <= 10; ++i) {
    const bool is_road = i <= 0;
    ring.points.push_back({10.0, 0.2 * i, -1.8 + (is_road ? 0.0 : step_m)});
    ring.labels.push_back(is_road ? kRoad : beyond);
  }
  for (int i = 0; i < 60; ++i) {
    ring.points.push_back({-10.0, 0.1 * (30 - i), -1.8});
    ring.labels.push_back(kCar);
  }
  return ring;
}

LabelledTruth truth_of(const std::vector<LabelledRing>& rings) {
  return find_label_edges(rings, LabelScheme::kNuscenes, kGap);
}

TEST(LabelEdges, ATruePointIsTheMiddleBetweenRoadAndSidewalk) {
  const LabelledTruth truth = truth_of({across_a_kerb(0.12)});
  ASSERT_EQ(truth.points.size(), 1U);
  EXPECT_NEAR(truth.points[0].place.x, 10.0, 1e-12);
  EXPECT_NEAR(truth.points[0].place.y, 0.1, 1e-12);
  ASSERT_TRUE(truth.points[0].step_m.has_value());
  EXPECT_NEAR(*truth.points[0].step_m, 0.12, 1e-12);
  EXPECT_TRUE(truth.hidden.empty());
}

TEST(LabelEdges, BesideACarNothingIsAsked) {
  const LabelledTruth truth = truth_of({across_a_kerb(0.12, kCar)});
  EXPECT_TRUE(truth.points.empty());
  EXPECT_TRUE(truth.hidden.empty());
}

TEST(LabelEdges, AStepIsNotKnownWhereOneSideWasNotSeen) {
  LabelledRing ring = across_a_kerb(0.12);
  // One point of the sidewalk is left,
  ring.points.erase(ring.points.begin() + 12, ring.points.begin() + 21);
  ring.labels.erase(ring.labels.begin() + 12, ring.labels.begin() + 21);
  ring.points[11].y = 0.05;  // and that one is too near
  const LabelledTruth truth = truth_of({ring});
  ASSERT_EQ(truth.points.size(), 1U);
  EXPECT_FALSE(truth.points[0].step_m.has_value());
}

TEST(LabelEdges, AWideGapHidesTheBoundary) {
  LabelledRing ring = across_a_kerb(0.12);
  for (std::size_t i = 11; i < 21; ++i) ring.points[i].y += 1.0;
  const LabelledTruth truth = truth_of({ring});
  EXPECT_TRUE(truth.points.empty());
  ASSERT_EQ(truth.hidden.size(), 1U);
  EXPECT_EQ(truth.hidden[0], (Segment{{10.0, 0.0}, ring.points[11].xy()}));
}

TEST(LabelEdges, ShortRunsAreFlickerAndTakeTheirLabel) {
  LabelledRing ring = across_a_kerb(0.12);
  for (std::size_t i = 3; i < 6; ++i) ring.labels[i] = kSidewalk;
  EXPECT_EQ(truth_of({ring}).points.size(), 1U);
  ring.labels[6] = kSidewalk;  // four in a row are meant
  EXPECT_EQ(truth_of({ring}).points.size(), 3U);
}

TEST(LabelEdges, TheTruePointsOfNeighbouringRingsAreJoined) {
  LabelledRing outer = across_a_kerb(0.12);
  for (Vec3& p : outer.points) p.x *= 1.1;
  const LabelledTruth truth = truth_of({across_a_kerb(0.12), outer});
  ASSERT_EQ(truth.points.size(), 2U);
  ASSERT_EQ(truth.segments.size(), 1U);
  EXPECT_EQ(truth.segments[0], (Segment{truth.points[0].place, truth.points[1].place}));
}

TEST(LabelEdges, FromRingToRingTheLabelMayChangeUnseen) {
  LabelledRing outer = across_a_kerb(0.12);
  for (std::size_t i = 0; i < 21; ++i) {
    outer.points[i] = {11.0, 1.1 * outer.points[i].y + 0.005, -1.8};
    outer.labels[i] = kSidewalk;
  }
  const LabelledTruth truth = truth_of({across_a_kerb(0.12), outer});
  // The eleven points of the road each look at sidewalk 1 m farther out.
  EXPECT_EQ(truth.hidden.size(), 11U);
  for (const Segment& hidden : truth.hidden) {
    EXPECT_EQ(hidden.a.x, 10.0);
    EXPECT_EQ(hidden.b.x, 11.0);
  }
}

TEST(LabelEdges, TheEdgeOfAParkingAreaIsHidden) {
  LabelledRing ring = across_a_kerb(0.12);
  for (std::size_t i = 0; i < 21; ++i) ring.labels[i] = i <= 10 ? 40 : 44;
  const LabelledTruth truth = find_label_edges(std::vector{ring}, LabelScheme::kSemanticKitti, kGap);
  EXPECT_TRUE(truth.points.empty());
  ASSERT_EQ(truth.hidden.size(), 1U);
  EXPECT_EQ(truth.hidden[0].a, (Vec2{10.0, 0.0}));
}

TEST(LabelEdges, GroundIsWhatIsLabelledSo) {
  const LabelledTruth truth = truth_of({across_a_kerb(0.12)});
  ASSERT_TRUE(truth.ground.has_value());
  EXPECT_EQ(truth.ground->size(), 21U);  // all but the car
}

TEST(LabelEdges, ARingOfTwoPointsTellsNothing) {
  LabelledRing ring;
  ring.points = {{10.0, 0.0, 0.0}, {10.0, 0.2, 0.0}};
  ring.labels = {kRoad, kSidewalk};
  EXPECT_TRUE(truth_of({ring}).points.empty());
  EXPECT_TRUE(truth_of({}).points.empty());
}

TEST(RingsByOrder, ARingEndsWhereTheAzimuthJumpsBack) {
  Cloud cloud;
  for (int ring = 0; ring < 2; ++ring) {
    for (int i = 0; i < 12; ++i) {
      const float turn = 0.1F + 0.5F * static_cast<float>(i);
      cloud.x.push_back(10.0F * std::cos(turn));
      cloud.y.push_back(10.0F * std::sin(turn));
      cloud.z.push_back(static_cast<float>(ring));
    }
  }
  const std::vector<std::uint32_t> labels(cloud.x.size(), 40);
  const auto rings = rings_by_order(cloud, labels);
  ASSERT_EQ(rings.size(), 2U);
  EXPECT_EQ(rings[0].points.size(), 12U);
  EXPECT_EQ(rings[1].points[0].z, 1.0);
}

TEST(RingsByNumber, PointsStandInOrderOfAzimuthAndTheVehicleIsLeftOut) {
  Cloud cloud;
  cloud.x = {5.0F, 5.0F, 0.1F, 5.0F};
  cloud.y = {2.0F, -2.0F, 0.1F, 0.0F};
  cloud.z = {0.0F, 0.0F, 0.0F, 0.0F};
  cloud.ring = {7, 7, 7, 3};
  const auto rings = rings_by_number(cloud, std::vector<std::uint32_t>{1, 2, 3, 4});
  ASSERT_EQ(rings.size(), 2U);
  EXPECT_EQ(rings[0].labels, (std::vector<std::uint32_t>{4}));
  EXPECT_EQ(rings[1].labels, (std::vector<std::uint32_t>{2, 1}));
}

}  // namespace
}  // namespace verge::eval
