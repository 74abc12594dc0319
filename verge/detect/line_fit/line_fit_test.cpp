// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/detect/line_fit/line_fit.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "verge/detect/line_fit/edge_curve.hpp"
#include "verge/detect/line_fit/street_scene.hpp"

namespace verge::detect::line_fit {
namespace {

using testing::kLuxMount;
using testing::scan_of;
using testing::Street;

const Boundary* of_side(const Scene& scene, Side side) {
  const auto found = std::ranges::find(scene.boundaries, side, &Boundary::side);
  return found != scene.boundaries.end() ? &*found : nullptr;
}

/// How far the boundary strays from y, in the level frame.
double off_m(const Boundary& boundary, double y) {
  const LevelFrame frame(kLuxMount);
  double most = 0.0;
  for (const Vec3& p : boundary.points) most = std::max(most, std::fabs(frame.to_level(p).y - y));
  return most;
}

Scene found_by(const LineFitConfig& config, const Street& street = {}, Trace* trace = nullptr) {
  LineFit method(config);
  return method.process(scan_of(street), trace);
}

class EveryEstimator : public ::testing::TestWithParam<EdgeEstimator> {};

}  // namespace

TEST_P(EveryEstimator, FindsBothEdgesOfAClearStreet) {
  const Scene scene = found_by({.estimator = GetParam()});
  const Boundary* left = of_side(scene, Side::kLeft);
  const Boundary* right = of_side(scene, Side::kRight);
  ASSERT_TRUE(left != nullptr && right != nullptr);
  EXPECT_LT(off_m(*left, 4.0), 0.05);
  EXPECT_LT(off_m(*right, -3.0), 0.05);
  ASSERT_TRUE(scene.road);
  for (const RoadWidth& width : scene.road->width_m) EXPECT_NEAR(width.width_m, 7.0, 0.1);
}

INSTANTIATE_TEST_SUITE_P(LineFit, EveryEstimator,
                         ::testing::Values(EdgeEstimator::kRobust, EdgeEstimator::kLeastSquares,
                                           EdgeEstimator::kPolynomial, EdgeEstimator::kTheilSen,
                                           EdgeEstimator::kHough),
                         [](const auto& each) {
                           return std::string(
                               enum_names<EdgeEstimator>.at(static_cast<std::size_t>(each.param)));
                         });

// P2's conclusion: "the result contains the gaps between the lines".
TEST(LineFit, BridgesTheGapsBetweenWhatLayersSeeOfAnEdge) {
  const Scene scene = found_by({});
  const Boundary* left = of_side(scene, Side::kLeft);
  ASSERT_NE(left, nullptr);
  const std::set<PointState> states(left->state.begin(), left->state.end());
  EXPECT_EQ(states, (std::set{PointState::kVisible, PointState::kBridged}));
  EXPECT_EQ(left->state.front(), PointState::kVisible);
  EXPECT_EQ(left->state.back(), PointState::kVisible);
}

TEST(LineFit, PutsAPolynomialThroughAnEdgeThatIsCurvedAndALineThroughOneThatIsNot) {
  std::vector<Vec2> curved;
  std::vector<Vec2> straight;
  for (int i = 0; i < 60; ++i) {
    const double x = 5.0 + 0.4 * i;
    curved.push_back({x, 3.0 + x * x / 100.0});
    straight.push_back({x, 3.0 + 0.1 * x + (i % 2 == 0 ? 0.02 : -0.02)});
  }
  const auto bend = estimate(curved, EdgeEstimator::kRobust, {});
  const auto line = estimate(straight, EdgeEstimator::kRobust, {});
  ASSERT_TRUE(bend && line);
  EXPECT_TRUE(std::holds_alternative<fit::Polynomial>(*bend));
  EXPECT_NEAR(place_on(*bend, 20.0).y, 7.0, 1e-3);
  EXPECT_TRUE(std::holds_alternative<fit::Line>(*line));
}

TEST(LineFit, GoesByTheThirdLayerAloneAsPrinted) {
  Trace trace;
  found_by({.reading = Reading::kPaper}, {}, &trace);
  const Trace::Points* layer = trace.find_points("layer");
  ASSERT_NE(layer, nullptr);
  ASSERT_FALSE(layer->points.empty());
  EXPECT_TRUE(std::ranges::all_of(layer->group, [](int group) { return group == 2; }));
  ASSERT_NE(trace.find_points("centroids"), nullptr);
  EXPECT_EQ(trace.find_points("centroids")->points.size(), 2U);  // IV: k = 2
}

// Each step of the paper can be looked at.
TEST(LineFit, TracesWhatEveryEstimatorMakesOfTheSamePoints) {
  Trace trace;
  found_by({.grouping = EdgeGrouping::kNone}, {}, &trace);
  for (const char* name : {"least_squares 0", "theil_sen 0", "polynomial 0", "hough segment 0"})
    EXPECT_NE(trace.find_line(name), nullptr) << name;
  for (const char* name : {"squares", "edges", "accumulator"})
    EXPECT_NE(trace.find_raster(name), nullptr) << name;
}

TEST(LineFit, IsDefinedForScansWithNextToNothing) {
  for (const auto reading : {Reading::kFixed, Reading::kPaper}) {
    for (const auto estimator : {EdgeEstimator::kRobust, EdgeEstimator::kHough, EdgeEstimator::kPolynomial}) {
      LineFit method({.reading = reading, .estimator = estimator, .grouping = EdgeGrouping::kNone});
      Trace trace;
      EXPECT_TRUE(method.process(Scan{}, &trace).boundaries.empty());
      Scan one;
      one.ring_begin = {0, 1};
      one.azimuth = {0.0F};
      one.range = one.x = {8.0F};
      one.y = one.z = {0.0F};
      one.mount = kLuxMount;
      EXPECT_TRUE(method.process(one, &trace).boundaries.empty());
    }
  }
}

}  // namespace verge::detect::line_fit
