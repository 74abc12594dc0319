// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/emit/canvas.hpp"

#include <array>
#include <cstdlib>
#include <limits>

#include <gtest/gtest.h>

#include "verge/emit/test_picture.hpp"

namespace verge::emit {
namespace {

constexpr std::uint32_t kBlue = 0x102030;

Canvas small_canvas() { return Canvas(40, 30, rgb(kBlue)); }

/// Every pixel as it was at the start.
bool is_blank(const Canvas& canvas) { return canvas.png().value() == small_canvas().png().value(); }

TEST(Canvas, BecomesAPngOfItsSize) {
  const Picture picture(small_canvas().png().value());
  ASSERT_TRUE(picture.decoded());
  EXPECT_EQ(picture.width(), 40);
  EXPECT_EQ(picture.height(), 30);
  EXPECT_EQ(picture.pixel(0, 0), kBlue);
  EXPECT_EQ(picture.pixel(39, 29), kBlue);
}

TEST(Canvas, ADotFillsItsMiddleAndFadesAtItsRim) {
  Canvas canvas = small_canvas();
  canvas.dots(std::array{Vec2{10.5, 20.5}}, 2.0, rgb(0xFFFFFF));
  const Picture picture(canvas.png().value());
  EXPECT_EQ(picture.pixel(10, 20), 0xFFFFFFU);
  EXPECT_EQ(picture.pixel(11, 20), 0xFFFFFFU);
  EXPECT_EQ(picture.pixel(12, 20), 0x889098U);  // half covered: half way from 0x102030 to white
  EXPECT_EQ(picture.pixel(13, 20), kBlue);
  EXPECT_EQ(picture.pixel(10, 24), kBlue);
}

TEST(Canvas, ATransparentDotMixes) {
  Canvas canvas(8, 8, rgb(0x000000));
  canvas.dots(std::array{Vec2{4.5, 4.5}}, 2.0, rgb(0xFF0000, 0.5));
  EXPECT_EQ(Picture(canvas.png().value()).pixel(4, 4), 0x800000U);
}

TEST(Canvas, AnImageIsItsPixelsAndEndsAtTheEdge) {
  Canvas canvas = small_canvas();
  canvas.image(38, 28, 3,
               std::array<std::uint32_t, 6>{0x010203, 0x040506, 0x070809, 0xA0B0C0, 0xFFFFFF, 0x0});
  canvas.image(-1, -1, 2, std::array<std::uint32_t, 4>{0xFFFFFF, 0xFFFFFF, 0xFFFFFF, 0xABCDEF});
  const Picture picture(canvas.png().value());
  EXPECT_EQ(picture.pixel(38, 28), 0x010203U);
  EXPECT_EQ(picture.pixel(39, 28), 0x040506U);
  EXPECT_EQ(picture.pixel(38, 29), 0xA0B0C0U);
  EXPECT_EQ(picture.pixel(0, 0), 0xABCDEFU);
  EXPECT_EQ(picture.pixel(1, 0), kBlue);
  EXPECT_EQ(picture.pixel(37, 28), kBlue);
}

TEST(Canvas, DotsOutsideOrNotFiniteDrawNothing) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kHuge = 1e300;
  Canvas canvas = small_canvas();
  canvas.dots(
      std::array{Vec2{-5.0, 10.0}, Vec2{10.0, 35.0}, Vec2{kNan, 10.0}, Vec2{10.0, kNan}, Vec2{kHuge, -kHuge}},
      2.0, rgb(0xFFFFFF));
  EXPECT_TRUE(is_blank(canvas));
}

TEST(Canvas, ALineAndABoxCoverTheirPixels) {
  Canvas canvas = small_canvas();
  canvas.line(std::array{Vec2{0.0, 5.0}, Vec2{40.0, 5.0}}, {4.0, rgb(0x00FF00), {}});
  canvas.box({30.0, 20.0}, {5.0, 5.0}, rgb(0xFF0000));
  const Picture picture(canvas.png().value());
  EXPECT_EQ(picture.pixel(20, 5), 0x00FF00U);
  EXPECT_EQ(picture.pixel(20, 8), kBlue);
  EXPECT_EQ(picture.pixel(32, 22), 0xFF0000U);
}

TEST(Canvas, TextThatIsNoUtf8IsShownAndDoesNotSpoilThePicture) {
  Canvas canvas = small_canvas();
  canvas.text({2.0, 20.0}, "a\xFF\xFE z", {16.0, rgb(0xFFFFFF), false, Align::kLeft, rgb(0x000000)});
  EXPECT_TRUE(Picture(canvas.png().value()).decoded());
  EXPECT_FALSE(is_blank(canvas));
}

TEST(Canvas, WiderTextIsWider) {
  const Canvas canvas = small_canvas();
  const TextStyle style{16.0, rgb(0xFFFFFF), false, Align::kLeft, {}};
  EXPECT_GT(canvas.text_width("boundary", style), canvas.text_width("bound", style));
  EXPECT_EQ(canvas.text_width("", style), 0.0);
}

TEST(Canvas, ASizeThatCannotBeIsAnErrorAndNoCrash) {
  Canvas canvas(40'000, 10, rgb(kBlue));
  canvas.dots(std::array{Vec2{5.0, 5.0}}, 2.0, rgb(0xFFFFFF));
  const auto png = canvas.png();
  ASSERT_FALSE(png.has_value());
  EXPECT_EQ(png.error().code, ErrorCode::kLimit);
}

TEST(CanvasDeathTest, WithoutAnyFontThePictureIsStillMade) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");  // a process of its own, which has not looked for fonts yet
  const auto draw = [] {
    ::setenv("FONTCONFIG_FILE", "/nonexistent/fonts.conf", 1);
    Canvas canvas = small_canvas();
    canvas.text({2.0, 20.0}, "text", {16.0, rgb(0xFFFFFF), true, Align::kLeft, {}});
    std::exit(canvas.png().has_value() ? 0 : 1);
  };
  EXPECT_EXIT(draw(), ::testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace verge::emit
