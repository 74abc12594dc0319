// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/emit/curvature_plot.hpp"

#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "verge/emit/bev_theme.hpp"
#include "verge/emit/test_picture.hpp"

namespace verge::emit {
namespace {

constexpr Colour kKey = rgb(0xFF6FB5);
constexpr int kTop = 84;  // of the plot; above it stands what the colours mean
constexpr int kBottom = 444;

/// 10 m, even but for a peak in its middle; the ends, a point of the even part and the peak are key points.
CurvatureCurve peak() {
  CurvatureCurve curve;
  for (int i = 0; i <= 40; ++i) {
    curve.s_m.push_back(0.25 * i);
    curve.kappa_1_m.push_back(i == 20 ? 0.4 : 0.1);
  }
  curve.kappa_1_m.front() = curve.kappa_1_m.back() = 0.0;
  curve.key_s_m = {0.0, 2.5, 5.0, 10.0};
  return curve;
}

Picture drawn(const CurvatureCurve& curve) { return Picture(curvature_png(curve).value()); }

int column_of(double s_m) { return 90 + static_cast<int>(108.0 * s_m); }
int row_of(double kappa) { return kTop + static_cast<int>(360.0 * (0.4 - kappa) / 0.4); }

int pixels_of(const Picture& picture, Colour colour, int x, int y, int reach) {
  int count = 0;
  for (int row = y - reach; row <= y + reach; ++row) {
    for (int column = x - reach; column <= x + reach; ++column)
      count += picture.pixel(column, row) == hex_of(colour) ? 1 : 0;
  }
  return count;
}

/// Rows of the plot in which that colour stands at that column.
std::vector<int> rows_of(const Picture& picture, Colour colour, int x) {
  std::vector<int> rows;
  for (int y = kTop; y < kBottom; ++y) {
    if (picture.pixel(x, y) == hex_of(colour)) rows.push_back(y);
  }
  return rows;
}

}  // namespace

TEST(CurvaturePlot, TheThresholdIsTheMeanBetweenTheEnds) {
  const Picture picture = drawn(peak());
  EXPECT_EQ(picture.width(), 1200);
  const double k_avg = (38 * 0.1 + 0.4) / 39.0;
  std::vector<int> rows;
  for (int x = column_of(7.0); x < column_of(8.0) && rows.empty(); ++x)
    rows = rows_of(picture, kPlotThreshold, x);  // between two dashes there is none
  ASSERT_FALSE(rows.empty());
  EXPECT_NEAR(rows.front(), row_of(k_avg), 2);
  EXPECT_FALSE(rows_of(picture, kPlotCurve, column_of(7.1)).empty());
}

TEST(CurvaturePlot, KeyPointsAreDiscsWhereTheyReachItAndRingsWhereNot) {
  const Picture picture = drawn(peak());
  EXPECT_EQ(picture.pixel(column_of(5.0), row_of(0.4)), hex_of(kKey));
  const int x = column_of(2.5);
  const int y = row_of(0.1);
  EXPECT_EQ(picture.pixel(x, y), hex_of(kGround));  // the middle of a ring hides the curve
  EXPECT_GT(pixels_of(picture, kKey, x, y, 6), 4);
  EXPECT_EQ(pixels_of(picture, kKey, column_of(7.5), y, 6), 0);
}

TEST(CurvaturePlot, TheSplinesOfATraceAreTakenInTheirOrder) {
  Trace trace;
  const auto add = [&](std::vector<double> s, std::vector<double> kappa, std::vector<double> key) {
    trace.values.push_back({"s", std::move(s)});
    trace.values.push_back({"kappa", std::move(kappa)});
    trace.values.push_back({"key s", std::move(key)});
  };
  trace.values.push_back({"K", {1.0}});
  add({0.0, 1.0}, {0.0, 0.5}, {0.0});
  add({0.0, 1.0, 2.0}, {0.0}, {0.0});  // not equally many
  add({0.0, 3.0}, {0.0, 0.0}, {3.0});
  const auto curves = curvature_curves(trace);
  ASSERT_EQ(curves.size(), 2U);
  EXPECT_EQ(curves[0].kappa_1_m, (std::vector{0.0, 0.5}));
  EXPECT_EQ(curves[1].s_m, (std::vector{0.0, 3.0}));
  EXPECT_EQ(curves[1].key_s_m, (std::vector{3.0}));
  EXPECT_TRUE(curvature_curves({}).empty());
}

TEST(CurvaturePlot, IsDefinedForNothingForAStraightLineAndForWhatIsNotFinite) {
  EXPECT_TRUE(drawn({}).decoded());
  EXPECT_TRUE(drawn({{0.0}, {0.0}, {0.0}}).decoded());
  EXPECT_TRUE(drawn({{0.0, 1.0, 2.0}, {0.0, 0.0, 0.0}, {0.0, 2.0, 5.0}}).decoded());
  CurvatureCurve odd = peak();
  const auto clean = curvature_png(odd);
  odd.s_m.insert(odd.s_m.begin() + 3, std::numeric_limits<double>::quiet_NaN());
  odd.kappa_1_m.insert(odd.kappa_1_m.begin() + 3, 0.1);
  odd.s_m.insert(odd.s_m.begin() + 9, 1.9);
  odd.kappa_1_m.insert(odd.kappa_1_m.begin() + 9, std::numeric_limits<double>::infinity());
  EXPECT_EQ(curvature_png(odd).value(), clean.value());
}

}  // namespace verge::emit
