// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/detect/gradient/gradient.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>

#include <gtest/gtest.h>

#include "verge/detect/test_kerbs.hpp"
#include "verge/scan/organise.hpp"

namespace verge::detect {
namespace {

using testing::kerb_scan;
using testing::KerbScene;

TEST(Gradient, FindsBothKerbsOfAStraightRoadWhereTheyAre) {
  Gradient detector;
  const Scene scene = detector.process(kerb_scan({}, 32));
  ASSERT_EQ(scene.boundaries.size(), 2U);
  EXPECT_EQ(scene.boundaries[0].side, Side::kLeft);
  EXPECT_EQ(scene.boundaries[1].side, Side::kRight);
  for (const Boundary& b : scene.boundaries) {
    EXPECT_EQ(b.model, Model::kLine);
    EXPECT_EQ(b.kind, BoundaryKind::kCurb);
    ASSERT_GE(b.points.size(), 2U);
    EXPECT_EQ(b.height_m.size(), b.points.size());
    EXPECT_EQ(b.state.size(), b.points.size());
    EXPECT_GT(b.points.back().x, b.points.front().x);  // rear end first
    for (const Vec3 p : b.points) {
      EXPECT_NEAR(p.y, b.side == Side::kLeft ? 4.0 : -4.0, 0.02);
      EXPECT_NEAR(p.z, -1.9, 0.03);
    }
    for (std::size_t i = 0; i < b.points.size(); ++i) {
      EXPECT_LT(b.height_m[i], 0.12 + 1e-6);
      // Abreast, scan lines touch the face and leave it again before they are on top.
      const bool abreast = std::abs(b.points[i].x) < 2.0;
      EXPECT_GT(b.height_m[i], abreast ? 0.05 : 0.09) << b.points[i].x;
    }
    EXPECT_LT(b.points.front().x, -25.0);  // both ways as far as the gate lets scan lines through
    EXPECT_GT(b.points.back().x, 25.0);
  }
}

TEST(Gradient, BesideTheVehicleWhereNoScanLineCrossesTheBoundaryIsBridged) {
  Gradient detector;
  const Scene scene = detector.process(kerb_scan({}, 32));
  for (const Boundary& b : scene.boundaries) {
    for (std::size_t i = 0; i < b.points.size(); ++i) {
      const double x = std::abs(b.points[i].x);
      if (x > 0.2 && x < 8.0) continue;
      EXPECT_EQ(b.state[i], x < 1.0 ? PointState::kBridged : PointState::kVisible) << x;
    }
  }
}

TEST(Gradient, ThePrintedReadingRunsAndFindsTheSameStraightRoad) {
  GradientConfig config;
  config.reading = Reading::kPaper;
  Gradient detector(config);
  const Scene scene = detector.process(kerb_scan({}, 32));
  ASSERT_EQ(scene.boundaries.size(), 2U);
  for (const Boundary& b : scene.boundaries) {
    for (const Vec3 p : b.points) EXPECT_NEAR(std::abs(p.y), 4.0, 0.3);
  }
}

TEST(Gradient, AFlatWorldHasNoBoundary) {
  KerbScene flat;
  flat.kerb_m = 0.0;
  Gradient detector;
  EXPECT_TRUE(detector.process(kerb_scan(flat, 32)).boundaries.empty());
}

TEST(Gradient, TheTraceHoldsEveryIntermediate) {
  Gradient detector;
  Trace trace;
  const Scene scene = detector.process(kerb_scan({}, 32), &trace);
  for (const char* name : {"low", "gradient points", "candidates", "clusters"}) {
    const Trace::Points* layer = trace.find_points(name);
    ASSERT_NE(layer, nullptr) << name;
    EXPECT_FALSE(layer->points.empty()) << name;
    EXPECT_EQ(layer->points.size(), layer->group.size()) << name;
  }
  ASSERT_NE(trace.find_values("K"), nullptr);
  ASSERT_NE(trace.find_line("fit"), nullptr);
  EXPECT_EQ(trace.find_line("fit")->points.size(), scene.boundaries.front().points.size());
}

TEST(Gradient, IsDefinedForEveryScan) {
  Gradient detector;
  EXPECT_TRUE(detector.process(Scan{}).boundaries.empty());

  Cloud cloud;
  cloud.x = cloud.y = cloud.z = std::vector<float>(100, 0.0F);
  EXPECT_TRUE(detector.process(organise(cloud).scan).boundaries.empty());

  for (std::size_t i = 0; i < 100; ++i) cloud.x[i] = static_cast<float>(i);
  EXPECT_TRUE(detector.process(organise(cloud).scan).boundaries.empty());
}

TEST(Gradient, RefusesAConfigurationOutsideItsRange) {
  GradientConfig config;
  config.height_max_m = -1.0;
  EXPECT_THROW(Gradient{config}, std::invalid_argument);
  config = {};
  config.noise_factor = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(Gradient{config}, std::invalid_argument);
}

}  // namespace
}  // namespace verge::detect
