// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/eval/box_labels.hpp"

#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "verge/eval/labelled_set.hpp"
#include "verge/eval/test_folder.hpp"

namespace verge::eval {
namespace {

using ::testing::HasSubstr;
using testing::TestFolder;

constexpr double kQuarter_rad = 0.5 * std::numbers::pi;

TEST(BoxLabels, AreTurnedAsTheScanIs) {
  const TestFolder folder;
  // 2 m to the right, 10 m ahead; the first points ahead, the second to the right.
  const auto path = folder.write("a_boxes.json", R"({"frame": "a", "boxes": [
    {"class": "car", "box_xyz_lwh_yaw_lidar": [2, 10, -1, 4.5, 1.8, 1.5, 1.5707963267948966], "more": "\"NaN",
     "velocity": [NaN, -Infinity]},
    {"class": "unheard of", "box_xyz_lwh_yaw_lidar": [2, 10, -1, 4.5, 1.8, 1.5, 0.0]}]})");
  const auto boxes = read_nuscenes_boxes(path);
  ASSERT_TRUE(boxes.has_value());
  ASSERT_EQ(boxes->size(), 2U);
  const Object& car = boxes->front();
  EXPECT_EQ(car.type, ObjectClass::kCar);
  EXPECT_EQ(car.center, (Vec3{10.0, -2.0, -1.0}));
  EXPECT_EQ(car.size, (BoxSize{4.5, 1.8, 1.5}));
  EXPECT_NEAR(car.yaw_rad, 0.0, 1e-15);
  EXPECT_EQ(car.confidence, 1.0);
  EXPECT_EQ(boxes->back().type, ObjectClass::kUnknown);
  EXPECT_EQ(boxes->back().id, 1);
  EXPECT_NEAR(boxes->back().yaw_rad, -kQuarter_rad, 1e-15);
}

TEST(BoxLabels, WhatIsWrongIsToldWithItsPlace) {
  struct Case {
    const char* text;
    const char* told;
  };
  const TestFolder folder;
  for (const auto& [text, told] : std::to_array<Case>({
           {"", ":1:1: not JSON"},
           {"{\"boxes\":\n [1e999]}", ":2:7: not JSON: number overflow"},
           {"[]", ":1:1: a value of the wrong type (got array, need an object)"},
           {"{}", ":1:1: an object without what it needs (need boxes)"},
           {"{\"boxes\": 7}", ":1:11: a value of the wrong type (got number, need an array)"},
           {"{\"boxes\": [7]}", ":1:12: a value of the wrong type (got number, need an object)"},
           {"{\"boxes\":\n[{\"class\": \"car\"}]}", ":2:2: an object without what it needs (need box_xyz"},
           {"{\"boxes\": [{\"class\": 1, \"box_xyz_lwh_yaw_lidar\": [1,2,3,4,5,6,7]}]}",
            ":1:22: a value of the wrong type (got number, need a string)"},
           {"{\"boxes\": [{\"class\": \"car\",\n\n \"box_xyz_lwh_yaw_lidar\": [1,2,3,4,5,6]}]}",
            ":3:27: a box that is not seven numbers (got array of 6, need x, y"},
           {"{\"boxes\": [{\"class\": \"car\", \"box_xyz_lwh_yaw_lidar\": [1,Infinity,3,4,5,6,7]}]}",
            ":1:54: a box that is not seven numbers (got array of 7, need x, y"},
           {"{\"boxes\": [{\"class\": \"car\", \"box_xyz_lwh_yaw_lidar\": [1,2,3,4,0,6,7]}]}",
            ":1:54: a size out of range (got 4 x 0 x 6, need above 0, up to 1000 m)"},
           {"{\"boxes\": [{\"class\": \"car\", \"box_xyz_lwh_yaw_lidar\": [1,2,3,4,1e200,6,7]}]}",
            ":1:54: a size out of range (got 4 x 1e+200 x 6"},
       })) {
    const auto path = folder.write("bad_boxes.json", text);
    const auto boxes = read_nuscenes_boxes(path);
    ASSERT_FALSE(boxes.has_value()) << text;
    EXPECT_EQ(boxes.error().code, ErrorCode::kUnusable) << text;
    EXPECT_THAT(to_string(boxes.error()), HasSubstr("bad_boxes.json" + std::string(told)));
  }
  EXPECT_EQ(read_nuscenes_boxes(folder.path() / "none.json").error().code, ErrorCode::kCannotOpen);
}

TEST(BoxLabels, StandBesideTheirScans) {
  const TestFolder folder;
  folder.write("raw/a.pcd.bin", "");
  folder.write("raw/b.pcd.bin", "");
  EXPECT_THAT(to_string(find_boxed_scans(folder.path()).error()), HasSubstr("has no scans with boxes"));
  folder.write("raw/b_boxes.json", R"({"boxes": [{"class": "pedestrian",
                                       "box_xyz_lwh_yaw_lidar": [0, 5, 0, 0.6, 0.6, 1.7, 0]}]})");
  const auto scans = find_boxed_scans(folder.path());
  ASSERT_TRUE(scans.has_value());
  ASSERT_EQ(scans->size(), 1U);
  EXPECT_EQ(scans->front().frame, "b");
  const auto truth = read_labelled_truth(scans->front(), 0.6);
  ASSERT_TRUE(truth.has_value());
  ASSERT_EQ(truth->objects.size(), 1U);
  EXPECT_EQ(truth->objects[0].type, ObjectClass::kPerson);
  EXPECT_TRUE(truth->points.empty());
  EXPECT_EQ(find_boxed_scans(folder.path() / "none").error().code, ErrorCode::kCannotOpen);
  EXPECT_EQ(find_labelled_scans(folder.path()).error().code, ErrorCode::kUnusable)
      << "boxes say nothing of boundaries";
}

}  // namespace
}  // namespace verge::eval
