// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/eval/labelled_set.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "verge/eval/test_folder.hpp"

namespace verge::eval {
namespace {

using testing::floats;
using ::testing::HasSubstr;
using testing::TestFolder;

/// Across a kerb at x = 0.5 (nuScenes' own axes: x right, y forward), 10 m ahead.
std::string nuscenes_scan() {
  std::string bytes;
  for (int i = 0; i < 6; ++i) bytes += floats({0.2F * static_cast<float>(i), 10.0F, -1.8F, 9.0F, 4.0F});
  return bytes;
}

LabelledTruth truth_of(const LabelledScan& scan) { return read_labelled_truth(scan, 0.6).value(); }

TEST(FrameStem, FolderAndTheSuffixOfAScanGo) {
  EXPECT_EQ(frame_stem("a/000123.pcd.bin"), "000123");
  EXPECT_EQ(frame_stem("000123.bin"), "000123");
  EXPECT_EQ(frame_stem("drive.2024"), "drive.2024");
  EXPECT_EQ(frame_stem("plain"), "plain");
}

TEST(LabelledSet, NuscenesLabelsStandBesideTheScans) {
  const TestFolder folder;
  folder.write("LIDAR_TOP/a.pcd.bin", nuscenes_scan());
  folder.write("LIDAR_TOP/unlabelled.pcd.bin", nuscenes_scan());
  folder.write("lidarseg/a_lidarseg.bin", std::string("\x18\x18\x18\x1A\x1A\x1A"));  // road, sidewalk
  const auto scans = find_labelled_scans(folder.path());
  ASSERT_EQ(scans->size(), 1U);
  EXPECT_EQ(scans->front().frame, "a");
  const LabelledTruth truth = truth_of(scans->front());
  ASSERT_EQ(truth.points.size(), 1U);
  EXPECT_NEAR(truth.points[0].place.x, 10.0, 1e-6);
  EXPECT_NEAR(truth.points[0].place.y, -0.5, 1e-6);
  EXPECT_TRUE(truth.ground.has_value());
}

TEST(LabelledSet, SemanticKittiLabelsHaveTheClassInTheirLowBits) {
  const TestFolder folder;
  std::string scan;
  std::string labels;
  for (int i = 0; i < 12; ++i) {
    scan += floats({10.0F, 0.1F * static_cast<float>(i), -1.7F, 0.5F});
    labels += i < 6 ? std::string("\x28\0\x07\0", 4) : std::string("\x30\0\x01\0", 4);
  }
  folder.write("velodyne/000000.bin", scan);
  folder.write("labels/000000.label", labels);
  const auto scans = find_labelled_scans(folder.path());
  ASSERT_EQ(scans->size(), 1U);
  const LabelledTruth truth = truth_of(scans->front());
  ASSERT_EQ(truth.points.size(), 1U);
  EXPECT_NEAR(truth.points[0].place.y, 0.55, 1e-6);
}

TEST(LabelledSet, KerbLabelsAreTheTruePoints) {
  const TestFolder folder;
  folder.write("a.pcd",
               "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 4\nHEIGHT 1\nPOINTS 4\n"
               "DATA ascii\n1 2 0\n2 2 0\n3 2 0\n9 9 9\n");
  folder.write("a.label", std::string("\x01\x01\0\xFF", 4));
  const auto scans = find_labelled_scans(folder.path());
  ASSERT_EQ(scans->size(), 1U);
  const LabelledTruth truth = truth_of(scans->front());
  ASSERT_EQ(truth.points.size(), 2U);
  EXPECT_EQ(truth.points[1].place, (Vec2{2.0, 2.0}));
  EXPECT_EQ(truth.segments.size(), 2U);
  EXPECT_FALSE(truth.ground.has_value());
}

TEST(LabelledSet, AnEdgeThatTwoPolygonsShareIsAKerb) {
  const TestFolder folder;
  folder.write("street.gt", "0 0\n1000 0\n1000 5000\n0 5000\n\n1000 5000\n1000 0\n2000 0\n2000 5000\n");
  const auto scans = find_labelled_scans(folder.path());
  ASSERT_EQ(scans->size(), 1U);
  EXPECT_EQ(scans->front().frame, "street");
  const LabelledTruth truth = truth_of(scans->front());
  ASSERT_EQ(truth.segments.size(), 1U);
  EXPECT_EQ(truth.segments[0], (Segment{{1.0, 0.0}, {1.0, 5.0}}));
  EXPECT_EQ(truth.points.size(), 51U);  // every 0.1 m of 5 m
}

TEST(LabelledSet, ATableOfKerbPointsIsTheOnlyTruth) {
  const TestFolder folder;
  folder.write("street.gt", "0 0\n");
  folder.write("truth.csv",
               "frame,side,x,y,z\r\nb.bin,left,1.5, 2,0\r\na,right,3,-4,0\r\nb,left,2.5,2,0\r\n");
  const auto scans = find_labelled_scans(folder.path());
  ASSERT_EQ(scans->size(), 2U);
  EXPECT_EQ(scans->at(0).frame, "a");
  EXPECT_EQ(scans->at(1).kerb, (std::vector<Vec2>{{1.5, 2.0}, {2.5, 2.0}}));
  EXPECT_EQ(find_labelled_scans(folder.path() / "truth.csv")->size(), 2U);
}

TEST(LabelledSet, WhatCannotBeUsedSaysWhere) {
  const TestFolder folder;
  EXPECT_EQ(find_labelled_scans(folder.path() / "none").error().code, ErrorCode::kCannotOpen);
  EXPECT_EQ(find_labelled_scans(folder.path()).error().code, ErrorCode::kUnusable);
  const auto table = folder.write("truth.csv", "frame,side,x,y,z\na,left,1,2,0\na,left,x,2,0\n");
  const auto error = find_labelled_scans(folder.path()).error();
  EXPECT_EQ(error.code, ErrorCode::kUnusable);
  EXPECT_THAT(to_string(error), HasSubstr("truth.csv:3:1"));
  folder.write("truth.csv", "frame,side,x,y,z\na,left,1,2,0\n");
  folder.write("more/truth.csv", "frame,side,x,y,z\na,left,1,2,0\n");
  EXPECT_EQ(find_labelled_scans(folder.path()).error().code, ErrorCode::kUsage);
}

TEST(LabelledSet, LabelsThatAreNotAsManyAsThePointsAreAnError) {
  const TestFolder folder;
  folder.write("LIDAR_TOP/a.pcd.bin", nuscenes_scan());
  folder.write("lidarseg/a_lidarseg.bin", "\x18\x18");
  const auto scans = find_labelled_scans(folder.path());
  const auto truth = read_labelled_truth(scans->front(), 0.6);
  ASSERT_FALSE(truth.has_value());
  EXPECT_THAT(to_string(truth.error()), HasSubstr("got 2 B, need 6 B"));
}

}  // namespace
}  // namespace verge::eval
