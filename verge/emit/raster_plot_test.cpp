// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/emit/raster_plot.hpp"

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "verge/emit/bev_theme.hpp"
#include "verge/emit/test_picture.hpp"

namespace verge::emit {
namespace {

/// 20 m ahead and 15 m to either side, a pixel a metre; all 0 but for what the test sets.
Trace::Raster birds_eye() {
  return {"squares",
          21,
          31,
          std::vector<float>(std::size_t{21} * 31),
          {"y", "m", 15.0, -1.0},
          {"x", "m", 20.0, -1.0}};
}

/// Angles and distances, two units.
Trace::Raster accumulator() {
  Trace::Raster raster{"accumulator", 2001, 180, {}, {"theta", "deg", -90.0, 1.0}, {"rho", "m", -100.0, 0.1}};
  raster.values.resize(raster.rows * raster.cols);
  return raster;
}

Picture drawn(const Trace::Raster& raster, RasterColours colours, std::span<const Vec2> marks = {}) {
  return Picture(raster_png(raster, colours, marks).value());
}

int pixels_of(const Picture& picture, Colour colour, int from_x, int to_x, int from_y, int to_y) {
  int count = 0;
  for (int y = from_y; y < to_y; ++y) {
    for (int x = from_x; x < to_x; ++x) count += picture.pixel(x, y) == hex_of(colour) ? 1 : 0;
  }
  return count;
}

}  // namespace

TEST(RasterPlot, AxesOfOneUnitHaveOneScale) {
  Trace::Raster raster = birds_eye();
  raster.values[0] = 200.0F;  // the upper left cell
  const Picture picture = drawn(raster, RasterColours::kGrey);
  EXPECT_EQ(picture.width(), 1200);
  EXPECT_EQ(picture.height(), 44 + 732 + 64);  // 1080 / 31 pixels a metre
  EXPECT_EQ(pixels_of(picture, rgb(0xFFFFFF), 90, 125, 44, 79), 35 * 35);
  EXPECT_EQ(picture.pixel(126, 50), 0U);
  EXPECT_EQ(picture.pixel(100, 80), 0U);
}

TEST(RasterPlot, GreyIsByShareAndHeatByItsRoot) {
  Trace::Raster raster = birds_eye();
  raster.values[0] = 255.0F;
  raster.values[2] = 51.0F;
  const int x = 90 + 87;  // in the third cell
  EXPECT_EQ(drawn(raster, RasterColours::kGrey).pixel(x, 60), 0x333333U);
  EXPECT_EQ(drawn(raster, RasterColours::kHeat).pixel(x, 60), hex_of(height_colour(std::sqrt(0.2))));
  EXPECT_EQ(drawn(raster, RasterColours::kHeat).pixel(100, 60), hex_of(height_colour(1.0)));
}

TEST(RasterPlot, ALoneCellStaysVisibleWhereManyShareAPixel) {
  Trace::Raster raster = accumulator();
  raster.values[std::size_t{1001} * raster.cols + 90] = 7.0F;
  const Picture picture = drawn(raster, RasterColours::kHeat);
  EXPECT_EQ(picture.height(), 44 + 700 + 64);
  EXPECT_EQ(pixels_of(picture, height_colour(1.0), 90, 1170, 44, 744), 6);  // six pixels a degree, one high
}

TEST(RasterPlot, MarksAreSquaresAboutTheirPlace) {
  const Trace::Raster raster = accumulator();
  const Picture bare = drawn(raster, RasterColours::kHeat);
  const Picture marked = drawn(raster, RasterColours::kHeat, std::array{Vec2{0.0, 0.0}});
  const int x = 90 + 543;  // the middle of the 91st of 180 columns of six pixels
  const int y = 44 + 350;
  for (const auto& [dx, dy] : {std::pair(-9, 0), std::pair(9, 0), std::pair(0, -9), std::pair(0, 9)}) {
    EXPECT_EQ(pixels_of(marked, kTruth, x + dx - 2, x + dx + 2, y + dy - 2, y + dy + 2) > 0, true)
        << dx << ' ' << dy;
  }
  EXPECT_EQ(marked.pixel(x, y), bare.pixel(x, y));
  const auto outside =
      std::array{Vec2{95.0, 0.0}, Vec2{0.0, -101.0}, Vec2{std::numeric_limits<double>::quiet_NaN(), 0.0}};
  EXPECT_EQ(raster_png(raster, RasterColours::kHeat, outside).value(),
            raster_png(raster, RasterColours::kHeat).value());
}

TEST(RasterPlot, IsDefinedForNothingAndForWhatIsNoNumber) {
  EXPECT_TRUE(Picture(raster_png({}, RasterColours::kGrey).value()).decoded());
  Trace::Raster raster = birds_eye();
  raster.values[0] = std::numeric_limits<float>::quiet_NaN();
  raster.values[1] = -3.0F;
  const Picture empty = drawn(raster, RasterColours::kHeat);
  EXPECT_EQ(pixels_of(empty, rgb(0x000000), 90, 1170, 44, 776), 1080 * 732);
  raster.values[5] = 1.0F;
  EXPECT_EQ(drawn(raster, RasterColours::kHeat).pixel(100, 60), 0U);
}

TEST(RasterPlot, TheSameRasterGivesTheSameBytes) {
  Trace::Raster raster = accumulator();
  for (std::size_t i = 0; i < raster.values.size(); ++i) raster.values[i] = static_cast<float>(i % 97);
  EXPECT_EQ(raster_png(raster, RasterColours::kHeat).value(),
            raster_png(raster, RasterColours::kHeat).value());
}

}  // namespace verge::emit
