// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/detect/road_width/road_line.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "verge/core/angle.hpp"
#include "verge/detect/road_width/layer_geometry.hpp"

namespace verge::detect::road_width {
namespace {

constexpr double kHalfWidth_m = 2.5;
constexpr double kKerb_m = 0.15;
const double kTangent = std::tan(deg_to_rad(78.2));  // of the first line; 1 m up: its distance too

/// What the first line sees: a road with a vertical face of that height at each side (0: none), behind it
/// ground as high as the face, every quarter of a degree over 120 degrees.
std::vector<PicturePoint> line_between(double left_face_m, double right_face_m) {
  std::vector<PicturePoint> points;
  for (int i = -240; i <= 240; ++i) {
    const double slope = std::tan(deg_to_rad(0.25 * i));  // x over y
    const double face_m = i < 0 ? left_face_m : right_face_m;
    const double raised = kTangent * (1.0 - face_m);  // where the line meets the ground behind the face
    double y = kTangent;
    if (face_m > 0.0 && std::fabs(slope) * kTangent > kHalfWidth_m)
      y = std::max(raised, kHalfWidth_m / std::fabs(slope));
    points.push_back({y * slope, y});
  }
  return points;
}

constexpr std::size_t kMiddle = 240;

LineSearch literal() {
  return {.refine = false, .bridge = 0, .obstacle_m = std::numeric_limits<double>::infinity()};
}

LineSearch fixed() { return {.tangent = kTangent}; }

}  // namespace

TEST(LayerGeometry, IsThatOfThePaper) {
  const LayerGeometry paper;
  EXPECT_NEAR(paper.hit_m(0), 3.732, 5e-4);
  EXPECT_NEAR(paper.hit_m(1), 4.031, 5e-4);
  EXPECT_NEAR(paper.hit_m(2), 4.378, 5e-4);
  EXPECT_NEAR(paper.hit_m(3), 4.787, 5e-4);
  EXPECT_NEAR(paper.gap_m(0, Reading::kFixed), 0.299, 5e-4);
  EXPECT_NEAR(paper.gap_m(1, Reading::kFixed), 0.347, 5e-4);
  EXPECT_NEAR(paper.gap_m(2, Reading::kFixed), 0.409, 5e-4);
  EXPECT_NEAR(paper.gap_m(0, Reading::kPaper), 0.646, 5e-4);  // the step twice
  EXPECT_NEAR(paper.first_to_last_m(), 1.0547, 5e-5);         // printed: 1.0546
  EXPECT_NEAR(60.0 / 3.6 / 20.0, 0.8333, 5e-5);               // d_v of 60 km/h at 20 Hz
  EXPECT_NEAR(3.6 * paper.guaranteed_speed(20.0), 75.9, 0.05);
}

TEST(LayerGeometry, OfTheHardwaresLayersFirstAndLastAreNearerThanAScan) {
  LayerGeometry hardware;
  hardware.span_rad = deg_to_rad(2.4);
  hardware.step_rad = deg_to_rad(0.8);
  EXPECT_NEAR(hardware.first_to_last_m(), 0.742, 5e-4);
  EXPECT_LT(3.6 * hardware.guaranteed_speed(20.0), 60.0);
}

TEST(LayerGeometry, AFaceStretchesAlongTheRoad) {
  const LayerGeometry paper;
  EXPECT_NEAR(paper.face_length_m(0, 0.15), 0.56, 5e-3);
  EXPECT_NEAR(paper.face_length_m(3, 0.15), 0.72, 5e-3);
  EXPECT_NEAR(paper.face_length_m(0, 0.10), 0.37, 5e-3);
  EXPECT_NEAR(paper.face_length_m(3, 0.10), 0.48, 5e-3);
}

TEST(Msdv, IsThePopulationVariance) {
  const std::vector<PicturePoint> window = {{0.0, 1.0}, {1.0, 2.0}, {3.0, 3.0}, {6.0, 6.0}};
  EXPECT_DOUBLE_EQ(msdv_y(window), 3.5);         // mean 3: 4 + 1 + 0 + 9 over 4
  EXPECT_DOUBLE_EQ(msdv_dx(window), 2.0 / 3.0);  // differences 1, 2, 3
  EXPECT_EQ(msdv_y({}), 0.0);
  EXPECT_EQ(msdv_dx(std::span(window).first(1)), 0.0);
}

TEST(RoadLine, EndsAtTheKerbs) {
  const auto points = line_between(kKerb_m, kKerb_m);
  const auto line = find_road_line(points, kMiddle, fixed());
  ASSERT_TRUE(line);
  EXPECT_EQ(line->left.kind, LineEnd::kEdge);
  EXPECT_EQ(line->right.kind, LineEnd::kEdge);
  EXPECT_TRUE(line->middle_is_road);
  EXPECT_NEAR(points[line->left.edge].x, -kHalfWidth_m, 0.03);  // a quarter of a degree is 0.027 m there
  EXPECT_NEAR(points[line->right.edge].x, kHalfWidth_m, 0.03);
  EXPECT_NEAR(road_length_m(points, *line, 8.0), 2.0 * kHalfWidth_m, 0.06);
}

// To the letter, the current point is up to K points short of the break.
TEST(RoadLine, AsPrintedEndsBeforeTheKerb) {
  const auto points = line_between(kKerb_m, kKerb_m);
  const auto printed = find_road_line(points, kMiddle, literal());
  const auto refined = find_road_line(points, kMiddle, fixed());
  ASSERT_TRUE(printed && refined);
  EXPECT_EQ(printed->right.edge, printed->right.found);
  EXPECT_EQ(printed->right.found, refined->right.found);
  EXPECT_LT(printed->right.edge, refined->right.edge);
  EXPECT_LE(refined->right.edge - printed->right.edge, literal().neighbours);
}

TEST(RoadLine, IsOpenWhereNoEdgeIsFound) {
  const auto points = line_between(kKerb_m, 0.0);
  for (const LineSearch& search : {literal(), fixed()}) {
    const auto line = find_road_line(points, kMiddle, search);
    ASSERT_TRUE(line);
    EXPECT_EQ(line->right.kind, LineEnd::kOpen);
    EXPECT_EQ(line->right.edge, points.size() - 1);
    EXPECT_EQ(line->left.kind, LineEnd::kEdge);
  }
  const auto line = find_road_line(points, kMiddle, fixed());
  EXPECT_NEAR(road_length_m(points, *line, 8.0), kHalfWidth_m + 8.0, 0.03);  // cut at the reach
}

TEST(RoadLine, MirrorsWithItsPoints) {
  const auto points = line_between(0.0, kKerb_m);
  auto mirrored = points;
  std::reverse(mirrored.begin(), mirrored.end());
  for (PicturePoint& p : mirrored) p.x = -p.x;
  for (const LineSearch& search : {literal(), fixed()}) {
    const auto one = find_road_line(points, kMiddle, search);
    const auto other = find_road_line(mirrored, kMiddle, search);
    ASSERT_TRUE(one && other);
    EXPECT_EQ(one->right.edge, points.size() - 1 - other->left.edge);
    EXPECT_EQ(one->left.kind, other->right.kind);
  }
}

TEST(RoadLine, GoesOnBehindSmallMatter) {
  auto points = line_between(kKerb_m, kKerb_m);
  for (std::size_t i = kMiddle + 40; i < kMiddle + 43; ++i) points[i].y -= 0.4;
  const auto printed = find_road_line(points, kMiddle, literal());
  const auto line = find_road_line(points, kMiddle, fixed());
  ASSERT_TRUE(printed && line);
  EXPECT_LT(points[printed->right.edge].x, 1.0);  // the paper's text ends there
  EXPECT_NEAR(points[line->right.edge].x, kHalfWidth_m, 0.03);
  for (std::size_t i = kMiddle + 43; i < kMiddle + 45; ++i) points[i].y -= 0.4;  // five are no small matter
  EXPECT_LT(points[find_road_line(points, kMiddle, fixed())->right.edge].x, 1.0);
}

TEST(RoadLine, EndsAtAWallWhichIsNoKerb) {
  const auto points = line_between(kKerb_m, 2.0);
  const auto line = find_road_line(points, kMiddle, fixed());
  ASSERT_TRUE(line);
  EXPECT_EQ(line->right.kind, LineEnd::kObstacle);
  EXPECT_NEAR(points[line->right.edge].x, kHalfWidth_m, 0.03);
  EXPECT_EQ(line->left.kind, LineEnd::kEdge);
}

TEST(RoadLine, SaysWhereTheMiddleIsNoRoad) {
  auto points = line_between(kKerb_m, kKerb_m);
  for (std::size_t i = kMiddle - 3; i <= kMiddle; ++i) points[i].y = 2.0;
  EXPECT_FALSE(find_road_line(points, kMiddle, fixed())->middle_is_road);
}

TEST(RoadLine, IsDefinedForFewPoints) {
  EXPECT_FALSE(find_road_line({}, 0, fixed()));
  const std::vector<PicturePoint> one = {{0.0, 4.0}};
  EXPECT_FALSE(find_road_line(one, 1, fixed()));
  const auto line = find_road_line(one, 0, fixed());
  ASSERT_TRUE(line);
  EXPECT_EQ(line->left.kind, LineEnd::kOpen);
  EXPECT_EQ(road_length_m(one, *line, 8.0), 0.0);
}

}  // namespace verge::detect::road_width
