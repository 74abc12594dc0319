// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/eval/ground_score.hpp"

#include <cmath>
#include <map>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "verge/eval/ground_labels.hpp"
#include "verge/eval/ground_plane.hpp"
#include "verge/eval/test_folder.hpp"

namespace verge::eval {
namespace {

using testing::floats;
using ::testing::HasSubstr;
using testing::TestFolder;

constexpr auto kGround = GroundClass::kGround;
constexpr auto kOther = GroundClass::kOther;
constexpr auto kVegetation = GroundClass::kVegetation;
constexpr auto kUnlabelled = GroundClass::kUnlabelled;
constexpr auto kPatchworkpp = GroundProtocol::kPatchworkpp;
constexpr auto kPatchwork = GroundProtocol::kPatchwork;

/// A point 5 m ahead at a height, its true class, and whether it is predicted as ground.
struct Point {
  float z;
  GroundClass type;
  bool predicted;
};

GroundTruth truth_of(const std::vector<Point>& points) {
  GroundTruth truth;
  for (const Point& p : points) {
    truth.cloud.x.push_back(5.0F);
    truth.cloud.y.push_back(0.0F);
    truth.cloud.z.push_back(p.z);
    truth.classes.push_back(p.type);
  }
  return truth;
}

GroundPrediction prediction_of(const std::vector<Point>& points) {
  GroundPrediction prediction;
  for (const Point& p : points) prediction.is_ground.push_back(p.predicted);
  return prediction;
}

GroundScore score_of(const std::vector<Point>& points, const GroundScoreConfig& config = {}) {
  const GroundPrediction prediction = prediction_of(points);
  return score_ground(truth_of(points), &prediction, config);
}

TEST(GroundScore, EachPointCountsAsItsProtocolSays) {
  const float kLow = -1.31F;
  const float kHigh = -1.29F;
  const GroundCounts found{1, 0, 0, 0};
  const GroundCounts wrong{0, 1, 0, 0};
  const GroundCounts missed{0, 0, 1, 0};
  const GroundCounts rest{0, 0, 0, 1};
  const GroundCounts none{};
  struct Case {
    Point point;
    GroundCounts patchworkpp;
    GroundCounts patchwork;
  };
  const std::vector<Case> cases = {
      {{kHigh, kGround, true}, found, found},       {{kHigh, kGround, false}, missed, missed},
      {{kLow, kOther, true}, wrong, wrong},         {{kLow, kOther, false}, rest, rest},
      {{kLow, kVegetation, true}, none, found},     {{kLow, kVegetation, false}, none, missed},
      {{kHigh, kVegetation, true}, none, wrong},    {{kHigh, kVegetation, false}, none, rest},
      {{kLow, kUnlabelled, true}, none, none},      {{kLow, kUnlabelled, false}, none, none},
      {{std::nanf(""), kGround, true}, none, none}, {{INFINITY, kOther, true}, none, none}};
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const GroundScore score = score_of({cases[i].point});
    EXPECT_EQ(score.by(kPatchworkpp).counts, cases[i].patchworkpp) << i;
    EXPECT_EQ(score.by(kPatchwork).counts, cases[i].patchwork) << i;
  }
}

TEST(GroundScore, FiguresAreThoseOfTheFourCounts) {
  const GroundCounts counts{6, 2, 4, 8};
  EXPECT_EQ(counts.points(), 20U);
  EXPECT_DOUBLE_EQ(*counts.precision(), 0.75);
  EXPECT_DOUBLE_EQ(*counts.recall(), 0.6);
  EXPECT_DOUBLE_EQ(*counts.f1(), 2.0 * 0.75 * 0.6 / 1.35);
  EXPECT_DOUBLE_EQ(*counts.iou(), 0.5);
  EXPECT_DOUBLE_EQ(*counts.accuracy(), 0.7);
}

TEST(GroundScore, OfNothingThereIsNoFigure) {
  const GroundCounts only_other{0, 0, 0, 3};
  EXPECT_FALSE(only_other.precision() || only_other.recall() || only_other.f1() || only_other.iou());
  EXPECT_EQ(only_other.accuracy(), 1.0);
  EXPECT_FALSE(GroundCounts{}.accuracy().has_value());
  const GroundScore empty = score_of({});
  EXPECT_EQ(empty.scans, 1U);
  EXPECT_FALSE(empty.by(kPatchwork).f1.value().has_value());
  EXPECT_FALSE(empty.heights.rmse_m().has_value() || empty.heights.mean_m().has_value());
}

TEST(GroundScore, AScanWithoutAPredictionHasItsGroundMissed) {
  const GroundScore score = score_ground(truth_of({{0, kGround, true}, {0, kOther, true}}), nullptr, {});
  EXPECT_EQ(score.absent, 1U);
  EXPECT_EQ(score.by(kPatchwork).counts, (GroundCounts{0, 0, 1, 1}));
  EXPECT_EQ(score.by(kPatchwork).recall.value(), 0.0);
  EXPECT_FALSE(score.by(kPatchwork).precision.value().has_value());
}

TEST(GroundScore, PointsFartherAwayThanTheRangeDoNotCount) {
  const std::vector<Point> points = {{-9.0F, kGround, true}};  // 5 m in the plane
  EXPECT_EQ(score_of(points, {.range_m = 5.01}).by(kPatchwork).counts.points(), 1U);
  EXPECT_EQ(score_of(points, {.range_m = 5.0}).by(kPatchwork).counts.points(), 0U);
}

TEST(GroundScore, ScansAddUpToAllPointsTogetherAndToTheMeanOfTheirOwn) {
  GroundScore sum = score_of({{0, kGround, true}, {0, kGround, true}, {0, kGround, true}, {0, kOther, true}});
  sum += score_of({{0, kGround, false}, {0, kGround, true}});
  sum += score_of({{0, kOther, false}});  // has no figure but accuracy
  const ProtocolScore& score = sum.by(kPatchworkpp);
  EXPECT_EQ(sum.scans, 3U);
  EXPECT_EQ(score.counts, (GroundCounts{4, 1, 1, 1}));
  EXPECT_DOUBLE_EQ(*score.precision.value(), (0.75 + 1.0) / 2.0);
  EXPECT_DOUBLE_EQ(*score.recall.value(), (1.0 + 0.5) / 2.0);
  EXPECT_DOUBLE_EQ(*score.f1.value(), (6.0 / 7.0 + 2.0 / 3.0) / 2.0);
}

TEST(GroundScore, HeightsAreComparedOverTrueGroundAlone) {
  const std::vector<Point> points = {{0, kGround, true}, {0, kGround, false}, {0, kOther, true}};
  GroundPrediction prediction = prediction_of(points);
  prediction.height_m = {-0.3, 0.4, 7.0};  // the first lies under the ground that is predicted
  const HeightErrors heights = score_ground(truth_of(points), &prediction, {}).heights;
  EXPECT_EQ(heights.points, 2U);
  EXPECT_DOUBLE_EQ(*heights.mean_m(), -0.05);
  EXPECT_DOUBLE_EQ(*heights.rmse_m(), std::sqrt((0.09 + 0.16) / 2.0));
}

TEST(GroundClasses, AreThoseOfTheDataSets) {
  const std::map<std::uint32_t, GroundClass> kitti = {
      {0, kUnlabelled}, {1, kUnlabelled}, {10, kOther},      {40, kGround}, {44, kGround}, {48, kGround},
      {49, kGround},    {60, kGround},    {70, kVegetation}, {72, kGround}, {252, kOther}};
  for (const auto& [label, type] : kitti)
    EXPECT_EQ(ground_class_of(LabelScheme::kSemanticKitti, label), type) << label;
  const std::map<std::uint32_t, GroundClass> nuscenes = {{0, kUnlabelled}, {1, kOther},   {17, kOther},
                                                         {24, kGround},    {25, kGround}, {26, kGround},
                                                         {27, kGround},    {28, kOther},  {30, kVegetation}};
  for (const auto& [label, type] : nuscenes)
    EXPECT_EQ(ground_class_of(LabelScheme::kNuscenes, label), type) << label;
}

/// Four points in SemanticKITTI's files: road, building, vegetation, terrain; the upper bits are instances.
struct KittiFiles {
  TestFolder folder;
  LabelledScan scan;

  KittiFiles() {
    std::string points;
    for (int i = 0; i < 4; ++i) points += floats({5.0F, static_cast<float>(i), -1.7F, 0.5F});
    folder.write("00/velodyne/a.bin", points);
    folder.write("00/labels/a.label", std::string("\x28\0\x07\0\x32\0\x01\0\x46\0\0\0\x48\0\0\0", 16));
    scan = find_labelled_scans(folder.path() / "00")->front();
  }
};

TEST(GroundLabels, ALabelFileOfAnyProgramIsAPrediction) {
  const KittiFiles files;
  const GroundTruth truth = *read_ground_truth(files.scan);
  EXPECT_EQ(truth.classes, (std::vector{kGround, kOther, kVegetation, kGround}));
  files.folder.write("other/sequences/00/predictions/a.label",
                     std::string("\x3C\0\0\0\0\0\0\0\x46\0\0\0\x32\0\0\0", 16));
  const auto found = find_label_files(files.folder.path() / "other");
  const auto prediction = read_ground_prediction(found->at("a.label"), files.scan, truth);
  EXPECT_EQ(prediction->is_ground, (std::vector{true, false, false, false}));
  EXPECT_TRUE(prediction->height_m.empty());
}

TEST(GroundLabels, WhatCannotBeUsedIsAnError) {
  const KittiFiles files;
  const std::filesystem::path folder = files.folder.path();
  EXPECT_EQ(find_label_files(folder / "none").error().code, ErrorCode::kCannotOpen);
  EXPECT_EQ(find_label_files(folder / "00" / "velodyne").error().code, ErrorCode::kUnusable);
  files.folder.write("more/a.label", "");
  EXPECT_EQ(find_label_files(folder).error().code, ErrorCode::kUsage);
  const GroundTruth truth = *read_ground_truth(files.scan);
  const auto cut = read_ground_prediction(folder / "more" / "a.label", files.scan, truth);
  EXPECT_THAT(to_string(cut.error()), HasSubstr("got 0 B, need 16 B"));
  const LabelledScan kerbs{"a", LabelFormat::kKerbLabels, files.scan.scan, files.scan.labels};
  EXPECT_THAT(to_string(read_ground_truth(kerbs).error()), HasSubstr("do not say what is ground"));
}

TEST(GroundPlane, PointsNearTheRoadsPlaneAreGround) {
  // A road as 20 rings see it from 1.7 m, with a wall all around at 12 m.
  Cloud cloud;
  for (int ring = 0; ring < 24; ++ring) {
    for (int i = 0; i < 720; ++i) {
      const double elevation = -0.4 + 0.02 * ring;
      const double distance = elevation < -0.14 ? 1.7 / -std::tan(elevation) : 12.0;
      const double azimuth = 0.00872 * (i - 360);
      cloud.x.push_back(static_cast<float>(distance * std::cos(azimuth)));
      cloud.y.push_back(static_cast<float>(distance * std::sin(azimuth)));
      cloud.z.push_back(static_cast<float>(distance * std::tan(elevation)));
      cloud.ring.push_back(ring);
    }
  }
  const auto ground = ground_by_plane(cloud);
  ASSERT_TRUE(ground.has_value());
  for (std::size_t i = 0; i < cloud.x.size(); ++i) {
    EXPECT_NEAR(ground->height_m[i], static_cast<double>(cloud.z[i]) + 1.7, 0.01);
    EXPECT_EQ(ground->is_ground[i], cloud.z[i] < -1.4F);
  }
  EXPECT_FALSE(ground_by_plane({}).has_value());
}

}  // namespace
}  // namespace verge::eval
