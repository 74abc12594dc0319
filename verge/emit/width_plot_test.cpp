// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/emit/width_plot.hpp"

#include <gtest/gtest.h>

#include "verge/emit/bev_layers.hpp"
#include "verge/emit/test_picture.hpp"

namespace verge::emit {
namespace {

Scene scene_with(int corner_id) {
  Scene scene;
  scene.frame = "000007";
  if (corner_id < 0) return scene;
  Corner corner;
  corner.id = corner_id;
  corner.side = CornerSide::kRight;
  scene.corners = {corner};
  return scene;
}

Trace lengths(double first_m, double last_m) {
  Trace trace;
  trace.values.push_back({"L", {first_m, last_m}});
  return trace;
}

/// A drive of 21 scans, a corner at the middle one.
WidthPlot drive(bool with_states) {
  WidthPlot plot;
  for (int i = 0; i < 21; ++i) {
    Trace trace = lengths(i < 10 ? 5.0 : 8.0, 5.0);
    if (with_states) {
      trace.values.push_back({"first comparison", {i < 10 ? 0.0 : 3.0, 1.0}});
      trace.values.push_back({"second comparison", {i < 10 ? 0.0 : 3.0, 1.0}});
      trace.values.push_back({"K", {i < 10 ? 0.0 : 2.0, 2.0}});
      trace.values.push_back({"CCS", {i < 10 ? 0.0 : 1.0}});
    }
    plot.add(scene_with(i < 10 ? -1 : 3), trace);
  }
  return plot;
}

/// Columns of the first panel that hold a pixel of that colour in every row.
int full_columns(const Picture& picture, Colour colour) {
  int columns = 0;
  for (int x = 0; x < picture.width(); ++x) {
    int rows = 0;
    for (int y = 70; y < 250; ++y) rows += picture.pixel(x, y) == hex_of(colour) ? 1 : 0;
    columns += rows > 150 ? 1 : 0;
  }
  return columns;
}

}  // namespace

TEST(WidthPlot, ACornerIsMarkedOnceInTheColourOfItsSide) {
  const auto png = drive(false).png();
  ASSERT_TRUE(png);
  const Picture picture(*png);
  ASSERT_TRUE(picture.decoded());
  EXPECT_EQ(picture.width(), 1200);
  const int columns = full_columns(picture, side_colour(Side::kRight));
  EXPECT_GE(columns, 1);
  EXPECT_LE(columns, 3);  // one line, though eleven scans say it
  EXPECT_EQ(full_columns(picture, side_colour(Side::kLeft)), 0);
}

TEST(WidthPlot, StatesHavePanelsOfTheirOwn) {
  const auto without = drive(false).png();
  const auto with = drive(true).png();
  ASSERT_TRUE(without && with);
  EXPECT_GT(Picture(*with).height(), 3 * Picture(*without).height());
}

TEST(WidthPlot, TheSameScansGiveTheSameBytes) {
  const auto one = drive(true).png();
  const auto two = drive(true).png();
  ASSERT_TRUE(one && two);
  EXPECT_EQ(*one, *two);
}

TEST(WidthPlot, IsDefinedForNoScansAndForScansWithoutLengths) {
  WidthPlot plot;
  EXPECT_FALSE(plot.has_lengths());
  EXPECT_TRUE(plot.png());
  plot.add(scene_with(1), Trace{});
  EXPECT_FALSE(plot.has_lengths());
  EXPECT_TRUE(plot.png());
  plot.add(scene_with(1), lengths(5.0, 5.0));
  EXPECT_TRUE(plot.has_lengths());
  EXPECT_EQ(plot.size(), 2U);
  EXPECT_TRUE(plot.png());
  plot.clear();
  EXPECT_EQ(plot.size(), 0U);
}

}  // namespace verge::emit
