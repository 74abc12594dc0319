// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/detect/road_width/road_line.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include "verge/core/angle.hpp"
#include "verge/core/statistics.hpp"
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

/// The same line with noise of that deviation on its ranges, and every `every`th point alone. On grass, what
/// it meets is up to 15 cm high.
std::vector<PicturePoint> noisy(std::vector<PicturePoint> points, double sigma_m, int every, bool grass,
                                std::mt19937& random) {
  std::normal_distribution<double> range(0.0, sigma_m);
  std::uniform_real_distribution<double> blade(0.0, 0.15);
  std::vector<PicturePoint> some;
  for (std::size_t i = 0; i < points.size(); i += static_cast<std::size_t>(every)) {
    const double distance_m = std::sqrt(points[i].x * points[i].x + points[i].y * points[i].y + 1.0);
    const double nearer = grass ? 1.0 - blade(random) : 1.0;
    const double stretch = nearer * (1.0 + range(random) / distance_m);
    some.push_back({stretch * points[i].x, stretch * points[i].y});
  }
  return some;
}

/// Values of a window's measures over many scans, in ascending order.
struct Measures {
  std::vector<double> y, dx;

  void add(std::span<const PicturePoint> window) {
    y.push_back(msdv_y(window));
    dx.push_back(msdv_dx(window));
  }
  [[nodiscard]] double y_at(double percent) const { return percentile(y, percent).value_or(NAN); }
  [[nodiscard]] double dx_at(double percent) const { return percentile(dx, percent).value_or(NAN); }
};

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

// Layers at 1.6 and 0.53 degrees about 13.4 degrees down: lines that run nearly straight, and nearly alike.
TEST(LayerGeometry, LinesOfAPitchedScannerAreNearlyParallel) {
  const LayerGeometry paper;
  const std::vector<double> ahead = {3.73, 4.03, 4.38, 4.79};
  const std::vector<double> at_45_degrees = {3.57, 3.97, 4.46, 5.08};
  for (int line = 0; line < 4; ++line) {
    const auto i = static_cast<std::size_t>(line);
    EXPECT_NEAR(paper.hit(line, 0.0).y, ahead[i], 0.006);
    EXPECT_NEAR(paper.hit(line, 0.0).y, paper.hit_m(line), 1e-12);
    EXPECT_NEAR(paper.hit(line, deg_to_rad(45.0)).y, at_45_degrees[i], 0.006);
    EXPECT_NEAR(paper.hit(line, deg_to_rad(-45.0)).x, -paper.hit(line, deg_to_rad(45.0)).x, 1e-12);
  }
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

// The statistics behind Y_thres and X_thres, with 2 and 5 cm of noise: windows on the road, windows most of
// which climbs the kerb, and windows on grass.
TEST(Msdv, ThresholdsPartRoadKerbAndGrass) {
  struct Row {
    int every;  // points of a quarter of a degree
    std::size_t neighbours;
    double road_2cm, road_5cm, kerb_low, kerb_median, kerb_dx;
  };
  for (const Row& row :
       {Row{1, 10, 0.0006, 0.0040, 0.006, 0.017, 0.0023}, Row{1, 15, 0.0006, 0.0038, 0.015, 0.033, 0.0019},
        Row{2, 8, 0.0007, 0.0038, 0.012, 0.033, 0.0027}}) {
    std::mt19937 random(7);
    Measures road_2cm, road_5cm, kerb, grass;
    const auto is_on_face = [](std::span<const PicturePoint> window) {
      const auto on_face = std::count_if(window.begin(), window.end(), [](const PicturePoint& p) {
        return std::fabs(p.x - kHalfWidth_m) < 0.06;
      });
      return static_cast<double>(on_face) >= 0.7 * static_cast<double>(window.size());
    };
    for (int scan = 0; scan < 200; ++scan) {
      for (const double sigma_m : {0.02, 0.05}) {
        const auto line = noisy(line_between(kKerb_m, kKerb_m), sigma_m, row.every, false, random);
        const std::size_t middle = line.size() / 2;
        const std::span<const PicturePoint> points(line);
        (sigma_m < 0.03 ? road_2cm : road_5cm).add(points.subspan(middle, row.neighbours));
        for (std::size_t begin = middle; begin + row.neighbours < line.size(); ++begin) {
          const auto window = points.subspan(begin, row.neighbours);
          if (is_on_face(window)) kerb.add(window);
        }
      }
      const auto line = noisy(line_between(0.0, 0.0), 0.03, row.every, true, random);
      grass.add(std::span<const PicturePoint>(line).subspan(line.size() * 3 / 4, row.neighbours));
    }
    EXPECT_NEAR(road_2cm.y_at(95.0), row.road_2cm, 0.0003);
    EXPECT_NEAR(road_5cm.y_at(95.0), row.road_5cm, 0.001);
    EXPECT_GT(kerb.y_at(5.0), 0.7 * row.kerb_low);
    EXPECT_NEAR(kerb.y_at(50.0), row.kerb_median, 0.2 * row.kerb_median);
    EXPECT_LT(kerb.dx_at(95.0), 1.2 * row.kerb_dx);
    EXPECT_LT(road_5cm.y_at(95.0), LineSearch{}.y_thres_m2);
    EXPECT_LT(kerb.dx_at(95.0), LineSearch{}.x_thres_m2);
    EXPECT_GT(grass.y_at(5.0), LineSearch{}.y_thres_m2) << "grass is no road";
    EXPECT_GT(grass.dx_at(50.0), LineSearch{}.x_thres_m2) << "nor an edge";
  }
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
