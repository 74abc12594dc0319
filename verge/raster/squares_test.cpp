// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/raster/squares.hpp"

#include <algorithm>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "verge/raster/test_pictures.hpp"

namespace verge::raster {
namespace {

using testing::drawn;

Picture marked(const std::vector<Vec2>& points, const Grid& grid, int size_px) {
  return mark_squares(points, grid, size_px);
}

TEST(Grid, XForwardIsUpAndYLeftIsToTheLeft) {
  const Grid grid = grid_over({0.0, -30.0}, {50.0, 30.0}, 0.1);
  EXPECT_EQ(grid.rows, 501);
  EXPECT_EQ(grid.cols, 601);
  EXPECT_EQ(to_pixels(grid, {50.0, 30.0}), (Vec2{0.0, 0.0}));
  EXPECT_NEAR(to_pixels(grid, {0.0, -30.0}).x, 600.0, 1e-9);
  EXPECT_NEAR(to_pixels(grid, {0.0, -30.0}).y, 500.0, 1e-9);
  const Vec2 back = to_metres(grid, to_pixels(grid, {12.34, -5.67}));
  EXPECT_NEAR(back.x, 12.34, 1e-12);
  EXPECT_NEAR(back.y, -5.67, 1e-12);
}

TEST(Grid, EndsLessThanACellShortWhereCellsDoNotFit) {
  const Grid grid = grid_over({-0.95, 0.0}, {1.0, 0.0}, 0.5);
  EXPECT_EQ(grid.rows, 4);  // at 1, 0.5, 0, -0.5
  EXPECT_EQ(grid.cols, 1);
}

// 5 x 7 pixels of 1 m, the point at row 2 and column 3.
constexpr Grid kSmall{.x_max_m = 4.0, .y_max_m = 3.0, .cell_m = 1.0, .rows = 5, .cols = 7};

TEST(Squares, StandAboutTheNearestPixel) {
  EXPECT_EQ(marked({{2.3, -0.4}}, kSmall, 1), drawn({".......", ".......", "...#...", ".......", "......."}));
  EXPECT_EQ(marked({{2.3, -0.4}}, kSmall, 3), drawn({".......", "..###..", "..###..", "..###..", "......."}));
}

TEST(Squares, OfAnEvenSideLieOnTheSideOfThePoint) {
  EXPECT_EQ(marked({{2.3, 0.4}}, kSmall, 2), drawn({".......", "..##...", "..##...", ".......", "......."}));
  EXPECT_EQ(marked({{1.7, -0.4}}, kSmall, 2), drawn({".......", ".......", "...##..", "...##..", "......."}));
}

TEST(Squares, EndAtThePicturesEdge) {
  EXPECT_EQ(marked({{4.0, 3.0}, {0.0, -3.0}}, kSmall, 3),
            drawn({"##.....", "##.....", ".......", ".....##", ".....##"}));
  EXPECT_EQ(marked({{2.0, 0.0}}, kSmall, 99).grey, std::vector<std::uint8_t>(35, 255));
}

TEST(Squares, OfPointsOutsideOrNotFiniteAreNot) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const std::vector<Vec2> outside = {{4.6, 0.0},  {-0.6, 0.0},      {2.0, 3.6},
                                     {2.0, -3.6}, {1e300, 0.0},     {kNan, 0.0},
                                     {0.0, kNan}, {kInfinity, 0.0}, {0.0, -kInfinity}};
  for (const Vec2 point : outside)
    EXPECT_EQ(marked({point}, kSmall, 5), Picture(5, 7)) << point.x << ' ' << point.y;
  EXPECT_NE(marked({{4.4, -3.4}}, kSmall, 5), Picture(5, 7));
}

TEST(Squares, AreNoneForNoPointsAndForAnEmptyGrid) {
  EXPECT_EQ(marked({}, kSmall, 5), Picture(5, 7));
  EXPECT_EQ(marked({{0.0, 0.0}}, Grid{}, 5), Picture());
}

}  // namespace
}  // namespace verge::raster
