// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/detect/lda/lda.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>

#include <gtest/gtest.h>

#include "verge/core/angle.hpp"
#include "verge/detect/lda/edges.hpp"
#include "verge/detect/lda/windows.hpp"
#include "verge/detect/test_kerbs.hpp"
#include "verge/scan/organise.hpp"

namespace verge::detect::lda {
namespace {

using testing::kerb_layer;
using testing::kerb_scan;
using testing::KerbScene;

constexpr double kHeight_m = 1.9;

/// 11 returns, 10 cm apart to the left, of these heights.
std::vector<Vec3> window_of(double (*height)(double y)) {
  std::vector<Vec3> window;
  for (int i = 0; i < 11; ++i) window.push_back({8.0, 4.0 + 0.1 * i, height(4.0 + 0.1 * i)});
  return window;
}

TEST(LdaFeatures, AreTheirDefinitionsOnRoadSlopeStepAndBend) {
  for (const double f : features_of(window_of([](double) { return 0.0; }), kHeight_m)) EXPECT_EQ(f, 0.0);

  const double var = 0.1;  // of 11 places 10 cm apart
  const Features slope = features_of(window_of([](double y) { return 0.2 * (y - 4.5) + 0.19; }), kHeight_m);
  EXPECT_NEAR(slope[0], 0.2, 1e-12);
  EXPECT_NEAR(slope[1], 0.2 * std::sqrt(var), 1e-12);
  EXPECT_NEAR(slope[2], 0.2 * var / (var + 4e-4), 1e-12);
  EXPECT_NEAR(slope[3], 0.1, 1e-12);
  EXPECT_NEAR(slope[4], 0.0, 1e-12);

  const Features step = features_of(window_of([](double y) { return y > 4.55 ? 0.11 : 0.0; }), kHeight_m);
  EXPECT_NEAR(step[0], 0.11, 1e-12);
  EXPECT_NEAR(step[1], 0.11 * std::sqrt(30.0) / 11.0, 1e-12);  // 5 high ones and 6 low ones
  EXPECT_NEAR(step[3], 0.05 / kHeight_m, 1e-12);

  const Features bend =
      features_of(window_of([](double y) { return 0.3 * (y - 4.0) * (y - 4.0); }), kHeight_m);
  EXPECT_NEAR(bend[4], 2.0 * 0.3 * 0.01, 1e-12);  // the second difference is the same everywhere
}

TEST(LdaFeatures, CompressionIsThatOfTheRangeAlongTheBeam) {
  const std::vector<Vec3> window(11, Vec3{10.0, 4.0, 0.3});
  const double rho = std::hypot(10.0, 4.0);
  const double fall = (kHeight_m - 0.3) / rho;  // of the beam, metres a metre
  const double rho_plane = kHeight_m / fall;
  EXPECT_NEAR(features_of(window, kHeight_m)[3], (rho_plane - rho) / rho_plane, 1e-12);
}

TEST(LdaFeatures, AreTheSameMirroredAndReadBackwards) {
  std::mt19937 random(7);
  std::normal_distribution<double> noise(0.0, 0.05);
  for (int round = 0; round < 20; ++round) {
    std::vector<Vec3> window = window_of([](double y) { return y > 4.5 ? 0.1 : 0.0; });
    for (Vec3& p : window) p.z += noise(random);
    const Features straight = features_of(window, kHeight_m);
    for (Vec3& p : window) p.y = -p.y;
    std::reverse(window.begin(), window.end());
    const Features mirrored = features_of(window, kHeight_m);
    for (std::size_t k = 0; k < kFeatures; ++k) EXPECT_NEAR(straight[k], mirrored[k], 1e-12);
  }
}

TEST(LdaWindows, StandAtEveryReturnOfAPieceAndSpanNoGap) {
  QuadrantRing ring = kerb_layer({}, Quadrant::kB, deg_to_rad(-10.0));
  const LdaConfig config{.window = 11};
  EXPECT_EQ(windows_of(ring, kHeight_m, config).size(), ring.points.size() - 10);
  std::erase_if(ring.points, [](Vec3 p) { return std::abs(p.y - 4.0) < 0.5; });
  EXPECT_EQ(windows_of(ring, kHeight_m, config).size(), ring.points.size() - 20);
  for (const Window& w : windows_of(ring, kHeight_m, config)) EXPECT_LT(w.features[0], 0.01);
  ring.points.resize(10);
  EXPECT_TRUE(windows_of(ring, kHeight_m, config).empty());
}

TEST(LdaWindows, TheDiscriminantIsTheWeightedSumLessTheThreshold) {
  LdaConfig config;
  double expected = -3.0;
  config.threshold = 3.0;
  for (std::size_t k = 0; k < kFeatures; ++k) {
    config.*kFeatureNames[k].value = static_cast<double>(k) + 0.5;
    expected += 2.0 * (static_cast<double>(k) + 0.5);
  }
  EXPECT_DOUBLE_EQ(discriminant({2.0, 2.0, 2.0, 2.0, 2.0}, config), expected);
}

class LdaIn : public ::testing::TestWithParam<Quadrant> {};

TEST_P(LdaIn, TheNearestEdgeOfAScanLineIsTheFaceOfTheKerb) {
  for (const double elevation_deg : {-20.0, -12.0, -7.0}) {
    const QuadrantRing ring = kerb_layer({}, GetParam(), deg_to_rad(elevation_deg));
    const auto edges = edge_windows(windows_of(ring, kHeight_m, {}), {});
    ASSERT_FALSE(edges.empty()) << elevation_deg;
    const auto edge = nearest_edge(ring, edges, {});
    ASSERT_TRUE(edge);
    EXPECT_NEAR(std::abs(edge->y), 4.0, 0.15) << elevation_deg;
    EXPECT_NEAR(edge->z, 0.0, 0.06) << elevation_deg;
  }
}

INSTANTIATE_TEST_SUITE_P(All, LdaIn, ::testing::ValuesIn(kQuadrants));

TEST(LdaSide, IsALineWhereItIsStraightAndStraysAreLeftOut) {
  std::vector<Vec3> places;
  for (int i = -10; i <= 10; ++i) places.push_back({1.5 * i, 3.0 + 0.02 * i, 0.01 * i});
  places.push_back({0.0, 1.0, 0.5});
  const auto side = fit_side(places, false, {});
  ASSERT_TRUE(side);
  EXPECT_EQ(side->boundary.side, Side::kLeft);
  EXPECT_EQ(side->boundary.model, Model::kLine);
  EXPECT_EQ(side->kept.size(), 21U);
  EXPECT_NEAR(side->boundary.confidence, 21.0 / 25.0, 1e-12);
  EXPECT_NEAR(side->boundary.points.front().x, -15.0, 1e-9);  // rear end first
  EXPECT_NEAR(side->boundary.points.back().x, 15.0, 1e-9);
  for (const Vec3 p : side->boundary.points) {
    EXPECT_NEAR(p.y, 3.0 + 0.02 * p.x / 1.5, 1e-9);
    EXPECT_NEAR(p.z, 0.01 * p.x / 1.5, 1e-9);
  }
}

TEST(LdaSide, IsAQuadraticWhereItBends) {
  std::vector<Vec3> places;
  for (int i = -10; i <= 10; ++i) places.push_back({1.5 * i, -3.0 + 0.01 * 2.25 * i * i, 0.0});
  const auto side = fit_side(places, true, {});
  ASSERT_TRUE(side);
  EXPECT_EQ(side->boundary.side, Side::kRight);
  EXPECT_EQ(side->boundary.model, Model::kPolyline);
  for (const Vec3 p : side->boundary.points) EXPECT_NEAR(p.y, -3.0 + 0.01 * p.x * p.x, 1e-9);
}

TEST(LdaSide, IsNoneOfTooFewPlacesOrOfOnePlaceAhead) {
  std::vector<Vec3> places{{1, 3, 0}, {2, 3, 0}, {3, 3, 0}, {4, 3, 0}};
  EXPECT_FALSE(fit_side(places, false, {}));
  places.push_back({5, 3, 0});
  EXPECT_TRUE(fit_side(places, false, {}));
  for (Vec3& p : places) p.x = 2.0;
  EXPECT_FALSE(fit_side(places, false, {}));
  EXPECT_FALSE(fit_side({}, false, {}));
}

TEST(Lda, FindsBothKerbsOfAStraightRoadWhereTheyAre) {
  Lda detector;
  const Scene scene = detector.process(kerb_scan({}, 32));
  ASSERT_EQ(scene.boundaries.size(), 2U);
  EXPECT_EQ(scene.boundaries[0].side, Side::kLeft);
  EXPECT_EQ(scene.boundaries[1].side, Side::kRight);
  for (const Boundary& b : scene.boundaries) {
    EXPECT_EQ(b.model, Model::kLine);
    ASSERT_GT(b.points.back().x, b.points.front().x + 20.0);
    for (const Vec3 p : b.points) {
      EXPECT_NEAR(p.y, b.side == Side::kLeft ? 4.0 : -4.0, 0.1);
      EXPECT_NEAR(p.z, -1.9, 0.06);
    }
  }
}

TEST(Lda, AFlatWorldHasNoBoundary) {
  KerbScene flat;
  flat.kerb_m = 0.0;
  EXPECT_TRUE(Lda().process(kerb_scan(flat, 32)).boundaries.empty());
}

TEST(Lda, TheTraceHoldsEveryIntermediate) {
  Trace trace;
  const Scene scene = Lda().process(kerb_scan({}, 32), &trace);
  for (const char* name : {"low", "edge windows", "candidates", "clusters"}) {
    const Trace::Points* layer = trace.find_points(name);
    ASSERT_NE(layer, nullptr) << name;
    EXPECT_FALSE(layer->points.empty()) << name;
    EXPECT_EQ(layer->points.size(), layer->group.size()) << name;
  }
  ASSERT_NE(trace.find_values("w"), nullptr);
  EXPECT_EQ(trace.find_values("w")->values.size(), kFeatures + 1);
  ASSERT_NE(trace.find_line("fit"), nullptr);
  EXPECT_EQ(trace.find_line("fit")->points.size(), scene.boundaries.front().points.size());
}

TEST(Lda, IsDefinedForEveryScan) {
  EXPECT_TRUE(Lda().process(Scan{}).boundaries.empty());
  Cloud cloud;
  cloud.x = cloud.y = cloud.z = std::vector<float>(100, 0.0F);
  EXPECT_TRUE(Lda().process(organise(cloud).scan).boundaries.empty());
  for (std::size_t i = 0; i < 100; ++i) cloud.x[i] = static_cast<float>(i);
  EXPECT_TRUE(Lda().process(organise(cloud).scan).boundaries.empty());
}

TEST(Lda, RefusesAConfigurationThatMakesNoSense) {
  LdaConfig config;
  config.window = 10;
  EXPECT_THROW(Lda{config}, std::invalid_argument);
  config = {};
  config.threshold = std::nan("");
  EXPECT_THROW(Lda{config}, std::invalid_argument);
}

}  // namespace
}  // namespace verge::detect::lda
