// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/emit/bev_plot.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include <gtest/gtest.h>

#include "verge/emit/bev_layers.hpp"
#include "verge/emit/bev_objects.hpp"
#include "verge/emit/bev_theme.hpp"
#include "verge/emit/test_folder.hpp"
#include "verge/emit/test_picture.hpp"

namespace verge::emit {
namespace {

void add_point(Scan& scan, float x, float y, float z) {
  scan.x.push_back(x);
  scan.y.push_back(y);
  scan.z.push_back(z);
  scan.range.push_back(std::sqrt(x * x + y * y + z * z));
  scan.azimuth.push_back(std::atan2(y, x));
  scan.ring_begin.back() = static_cast<std::uint32_t>(scan.size());
}

Scan empty_scan() {
  Scan scan;
  scan.frame = "000123";
  scan.ring_begin = {0, 0};
  scan.mount = Mount{1.8, 0.0, 0.0, 0.0};
  return scan;
}

/// Straight kerbs 4 m to the left and right.
Scene street() {
  Scene scene;
  scene.method = "gradient";
  for (const Side side : {Side::kLeft, Side::kRight}) {
    Boundary& boundary = scene.boundaries.emplace_back();
    boundary.side = side;
    const double y = side == Side::kLeft ? 4.0 : -4.0;
    boundary.points = {{-20.0, y, -1.8}, {20.0, y, -1.8}};
  }
  return scene;
}

/// A picture and where the sensor frame's points are on it: 30 m each way on 1200 pixels.
struct Drawn {
  Picture picture;
  [[nodiscard]] std::uint32_t at(double x, double y) const {
    return picture.pixel(static_cast<int>(600.0 - 20.0 * y), static_cast<int>(600.0 - 20.0 * x));
  }
};

Drawn drawn(const BevContent& content, const BevPlot::Config& config = {}) {
  return {Picture(BevPlot(config).png(content).value())};
}

TEST(BevPlot, IsAPngOfTheSizeAskedFor) {
  const Scan scan = empty_scan();
  BevPlot::Config config;
  EXPECT_EQ(drawn({scan, {}}).picture.width(), 1200);
  config.size_px = 300;
  const Drawn small = drawn({scan, {}}, config);
  ASSERT_TRUE(small.picture.decoded());
  EXPECT_EQ(small.picture.width(), 300);
  EXPECT_EQ(small.picture.height(), 300);
}

TEST(BevPlot, BoundariesStandWhereTheyAreInTheColourOfTheirSide) {
  const Scan scan = empty_scan();
  const Scene scene = street();
  const Drawn d = drawn({scan, scene});
  EXPECT_EQ(d.at(5.0, 4.0), hex_of(side_colour(Side::kLeft)));
  EXPECT_EQ(d.at(5.0, -4.0), hex_of(side_colour(Side::kRight)));
  EXPECT_EQ(d.at(-15.0, 4.0), hex_of(side_colour(Side::kLeft)));
  EXPECT_EQ(d.at(22.0, 4.0), hex_of(kGround));
  EXPECT_EQ(d.at(5.0, 2.0), hex_of(kGround));
}

TEST(BevPlot, ObjectsStandWhereTheyAreInTheColourOfTheirClass) {
  const Scan scan = empty_scan();
  Scene scene;
  for (const ObjectClass type : {ObjectClass::kCar, ObjectClass::kPerson, ObjectClass::kRoadside}) {
    Object& object = scene.objects.emplace_back();
    object.type = type;
    object.center = {10.0 * static_cast<double>(scene.objects.size()) - 20.0, 3.0, 0.0};
    object.size = {4.0, 2.0, 1.5};
    object.yaw_rad = std::numbers::pi / 2.0;
  }
  const Drawn d = drawn({scan, scene});
  for (const Object& object : scene.objects) {
    const double x = object.center.x;
    EXPECT_EQ(d.at(x + 1.0, 3.0), hex_of(class_colour(object.type)));  // its flank
    EXPECT_EQ(d.at(x, 5.0), hex_of(class_colour(object.type)));        // its front, to the left
    EXPECT_EQ(d.at(x, 5.3), hex_of(kGround));
  }
  EXPECT_NE(hex_of(class_colour(ObjectClass::kCar)), hex_of(class_colour(ObjectClass::kPerson)));
}

TEST(BevPlot, TheDirectionAskedForPointsUp) {
  const Scan scan = empty_scan();
  Scene scene;
  Boundary& boundary = scene.boundaries.emplace_back();
  boundary.side = Side::kLeft;
  boundary.points = {{4.0, 2.0, 0.0}, {4.0, 8.0, 0.0}};  // beside the way of a sensor that looks along +y
  BevPlot::Config config;
  config.up_rad = std::numbers::pi / 2.0;
  const Drawn d = drawn({scan, scene}, config);
  EXPECT_EQ(d.at(5.0, -4.0), hex_of(side_colour(Side::kLeft)));
}

TEST(BevPlot, BridgedAndOccludedStretchesAreBroken) {
  const Scan scan = empty_scan();
  Scene scene = street();
  scene.boundaries.resize(1);
  const auto coloured_pixels = [&](PointState state) {
    scene.boundaries[0].state = {state, state};
    const Drawn d = drawn({scan, scene});
    int count = 0;
    for (int row = 210; row < 990; ++row) {
      count += d.picture.pixel(520, row) == hex_of(side_colour(Side::kLeft)) ? 1 : 0;
    }
    return count;
  };
  const int visible = coloured_pixels(PointState::kVisible);
  const int bridged = coloured_pixels(PointState::kBridged);
  const int occluded = coloured_pixels(PointState::kOccluded);
  EXPECT_EQ(visible, 780);
  EXPECT_LT(bridged, visible * 9 / 10);
  EXPECT_LT(occluded, bridged);
  EXPECT_GT(occluded, 0);
}

TEST(BevPlot, PointsHaveTheColourOfTheirHeightAboveTheRoad) {
  Scan scan = empty_scan();
  add_point(scan, 5.025F, 1.025F, -1.5F);   // 0.3 m, five twelfths of the scale
  add_point(scan, 5.025F, -1.025F, -0.8F);  // the scale's end, 1 m
  add_point(scan, 8.025F, 1.025F, 0.2F);    // 2 m: above the scale
  add_point(scan, 8.025F, -1.025F, 5.0F);   // above the ceiling
  const Drawn d = drawn({scan, {}});
  EXPECT_EQ(d.at(5.025, 1.025), hex_of(height_colour(std::round(255.0 * 5.0 / 12.0) / 255.0)));
  EXPECT_EQ(d.at(5.025, -1.025), hex_of(height_colour(1.0)));
  EXPECT_EQ(d.at(8.025, 1.025), hex_of(kAboveScale));
  EXPECT_EQ(d.at(8.025, -1.025), hex_of(kGround));
}

TEST(BevPlot, AReturnOfRangeZeroIsNoPoint) {
  Scan scan = empty_scan();
  add_point(scan, 5.025F, 1.025F, -1.8F);
  scan.range[0] = 0.0F;
  EXPECT_EQ(drawn({scan, {}}).at(5.025, 1.025), hex_of(kGround));
}

TEST(HeightScale, TakesPitchAndRollOutOfTheHeights) {
  Scan scan = empty_scan();
  scan.mount = Mount{1.8, 0.1, -0.05, 0.0};
  const HeightScale scale(scan, {});
  const Quaternion level = from_yaw_pitch_roll(0.0, 0.1, -0.05);
  const Pose T_level_sensor{level, {0.0, 0.0, 1.8}};
  const Vec3 p_sensor = inverse(T_level_sensor) * Vec3{7.0, -3.0, 0.12};
  EXPECT_NEAR(scale.height(p_sensor), 0.12, 1e-12);
}

TEST(HeightScale, WithoutAMountCountsFromTheLowestTwentieth) {
  Scan scan = empty_scan();
  scan.mount.reset();
  for (int i = 0; i < 100; ++i) add_point(scan, 1.0F, 0.0F, static_cast<float>(i));
  EXPECT_NEAR(HeightScale(scan, {}).height({0.0, 0.0, 6.0}), 1.0, 1e-12);
}

TEST(BevPlot, LayersOfTheTraceAreDrawnAlsoUnknownOnes) {
  const Scan scan = empty_scan();
  Trace trace;
  trace.points.push_back({"candidates", {{5.025, 1.025, -1.7}}, {0}});
  trace.points.push_back({"clusters", {{8.025, 1.025, -1.7}}, {2}});
  trace.points.push_back({"something new", {{11.025, 1.025, -1.7}}, {}});
  trace.points.push_back({"low", {{14.025, 1.025, -1.8}}, {}});
  const Drawn d = drawn({scan, {}, &trace});
  EXPECT_EQ(d.at(5.025, 1.025), 0xFFD54AU);
  EXPECT_EQ(d.at(8.025, 1.025), hex_of(group_colour(2)));
  EXPECT_EQ(d.at(11.025, 1.025), 0xE6EDF3U);
  EXPECT_NE(d.at(14.025, 1.025), hex_of(kGround));
}

TEST(BevPlot, LinesThroughPointsAreSolidInTheColoursOfThePaper) {
  const Scan scan = empty_scan();
  Trace trace;
  const std::vector<std::pair<std::string, std::uint32_t>> lines = {{"least_squares 0", 0xFF3B3BU},
                                                                    {"theil_sen 1", 0x2FD651U},
                                                                    {"polynomial 12", 0xFF5FD2U},
                                                                    {"hough segment 3", 0xFFB000U}};
  for (const auto& [name, colour] : lines) {
    const double y = 4.0 * static_cast<double>(trace.lines.size()) - 10.0;
    trace.lines.push_back({name, {{-20.0, y, 0.0}, {20.0, y, 0.0}}});
  }
  trace.lines.push_back({"edge left", {{-20.0, 8.0, 0.0}, {20.0, 8.0, 0.0}}});
  const Drawn d = drawn({scan, {}, &trace});
  const auto coloured = [&](double y, std::uint32_t colour) {
    int count = 0;
    for (int i = 0; i < 100; ++i) count += d.at(4.0 + 0.1 * i, y) == colour ? 1 : 0;
    return count;
  };
  for (std::size_t i = 0; i < lines.size(); ++i)
    EXPECT_EQ(coloured(4.0 * static_cast<double>(i) - 10.0, lines[i].second), 100) << lines[i].first;
  EXPECT_GT(coloured(8.0, hex_of(kGround)), 20) << "dotted";
}

TEST(BevPlot, KeyPointsAndCentroidsLieOnBoundaries) {
  const Scan scan = empty_scan();
  const Scene scene = street();
  Trace trace;
  trace.points.push_back({"key points", {{5.025, 4.025, -1.8}}, {}});
  trace.points.push_back({"centroids", {{9.025, 4.025, -1.8}}, {}});
  const Drawn d = drawn({scan, scene, &trace});
  EXPECT_EQ(d.at(5.025, 4.025), 0xFFFFFFU);
  EXPECT_EQ(d.at(9.025, 4.025), 0xFFFFFFU);
}

TEST(BevPlot, TruthLiesOnTop) {
  const Scan scan = empty_scan();
  const Scene scene = street();
  const Drawn d = drawn({scan, scene, nullptr, &scene});
  int white = 0;
  for (int row = 210; row < 990; ++row) white += d.picture.pixel(520, row) == 0xFFFFFFU ? 1 : 0;
  EXPECT_GT(white, 200);
  EXPECT_LT(white, 600);
}

TEST(BevPlot, TheSameContentGivesTheSameBytes) {
  Scan scan = empty_scan();
  for (int i = 0; i < 500; ++i) {
    add_point(scan, static_cast<float>(i % 37) - 18.0F, static_cast<float>(i % 23) - 11.0F,
              -1.8F + 0.01F * static_cast<float>(i));
  }
  const Scene scene = street();
  EXPECT_EQ(BevPlot().png({scan, scene}).value(), BevPlot().png({scan, scene}).value());
}

TEST(BevPlot, DegenerateContentIsDrawn) {
  Scan scan = empty_scan();
  scan.frame = std::string("n\xFF\x1B[31m") + std::string(300, 'x');
  scan.mount.reset();
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  Scene scene;
  scene.boundaries.resize(3);
  scene.boundaries[1].points = {{1.0, 2.0, 0.0}};
  scene.boundaries[2].points = {{-1e12, 2.0, 0.0}, {1e300, kNan, 0.0}, {1e12, 2.0, 0.0}};
  Trace trace;
  trace.points.push_back({"clusters", {{kNan, 0.0, 0.0}, {1.0, 0.0, kNan}}, {1}});
  trace.points.push_back({"low", {{1.0, 0.0, kNan}}, {}});
  for (int i = 0; i < 60; ++i) trace.lines.push_back({std::string(200, static_cast<char>('A' + i)), {}});
  const Drawn d = drawn({scan, scene, &trace, &scene});
  EXPECT_TRUE(d.picture.decoded());
  EXPECT_EQ(d.at(1.0, 2.0), 0xFFFFFFU) << "truth of one point";
}

TEST(BevPlot, AConfigurationOutOfRangeIsRefused) {
  BevPlot::Config config;
  config.size_px = 100'000;
  EXPECT_THROW(BevPlot{config}, std::invalid_argument);
  config = {};
  config.height_max_m = config.height_min_m;
  EXPECT_THROW(BevPlot{config}, std::invalid_argument);
}

using BevFileTest = TestFolder;

TEST_F(BevFileTest, IsWrittenWhole) {
  const Scan scan = empty_scan();
  const Scene scene = street();
  ASSERT_TRUE(BevPlot().write(folder_ / "000123.png", {scan, scene}));
  EXPECT_EQ(content(folder_ / "000123.png"), BevPlot().png({scan, scene}).value());
  EXPECT_EQ(entries(), 1U);
}

TEST_F(BevFileTest, WhereItCannotBeWrittenNothingIsLeft) {
  const Scan scan = empty_scan();
  const auto missing = BevPlot().write(folder_ / "none" / "a.png", {scan, {}});
  ASSERT_FALSE(missing.has_value());
  EXPECT_EQ(missing.error().code, ErrorCode::kCannotWrite);
  EXPECT_EQ(BevPlot().write(folder_, {scan, {}}).error().code, ErrorCode::kCannotWrite);
  EXPECT_EQ(entries(), 0U);
}

}  // namespace
}  // namespace verge::emit
