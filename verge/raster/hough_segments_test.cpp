// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/raster/hough_segments.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "verge/core/angle.hpp"
#include "verge/raster/squares.hpp"
#include "verge/raster/test_pictures.hpp"

namespace verge::raster {
namespace {

/// 50 m ahead, 30 m to either side.
const Grid kGrid = grid_over({0.0, -30.0}, {50.0, 30.0}, 0.1);

/// Points every centimetre from `from` to `to`.
std::vector<Vec2> stretch(Vec2 from, Vec2 to) {
  const int steps = static_cast<int>(100.0 * distance(from, to));
  std::vector<Vec2> points;
  for (int i = 0; i <= steps; ++i) points.push_back(from + (static_cast<double>(i) / steps) * (to - from));
  return points;
}

std::vector<HoughPeak> peaks_of(const Picture& picture) { return hough_peaks(HoughTransform()(picture)); }

TEST(HoughLine, RandomLinesComeBackWithinHalfACell) {
  std::mt19937 random(7);
  std::uniform_int_distribution<int> degrees(-90, 89);
  std::uniform_real_distribution<double> ahead(20.0, 30.0);
  std::uniform_real_distribution<double> aside(-10.0, 10.0);
  for (int i = 0; i < 60; ++i) {
    const double theta = deg_to_rad(degrees(random));
    const Vec2 half = 10.0 * Vec2{std::cos(theta), -std::sin(theta)};
    const Vec2 middle{ahead(random), aside(random)};
    const Picture picture = mark_squares(stretch(middle - half, middle + half), kGrid, 1);
    const NormalLine found = to_metres(peaks_of(picture).at(0), kGrid);
    EXPECT_LE(std::fabs(found.signed_distance(middle - half)), 0.5 * kGrid.cell_m) << i;
    EXPECT_LE(std::fabs(found.signed_distance(middle + half)), 0.5 * kGrid.cell_m) << i;
  }
}

TEST(HoughLine, AtAngleZeroIsParallelToTheHeading) {
  const NormalLine edge = to_metres({.theta_rad = 0.0, .rho_px = 260, .count = 1}, kGrid);
  EXPECT_NEAR(edge.distance_m, 4.0, 1e-9);  // y = 4
  EXPECT_EQ(edge.along(), (Vec2{1.0, 0.0}));
  EXPECT_NEAR(edge.signed_distance({20.0, 5.0}), 1.0, 1e-9);
  EXPECT_NEAR(edge.foot({20.0, 5.0}).y, 4.0, 1e-9);
  const NormalLine across = to_metres({.theta_rad = deg_to_rad(-90.0), .rho_px = -200, .count = 1}, kGrid);
  EXPECT_NEAR(-across.distance_m, 30.0, 1e-9);  // x = 30
  EXPECT_NEAR(across.along().y, 1.0, 1e-12);
}

/// A straight edge at y = 4 m with points from and to these places ahead, metres, one pixel wide.
std::vector<HoughSegment> along_an_edge(const std::vector<std::pair<double, double>>& stretches,
                                        const SegmentOptions& options = {}) {
  std::vector<Vec2> points;
  for (const auto& [from, to] : stretches) {
    for (const Vec2 p : stretch({from, 4.0}, {to, 4.0})) points.push_back(p);
  }
  const Picture picture = mark_squares(points, kGrid, 1);
  const auto peaks = peaks_of(picture);
  return hough_segments(picture, kGrid, std::span(peaks).first(1), options);
}

void expect_segment(const HoughSegment& segment, double from_x, double to_x) {
  EXPECT_NEAR(segment.from.x, from_x, 1e-9);
  EXPECT_NEAR(segment.to.x, to_x, 1e-9);
  EXPECT_NEAR(segment.from.y, 4.0, 1e-9);
  EXPECT_NEAR(segment.to.y, 4.0, 1e-9);
  EXPECT_NEAR(segment.length_m(), to_x - from_x, 1e-9);
}

TEST(HoughSegments, GapsAreFilledUpToTheOptionAndNoFurther) {
  const auto filled = along_an_edge({{2.0, 10.0}, {13.0, 20.0}});
  ASSERT_EQ(filled.size(), 1U);
  expect_segment(filled[0], 2.0, 20.0);
  EXPECT_EQ(filled[0].pixels, 81 + 71);
  const auto split = along_an_edge({{2.0, 10.0}, {13.1, 20.0}});
  ASSERT_EQ(split.size(), 2U);  // from the rear to the front
  expect_segment(split[0], 2.0, 10.0);
  expect_segment(split[1], 13.1, 20.0);
}

TEST(HoughSegments, ShorterThanTheOptionAreDropped) {
  const auto segments = along_an_edge({{2.0, 6.0}, {10.0, 13.9}, {20.0, 30.0}});
  ASSERT_EQ(segments.size(), 2U);
  expect_segment(segments[0], 2.0, 6.0);
  expect_segment(segments[1], 20.0, 30.0);
  EXPECT_EQ(along_an_edge({{2.0, 6.0}, {10.0, 13.9}, {20.0, 30.0}}, {.min_length_m = 0.0}).size(), 3U);
}

TEST(HoughSegments, MaxLenKeepsTheLongestOfEachPeak) {
  const auto segments = along_an_edge({{2.0, 7.0}, {12.0, 22.0}, {27.0, 33.0}}, {.max_len = true});
  ASSERT_EQ(segments.size(), 1U);
  expect_segment(segments[0], 12.0, 22.0);
  EXPECT_TRUE(along_an_edge({{2.0, 3.0}}, {.max_len = true}).empty());
}

TEST(HoughSegments, OfTwoEdgesAreFoundUnderTheirPeaks) {
  std::vector<Vec2> points = stretch({5.0, 4.0}, {45.0, 4.0});
  for (const Vec2 p : stretch({10.0, -6.0}, {30.0, -8.0})) points.push_back(p);
  const Picture picture = mark_squares(points, kGrid, 1);
  const auto segments = hough_segments(picture, kGrid, peaks_of(picture), {.max_len = true});
  ASSERT_GE(segments.size(), 2U);
  EXPECT_EQ(segments[0].peak, 0U);
  expect_segment(segments[0], 5.0, 45.0);
  EXPECT_EQ(segments[1].peak, 1U);
  EXPECT_LT(distance(segments[1].from, {10.0, -6.0}), 2.0);  // the line is found to half a degree
  EXPECT_LT(distance(segments[1].to, {30.0, -8.0}), 2.0);
}

// What the walk along rows and columns finds is what looking at every pixel finds.
TEST(HoughSegments, HoldEveryMarkedPixelOfTheirBin) {
  const Picture picture = testing::sown(90, 130, 0.05, 3, 5);
  const auto peaks =
      hough_peaks(HoughTransform()(picture), {.most = 40, .least_share = 0.0, .theta_deg = 20.0});
  ASSERT_EQ(peaks.size(), 40U);
  const auto segments = hough_segments(picture, {.cell_m = 0.1, .rows = 90, .cols = 130}, peaks,
                                       {.fill_gap_m = 99.0, .min_length_m = 0.0});
  ASSERT_EQ(segments.size(), 40U);
  for (const HoughSegment& segment : segments) EXPECT_EQ(segment.pixels, peaks[segment.peak].count);
}

TEST(HoughSegments, AreNoneWithoutPeaksOrMarks) {
  EXPECT_TRUE(hough_segments(Picture(20, 20), kGrid, {}).empty());
  const std::vector<HoughPeak> peak = {{.theta_rad = 0.0, .rho_px = 3, .count = 9}};
  EXPECT_TRUE(hough_segments(Picture(20, 20), kGrid, peak, {.min_length_m = 0.0}).empty());
  EXPECT_TRUE(hough_segments(Picture(), Grid{}, peak).empty());
}

}  // namespace
}  // namespace verge::raster
