// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/emit/scene_json.hpp"

#include <cmath>
#include <limits>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace verge::emit {
namespace {

using ::testing::HasSubstr;

Scene scene_with_everything() {
  Scene scene;
  scene.frame = "000123";
  scene.stamp_ns = 1700000000123456789;
  scene.boundaries.push_back({7,
                              Side::kLeft,
                              Model::kLine,
                              BoundaryKind::kCurb,
                              0.97,
                              {{1.0, 2.5, -1.84}, {3.00004, -0.00004, 0.12345}},
                              {0.12, 0.1},
                              {PointState::kVisible, PointState::kOccluded}});
  scene.openings.push_back({{Vec2{4.0, 4.1}, Vec2{9.0, 4.0}}, 5.001, 0.7});
  scene.corners.push_back({3, CornerSide::kBoth, {8.0, -3.5}, 0.3, 8.2, 5.0, 13.1, 0.9});
  scene.corners.push_back({4, CornerSide::kRight, {9.0, -3.5}, {}, {}, {}, {}, 0.2});
  scene.junctions.push_back({JunctionType::kDeadEnd, {20.0, 0.0}, {-3.0, 1.5}, 0.8});
  scene.objects.push_back(
      {9, ObjectClass::kVan, ObjectShape::kJ, {10.0, 2.0, -1.0}, {5.0, 2.0, 1.9}, 0.1, 0.8});
  scene.objects.push_back({10, ObjectClass::kPole, {}, {1.0, 2.0, 0.0}, {0.2, 0.2, 4.0}, 0.0, 1.0});
  scene.road = RoadSurface{{{0.0, 7.0}, {5.0, 6.5}}, {{0.0, -3.0}, {20.0, -3.0}, {20.0, 3.0}}};
  scene.health = Health{"degraded", 0.75, {{-3.14159265, -2.5}}};
  scene.method = "gradient";
  scene.version = "0.1.0";
  scene.config_hash = "00ff";
  return scene;
}

// ---- Closed form

TEST(SceneJson, TheLineIsTheDocumentedOne) {
  EXPECT_EQ(to_json_line(scene_with_everything()),
            R"({"schema":1,"frame":"000123","stamp_ns":1700000000123456789,"frame_id":"sensor",)"
            R"("boundaries":[{"id":7,"side":"left","model":"line","kind":"curb","confidence":0.97,)"
            R"("points":[[1.0,2.5,-1.84],[3.0,0.0,0.1235]],"height_m":[0.12,0.1],)"
            R"("state":["visible","occluded"]}],)"
            R"("openings":[{"ends":[[4.0,4.1],[9.0,4.0]],"width_m":5.001,"confidence":0.7}],)"
            R"("corners":[{"id":3,"side":"both","sigma_m":0.3,"distance_m":8.2,"width_m":5.0,"exit_m":13.1,)"
            R"("confidence":0.9,"position":[8.0,-3.5]},)"
            R"({"id":4,"side":"right","confidence":0.2,"position":[9.0,-3.5]}],)"
            R"("junctions":[{"type":"dead_end","branches_rad":[-3.0,1.5],"confidence":0.8,)"
            R"("center":[20.0,0.0]}],)"
            R"("objects":[{"id":9,"class":"van","shape":"J","size":[5.0,2.0,1.9],"yaw_rad":0.1,)"
            R"("confidence":0.8,"center":[10.0,2.0,-1.0]},)"
            R"({"id":10,"class":"pole","size":[0.2,0.2,4.0],"yaw_rad":0.0,"confidence":1.0,)"
            R"("center":[1.0,2.0,0.0]}],)"
            R"("road":{"width_m":[[0.0,7.0],[5.0,6.5]],"polygon":[[0.0,-3.0],[20.0,-3.0],[20.0,3.0]]},)"
            R"("health":{"state":"degraded","completeness":0.75,"unobserved":[[-3.1416,-2.5]]},)"
            R"("method":"gradient","version":"0.1.0","config_hash":"00ff"})");
}

TEST(SceneJson, WhatAMethodDoesNotMakeIsLeftOut) {
  EXPECT_EQ(to_json_line(Scene{}),
            R"({"schema":1,"frame":"","stamp_ns":null,"frame_id":"sensor","boundaries":[]})");
}

TEST(SceneJson, ANameThatIsNotUtf8BecomesValidText) {
  Scene scene;
  scene.frame = "scan\xFF\n";
  EXPECT_THAT(to_json_line(scene), HasSubstr("\"scan\xEF\xBF\xBD\\n\""));
}

#ifndef NDEBUG
TEST(SceneJsonDeathTest, ANumberThatIsNotFiniteIsABug) {
  Scene scene;
  scene.boundaries.emplace_back().points = {{std::numeric_limits<double>::quiet_NaN(), 0.0, 0.0}};
  EXPECT_DEATH(static_cast<void>(to_json_line(scene)), "isfinite");
}
#endif

template <class Enum>
void expect_every_name_survives(Enum Boundary::*field) {
  for (std::size_t i = 0; i < enum_names<Enum>.size(); ++i) {
    Scene scene;
    scene.boundaries.emplace_back().*field = static_cast<Enum>(i);
    const std::string line = to_json_line(scene);
    EXPECT_THAT(line, HasSubstr("\"" + std::string(enum_names<Enum>[i]) + "\""));
    EXPECT_EQ(parse_scene(line)->boundaries.at(0).*field, static_cast<Enum>(i));
  }
}

TEST(SceneJson, EveryEnumValueIsSpelledAndRead) {
  expect_every_name_survives(&Boundary::side);
  expect_every_name_survives(&Boundary::model);
  expect_every_name_survives(&Boundary::kind);
  for (std::size_t i = 0; i < enum_names<PointState>.size(); ++i) {
    Scene scene;
    Boundary& boundary = scene.boundaries.emplace_back();
    boundary.points = {{}};
    boundary.state = {static_cast<PointState>(i)};
    EXPECT_EQ(parse_scene(to_json_line(scene))->boundaries.at(0).state, boundary.state);
  }
}

// ---- Reading

TEST(ParseScene, ReadsBackWhatWasWritten) {
  const Scene scene = parse_scene(to_json_line(scene_with_everything())).value();
  EXPECT_EQ(scene.frame, "000123");
  EXPECT_EQ(scene.stamp_ns, 1700000000123456789);
  ASSERT_EQ(scene.boundaries.size(), 1U);
  const Boundary& boundary = scene.boundaries[0];
  EXPECT_EQ(boundary.id, 7);
  EXPECT_EQ(boundary.confidence, 0.97);
  EXPECT_EQ(boundary.points, (std::vector<Vec3>{{1.0, 2.5, -1.84}, {3.0, 0.0, 0.1235}}));
  EXPECT_EQ(boundary.height_m, (std::vector<double>{0.12, 0.1}));
  EXPECT_EQ(boundary.state, (std::vector<PointState>{PointState::kVisible, PointState::kOccluded}));
  EXPECT_EQ(scene.openings.at(0).ends[1], (Vec2{9.0, 4.0}));
  EXPECT_EQ(scene.openings.at(0).width_m, 5.001);
  EXPECT_EQ(scene.corners.at(0).exit_m, 13.1);
  EXPECT_EQ(scene.corners.at(0).side, CornerSide::kBoth);
  EXPECT_FALSE(scene.corners.at(1).distance_m.has_value());
  EXPECT_EQ(scene.junctions.at(0).branches_rad, (std::vector<double>{-3.0, 1.5}));
  EXPECT_EQ(scene.objects.at(0).shape, ObjectShape::kJ);
  EXPECT_EQ(scene.objects.at(0).size, (BoxSize{5.0, 2.0, 1.9}));
  EXPECT_FALSE(scene.objects.at(1).shape.has_value());
  ASSERT_TRUE(scene.road.has_value());
  EXPECT_EQ(scene.road->width_m.at(1), (RoadWidth{5.0, 6.5}));
  EXPECT_EQ(scene.road->polygon.at(2), (Vec2{20.0, 3.0}));
  ASSERT_TRUE(scene.health.has_value());
  EXPECT_EQ(scene.health->state, "degraded");
  EXPECT_EQ(scene.health->completeness, 0.75);
  EXPECT_EQ(scene.health->unobserved.at(0).to_rad, -2.5);
  EXPECT_EQ(scene.method + scene.version + scene.config_hash, "gradient0.1.000ff");
}

TEST(ParseScene, AMinimalRecordOfAnotherProgramIsEnough) {
  const Scene scene =
      parse_scene(R"({"frame": "7", "tool": {"x": [1]}, "boundaries": [{"points": [[1, 2]], "weight": 3}]})")
          .value();
  EXPECT_EQ(scene.frame, "7");
  EXPECT_FALSE(scene.stamp_ns.has_value());
  EXPECT_FALSE(scene.health.has_value());
  ASSERT_EQ(scene.boundaries.size(), 1U);
  EXPECT_EQ(scene.boundaries[0].points, (std::vector<Vec3>{{1.0, 2.0, 0.0}}));
  EXPECT_EQ(scene.boundaries[0].side, Side::kOther);
  EXPECT_EQ(scene.boundaries[0].confidence, 1.0);
}

TEST(ParseScene, BarePointsBelongToNoLine) {
  const Scene scene = parse_scene(R"({"frame":"7","points":[[1,2,3],[4,5]]})").value();
  ASSERT_EQ(scene.boundaries.size(), 2U);
  EXPECT_EQ(scene.boundaries[0].points, (std::vector<Vec3>{{1.0, 2.0, 3.0}}));
  EXPECT_EQ(scene.boundaries[1].points, (std::vector<Vec3>{{4.0, 5.0, 0.0}}));
}

TEST(ParseScene, AFrameMayBeANumberAndAPointMaySayMoreThanItsPlace) {
  const Scene scene = parse_scene(R"({"frame":12,"points":[[1,2,3,"intensity"]]})").value();
  EXPECT_EQ(scene.frame, "12");
  EXPECT_EQ(scene.boundaries.at(0).points, (std::vector<Vec3>{{1.0, 2.0, 3.0}}));
}

TEST(ParseScene, AnOpeningWithoutAWidthHasThatOfItsEnds) {
  const Scene scene = parse_scene(R"({"frame":"7","points":[],"openings":[{"ends":[[0,0],[3,4]]}]})").value();
  EXPECT_EQ(scene.openings.at(0).width_m, 5.0);
  EXPECT_EQ(scene.openings.at(0).confidence, 1.0);
}

TEST(ParseScene, NoBoundariesIsAScene) {
  EXPECT_TRUE(parse_scene(R"({"frame":"7","boundaries":[]})")->boundaries.empty());
  EXPECT_TRUE(parse_scene(R"({"frame":"7","points":[]})")->boundaries.empty());
}

struct BadLine {
  std::string_view line;
  std::string_view before;  ///< The column is that of the byte after this text.
  std::string_view what;
};

class ParseSceneBad : public ::testing::TestWithParam<BadLine> {};

TEST_P(ParseSceneBad, IsAnErrorAtItsColumn) {
  const auto [line, before, what] = GetParam();
  ASSERT_TRUE(line.starts_with(before));
  const auto scene = parse_scene(line, 12);
  ASSERT_FALSE(scene.has_value());
  EXPECT_EQ(scene.error().code, ErrorCode::kUnusable);
  EXPECT_EQ(scene.error().where, "12:" + std::to_string(before.size() + 1));
  EXPECT_THAT(to_string(scene.error()), HasSubstr(what));
}

INSTANTIATE_TEST_SUITE_P(
    Cases, ParseSceneBad,
    ::testing::Values(
        BadLine{"", "", "not JSON"}, BadLine{R"({"frame")", R"({"frame")", "not JSON"},
        BadLine{R"({"frame":"1","points":[[1,NaN]]})", R"({"frame":"1","points":[[1,)", "not JSON"},
        BadLine{R"({"frame":"1","points":[]} {})", R"({"frame":"1","points":[]} )", "not JSON"},
        BadLine{"[]", "", "got array, need an object"}, BadLine{R"({"points":[]})", "", "without a frame"},
        BadLine{R"({"frame":null,"points":[]})", "", "without a frame"},
        BadLine{R"({"frame":"1"})", "", "without boundaries"},
        BadLine{R"({"frame": 1.5,"points":[]})", R"({"frame": )", "got number, need a string"},
        BadLine{R"({"schema":2,"frame":"1","points":[]})", R"({"schema":)", "got 2, need 1"},
        BadLine{R"({"stamp_ns":1.5,"frame":"1","points":[]})", R"({"stamp_ns":)", "an integer"},
        BadLine{R"({"stamp_ns":9223372036854775808,"frame":"1","points":[]})", R"({"stamp_ns":)",
                "out of range"},
        BadLine{R"({"frame":"1","boundaries":{}})", R"({"frame":"1","boundaries":)",
                "got object, need an array"},
        BadLine{R"({"frame":"1","boundaries":[{"side":"middle"}]})", R"({"frame":"1","boundaries":[{"side":)",
                "got middle, need left, right, island, other"},
        BadLine{R"({"frame":"1","boundaries":[{"id":3000000000}]})", R"({"frame":"1","boundaries":[{"id":)",
                "out of range"},
        BadLine{R"({"frame":"1","boundaries":[{}, {"confidence":1.5}]})",
                R"({"frame":"1","boundaries":[{}, {"confidence":)", "got 1.5, need 0 to 1"},
        BadLine{R"({"frame":"1","boundaries":[{"points":[[1,2],[1,2,"3"]]}]})",
                R"({"frame":"1","boundaries":[{"points":[[1,2],[1,2,)", "got string, need a number"},
        BadLine{R"({"frame":"1","points":[[1,2,3],[1]]})", R"({"frame":"1","points":[[1,2,3],)",
                "got 1 numbers, need 2 or 3"},
        BadLine{R"({"frame":"1","boundaries":[{"points":[[1,2]],"state":[]}]})",
                R"({"frame":"1","boundaries":[{"points":[[1,2]],"state":)", "got 0, need 1"},
        BadLine{R"({"frame":"1","points":[],"openings":[{"ends":[[1,2]]}]})",
                R"({"frame":"1","points":[],"openings":[{"ends":)", "got 1 points, need 2"},
        BadLine{R"({"frame":"1","points":[],"corners":[{},{"position":[1,2]}]})",
                R"({"frame":"1","points":[],"corners":[)", "need \"position\""},
        BadLine{R"({"frame":"1","points":[],"corners":[{"position":[1,2],"width_m":-1}]})",
                R"({"frame":"1","points":[],"corners":[{"position":[1,2],"width_m":)", "a negative size"},
        BadLine{R"({"frame":"1","points":[],"junctions":[{"center":[1,2],"type":"Y"}]})",
                R"({"frame":"1","points":[],"junctions":[{"center":[1,2],"type":)", "unknown name"},
        BadLine{R"({"frame":"1","points":[],"objects":[{"center":[1,2],"size":[1,2,-3]}]})",
                R"({"frame":"1","points":[],"objects":[{"center":[1,2],"size":)", "a negative size"},
        BadLine{R"({"frame":"1","points":[],"road":[]})", R"({"frame":"1","points":[],"road":)",
                "got array, need an object"},
        BadLine{R"({"frame":"1","points":[],"health":{"unobserved":[[1,2],[3]]}})",
                R"({"frame":"1","points":[],"health":{"unobserved":[[1,2],)", "need 2"}));

// ---- Laws

/// Any finite coordinate of a scene: small ones, and some far beyond every sensor.
rc::Gen<double> coordinate() {
  return rc::gen::map(
      rc::gen::pair(rc::gen::inRange<std::int64_t>(-1'000'000'000'000, 1'000'000'000'000),
                    rc::gen::inRange(-9, 9)),
      [](const auto& p) { return static_cast<double>(p.first) * std::pow(10.0, p.second - 9); });
}

Boundary any_boundary() {
  Boundary boundary;
  boundary.id = *rc::gen::arbitrary<int>();
  boundary.side = static_cast<Side>(*rc::gen::inRange(0, 4));
  boundary.model = static_cast<Model>(*rc::gen::inRange(0, 3));
  boundary.kind = static_cast<BoundaryKind>(*rc::gen::inRange(0, 6));
  boundary.confidence = *rc::gen::inRange(0, 1'000'001) * 1e-6;
  const int points = *rc::gen::inRange(0, 6);
  const bool heights = *rc::gen::arbitrary<bool>();
  const bool states = *rc::gen::arbitrary<bool>();
  for (int i = 0; i < points; ++i) {
    boundary.points.push_back({*coordinate(), *coordinate(), *coordinate()});
    if (heights) boundary.height_m.push_back(*coordinate());
    if (states) boundary.state.push_back(static_cast<PointState>(*rc::gen::inRange(0, 3)));
  }
  return boundary;
}

Object any_object() {
  Object object;
  object.type = static_cast<ObjectClass>(*rc::gen::inRange(0, 8));
  if (*rc::gen::arbitrary<bool>()) object.shape = static_cast<ObjectShape>(*rc::gen::inRange(0, 3));
  object.center = {*coordinate(), *coordinate(), *coordinate()};
  object.size = {std::fabs(*coordinate()), std::fabs(*coordinate()), std::fabs(*coordinate())};
  object.yaw_rad = *coordinate();
  return object;
}

Corner any_corner() {
  Corner corner;
  corner.side = static_cast<CornerSide>(*rc::gen::inRange(0, 3));
  corner.position = {*coordinate(), *coordinate()};
  if (*rc::gen::arbitrary<bool>()) corner.sigma_m = std::fabs(*coordinate());
  if (*rc::gen::arbitrary<bool>()) corner.distance_m = *coordinate();
  if (*rc::gen::arbitrary<bool>()) corner.width_m = std::fabs(*coordinate());
  if (*rc::gen::arbitrary<bool>()) corner.exit_m = *coordinate();
  return corner;
}

/// Some of the parts that not every method makes.
void add_any_parts(Scene& scene) {
  for (int i = *rc::gen::inRange(0, 3); i > 0; --i) scene.corners.push_back(any_corner());
  for (int i = *rc::gen::inRange(0, 3); i > 0; --i) scene.objects.push_back(any_object());
  for (int i = *rc::gen::inRange(0, 3); i > 0; --i) {
    scene.openings.push_back({{Vec2{*coordinate(), *coordinate()}, Vec2{*coordinate(), *coordinate()}},
                              std::fabs(*coordinate()),
                              1.0});
  }
  for (int i = *rc::gen::inRange(0, 3); i > 0; --i) {
    scene.junctions.push_back({static_cast<JunctionType>(*rc::gen::inRange(0, 6)),
                               {*coordinate(), *coordinate()},
                               {*coordinate(), *coordinate()},
                               0.5});
  }
  if (*rc::gen::arbitrary<bool>()) scene.road.emplace();
  for (int i = *rc::gen::inRange(0, 3); scene.road && i > 0; --i) {
    scene.road->polygon.push_back({*coordinate(), *coordinate()});
    scene.road->width_m.push_back({*coordinate(), *coordinate()});
  }
}

Scene any_scene() {
  Scene scene;
  scene.frame = *rc::gen::string<std::string>();
  if (*rc::gen::arbitrary<bool>()) scene.stamp_ns = *rc::gen::arbitrary<std::int64_t>();
  const int boundaries = *rc::gen::inRange(0, 4);
  for (int i = 0; i < boundaries; ++i) scene.boundaries.push_back(any_boundary());
  if (*rc::gen::arbitrary<bool>()) scene.health = Health{"ok", 1.0, {{*coordinate(), *coordinate()}}};
  scene.method = *rc::gen::string<std::string>();
  add_any_parts(scene);
  return scene;
}

RC_GTEST_PROP(SceneJsonLaw, WritingReadingAndWritingGivesTheSameBytes, ()) {
  const std::string line = to_json_line(any_scene());
  RC_ASSERT(line.find('\n') == std::string::npos);
  RC_ASSERT(to_json_line(parse_scene(line).value()) == line);
}

RC_GTEST_PROP(SceneJsonLaw, ReadingGivesEveryBoundaryBackToTheRounding, ()) {
  const Scene scene = any_scene();
  const Scene back = parse_scene(to_json_line(scene)).value();
  RC_ASSERT(back.stamp_ns == scene.stamp_ns);
  RC_ASSERT(back.boundaries.size() == scene.boundaries.size());
  for (std::size_t b = 0; b < scene.boundaries.size(); ++b) {
    const Boundary& want = scene.boundaries[b];
    const Boundary& got = back.boundaries[b];
    RC_ASSERT(got.id == want.id);
    RC_ASSERT(got.side == want.side && got.model == want.model && got.kind == want.kind);
    RC_ASSERT(got.state == want.state);
    RC_ASSERT(got.height_m.size() == want.height_m.size());
    RC_ASSERT(std::fabs(got.confidence - want.confidence) <= 0.500001e-4);
    RC_ASSERT(got.points.size() == want.points.size());
    for (std::size_t i = 0; i < want.points.size(); ++i) {
      const double allowed = 0.500001e-4 + 1e-12 * std::fabs(want.points[i].z);
      RC_ASSERT(std::fabs(got.points[i].z - want.points[i].z) <= allowed);
    }
  }
}

/// Breaks a good line in one place: reading must end as a scene or as an error, never otherwise.
RC_GTEST_PROP(SceneJsonLaw, ABrokenLineIsReadOrRefused, ()) {
  std::string line = to_json_line(scene_with_everything());
  const std::size_t at = *rc::gen::inRange<std::size_t>(0, line.size());
  line[at] = *rc::gen::arbitrary<char>();
  const auto scene = parse_scene(line);
  if (!scene) RC_ASSERT(scene.error().where.starts_with("1:"));
}

}  // namespace
}  // namespace verge::emit
