// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/emit/geojson.hpp"

#include <numbers>
#include <set>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "verge/emit/test_folder.hpp"

namespace verge::emit {
namespace {

using nlohmann::json;

constexpr GeoOrigin kMunich{48.0, 11.0, 90.0};  // heading east

Scene scene_with(std::vector<Vec3> points) {
  Scene scene;
  scene.frame = "000001";
  scene.stamp_ns = 1700000000123456789;
  scene.method = "gradient";
  Boundary& boundary = scene.boundaries.emplace_back();
  boundary.id = 4;
  boundary.side = Side::kLeft;
  boundary.kind = BoundaryKind::kCurb;
  boundary.confidence = 0.5;
  boundary.height_m.assign(points.size(), 0.12);
  boundary.points = std::move(points);
  return scene;
}

struct Shot {
  Scene scene;
  std::optional<Pose> T_world_sensor;
};

class GeoJsonTest : public TestFolder {
 protected:
  [[nodiscard]] json written(const std::vector<Shot>& shots,
                             const std::optional<GeoOrigin>& origin = {}) const {
    auto writer = GeoJsonWriter::open(folder_ / "out.geojson", origin);
    for (const Shot& shot : shots) EXPECT_TRUE(writer->write(shot.scene, shot.T_world_sensor));
    EXPECT_FALSE(exists(folder_ / "out.geojson"));
    EXPECT_TRUE(writer->finish());
    return json::parse(content(folder_ / "out.geojson"));
  }
};

/// What RFC 7946 asks of a FeatureCollection of ours.
void expect_rfc7946(const json& collection) {
  EXPECT_EQ(collection.at("type"), "FeatureCollection");
  for (const auto* forbidden : {"crs", "coordinates", "geometries", "geometry", "properties"}) {
    EXPECT_FALSE(collection.contains(forbidden)) << forbidden;
  }
  for (const json& feature : collection.at("features")) {
    EXPECT_EQ(feature.at("type"), "Feature");
    EXPECT_TRUE(feature.at("properties").is_object());
    const json& geometry = feature.at("geometry");
    if (geometry.is_null() || geometry.at("type") != "LineString") continue;
    EXPECT_GE(geometry.at("coordinates").size(), 2U);
    for (const json& position : geometry.at("coordinates")) EXPECT_EQ(position.size(), 2U);
  }
}

const json& line_of(const json& collection, std::size_t feature) {
  return collection.at("features").at(feature).at("geometry").at("coordinates");
}

TEST_F(GeoJsonTest, WithoutAnOriginTheCoordinatesAreMetresAndSaySo) {
  const json collection = written({{scene_with({{1.0, 2.00004, -1.7}, {3.5, -2.0, -1.7}}), {}}});
  expect_rfc7946(collection);
  EXPECT_EQ(collection.at("coordinate_frame"),
            "local metres, not longitude and latitude: x forward, y left of each scan's sensor");
  EXPECT_EQ(line_of(collection, 0), json::parse("[[1.0,2.0],[3.5,-2.0]]"));
}

TEST_F(GeoJsonTest, AFeatureCarriesThePropertiesOfTheJsonLine) {
  const json properties =
      written({{scene_with({{}, {1.0, 0.0, 0.0}}), {}}}).at("features").at(0).at("properties");
  EXPECT_EQ(properties, json::parse(R"({"frame":"000001","stamp_ns":1700000000123456789,
      "stamp_ns_text":"1700000000123456789","frame_id":"sensor","part":"boundary","id":4,"side":"left","model":"polyline",
      "kind":"curb","confidence":0.5,"height_m":[0.12,0.12],"method":"gradient"})"));
}

TEST_F(GeoJsonTest, AnUnknownTimeIsNull) {
  Scene scene = scene_with({});
  scene.stamp_ns.reset();
  const json properties = written({{scene, {}}}).at("features").at(0).at("properties");
  EXPECT_TRUE(properties.at("stamp_ns").is_null());
  EXPECT_TRUE(properties.at("stamp_ns_text").is_null());
}

TEST_F(GeoJsonTest, WithAnOriginThePositionsAreLongitudeThenLatitude) {
  const json collection = written({{scene_with({{0.0, 0.0, 0.0}, {100.0, 0.0, 0.0}}), {}}}, kMunich);
  expect_rfc7946(collection);
  EXPECT_EQ(collection.at("coordinate_frame"), "WGS 84: longitude, latitude in degrees");
  EXPECT_EQ(line_of(collection, 0).at(0), json::parse("[11.0,48.0]"));
  EXPECT_NEAR(line_of(collection, 0).at(1).at(0).get<double>(), 11.0 + 100.0 / 74625.3, 1e-7);
  EXPECT_NEAR(line_of(collection, 0).at(1).at(1).get<double>(), 48.0, 1e-6);
}

TEST_F(GeoJsonTest, PosesMoveLaterScansIntoTheFirstOnesFrame) {
  const Pose T_world_first{from_yaw_pitch_roll(std::numbers::pi / 2.0, 0.0, 0.0), {500.0, 600.0, 0.0}};
  const Pose T_first_second{{}, {10.0, 0.0, 0.0}};
  const Scene scene = scene_with({{1.0, 2.0, 0.0}, {2.0, 2.0, 0.0}});
  const json collection = written({{scene, T_world_first}, {scene, T_world_first * T_first_second}});
  EXPECT_EQ(line_of(collection, 0), json::parse("[[1.0,2.0],[2.0,2.0]]"));
  EXPECT_EQ(line_of(collection, 1), json::parse("[[11.0,2.0],[12.0,2.0]]"));
  EXPECT_EQ(collection.at("coordinate_frame"),
            "local metres, not longitude and latitude: x forward, y left of the first scan's sensor");
}

TEST_F(GeoJsonTest, WithPosesAndAnOriginTheFirstPoseStandsAtTheOrigin) {
  const Pose T_world_first{from_yaw_pitch_roll(1.0, 0.0, 0.0), {500.0, 600.0, 0.0}};
  const Scene scene = scene_with({{0.0, 0.0, 0.0}, {100.0, 0.0, 0.0}});
  const json collection =
      written({{scene, T_world_first}, {scene, T_world_first * Pose{{}, {100.0, 0.0, 0.0}}}}, kMunich);
  EXPECT_EQ(line_of(collection, 0).at(0), json::parse("[11.0,48.0]"));
  EXPECT_EQ(line_of(collection, 0).at(1), line_of(collection, 1).at(0));
}

TEST_F(GeoJsonTest, AScanWithoutAPoseAmongScansWithOneHasNoPlace) {
  const Scene scene = scene_with({{1.0, 2.0, 0.0}, {2.0, 2.0, 0.0}});
  const json collection = written({{scene, Pose{}}, {scene, {}}}, kMunich);
  expect_rfc7946(collection);
  EXPECT_TRUE(collection.at("features").at(1).at("geometry").is_null());
}

TEST_F(GeoJsonTest, ShortLinesAreAPointOrNothing) {
  const json collection = written({{scene_with({{1.0, 2.0, 0.0}}), {}}, {scene_with({}), {}}});
  EXPECT_EQ(collection.at("features").at(0).at("geometry"),
            json::parse(R"({"type":"Point","coordinates":[1.0,2.0]})"));
  EXPECT_TRUE(collection.at("features").at(1).at("geometry").is_null());
}

TEST_F(GeoJsonTest, ALineAcrossTheAntimeridianIsCutThere) {
  const GeoOrigin fiji{-17.0, 180.0, 90.0};
  const json geometry = written({{scene_with({{-10.0, 0.0, 0.0}, {30.0, 0.0, 0.0}}), {}}}, fiji)
                            .at("features")
                            .at(0)
                            .at("geometry");
  EXPECT_EQ(geometry.at("type"), "MultiLineString");
  const json& pieces = geometry.at("coordinates");
  ASSERT_EQ(pieces.size(), 2U);
  EXPECT_GT(pieces.at(0).at(0).at(0).get<double>(), 179.0);
  EXPECT_EQ(pieces.at(0).at(1).at(0), 180.0);
  EXPECT_EQ(pieces.at(1).at(0).at(0), -180.0);
  EXPECT_EQ(pieces.at(0).at(1).at(1), pieces.at(1).at(0).at(1));
  EXPECT_LT(pieces.at(1).at(1).at(0).get<double>(), -179.0);
}

/// A scene with one part of each kind but a boundary.
Scene scene_with_parts() {
  Scene scene;
  scene.frame = "000001";
  scene.openings.push_back({{Vec2{4.0, 4.0}, Vec2{9.0, 4.0}}, 5.0, 0.5});
  scene.corners.push_back({.side = CornerSide::kRight, .position = {8.0, -3.0}, .confidence = 0.5});
  scene.junctions.push_back({.type = JunctionType::kT, .center = {20.0, 1.0}, .branches_rad = {3.1, 1.5}});
  Object& object = scene.objects.emplace_back();
  object.center = {10.0, 2.0, -1.0};
  object.size = {4.0, 2.0, 1.5};
  object.yaw_rad = std::numbers::pi / 2.0;
  scene.road = RoadSurface{{}, {{0.0, -3.0}, {0.0, 3.0}, {20.0, 3.0}}};  // clockwise
  return scene;
}

TEST_F(GeoJsonTest, EveryPartHasItsGeometry) {
  const json collection = written({{scene_with_parts(), {}}});
  expect_rfc7946(collection);
  std::vector<std::string> parts;
  for (const json& feature : collection.at("features")) parts.push_back(feature.at("properties").at("part"));
  EXPECT_EQ(parts, (std::vector<std::string>{"opening", "corner", "junction", "object", "road"}));
  const auto geometry = [&](std::size_t i) { return collection.at("features").at(i).at("geometry"); };
  EXPECT_EQ(geometry(0), json::parse(R"({"type":"LineString","coordinates":[[4.0,4.0],[9.0,4.0]]})"));
  EXPECT_EQ(geometry(1), json::parse(R"({"type":"Point","coordinates":[8.0,-3.0]})"));
  EXPECT_EQ(geometry(2), json::parse(R"({"type":"Point","coordinates":[20.0,1.0]})"));
  EXPECT_EQ(geometry(3), json::parse(R"({"type":"Polygon","coordinates":
      [[[9.0,4.0],[9.0,0.0],[11.0,0.0],[11.0,4.0],[9.0,4.0]]]})"));
  EXPECT_EQ(geometry(4), json::parse(R"({"type":"Polygon","coordinates":
      [[[0.0,-3.0],[20.0,3.0],[0.0,3.0],[0.0,-3.0]]]})"));
}

TEST_F(GeoJsonTest, APolygonAcrossTheAntimeridianIsItsOutlineCutThere) {
  const GeoOrigin fiji{-17.0, 180.0, 90.0};
  Scene across;
  across.road = RoadSurface{{}, {{-10.0, -3.0}, {10.0, 0.0}, {-10.0, 3.0}}};
  const json geometry = written({{across, {}}}, fiji).at("features").at(0).at("geometry");
  EXPECT_EQ(geometry.at("type"), "MultiLineString");
  EXPECT_EQ(geometry.at("coordinates").size(), 3U);
}

TEST_F(GeoJsonTest, WithoutScenesTheCollectionIsEmptyAndValid) {
  const json collection = written({}, kMunich);
  expect_rfc7946(collection);
  EXPECT_TRUE(collection.at("features").empty());
}

TEST_F(GeoJsonTest, TheSameScenesGiveTheSameBytes) {
  const std::vector<Shot> shots{{scene_with({{1.0, 2.0, 0.0}, {2.0, 2.0, 0.0}}), {}}};
  static_cast<void>(written(shots, kMunich));
  const std::string first = content(folder_ / "out.geojson");
  std::filesystem::remove(folder_ / "out.geojson");
  static_cast<void>(written(shots, kMunich));
  EXPECT_EQ(content(folder_ / "out.geojson"), first);
}

TEST_F(GeoJsonTest, WithoutFinishNothingIsLeft) {
  {
    auto writer = GeoJsonWriter::open(folder_ / "out.geojson");
    ASSERT_TRUE(writer->write(scene_with({{1.0, 2.0, 0.0}, {2.0, 2.0, 0.0}})));
  }
  EXPECT_EQ(entries(), 0U);
}

TEST_F(GeoJsonTest, AFullDeviceCannotBeWritten) {
  auto writer = GeoJsonWriter::open("/dev/full");
  ASSERT_TRUE(writer.has_value());
  EXPECT_EQ(writer->write(scene_with({})).error().code, ErrorCode::kCannotWrite);
}

TEST_F(GeoJsonTest, AnOriginOffTheEarthIsRefused) {
  EXPECT_THROW(static_cast<void>(GeoJsonWriter::open(folder_ / "out", GeoOrigin{90.5, 0.0, 0.0})),
               std::invalid_argument);
}

}  // namespace
}  // namespace verge::emit
