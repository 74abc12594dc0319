// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0

// The two formats of bare floats: KITTI and nuScenes.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "verge/io/file/floats.hpp"
#include "verge/io/file/kitti.hpp"
#include "verge/io/file/nuscenes.hpp"
#include "verge/io/source.hpp"
#include "verge/io/test_files.hpp"
#include "verge/scan/organise.hpp"

namespace verge::io {
namespace {

using testing::bytes_of;
using ::testing::ElementsAre;
using testing::floats;
using ::testing::HasSubstr;
using testing::TemporaryFolder;

Expected<Decoded> kitti(const std::string& bytes) {
  Input input = Input::of(bytes_of(bytes), "a.bin");
  return read_kitti(input);
}

Expected<Decoded> nuscenes(const std::string& bytes) {
  Input input = Input::of(bytes_of(bytes), "a.pcd.bin");
  return read_nuscenes(input);
}

std::string swapped(std::string bytes) {
  for (std::size_t i = 0; i + 4 <= bytes.size(); i += 4)
    std::reverse(bytes.begin() + static_cast<std::ptrdiff_t>(i),
                 bytes.begin() + static_cast<std::ptrdiff_t>(i + 4));
  return bytes;
}

/// A scan as organise() makes it of random points with rings.
Scan some_scan() {
  Cloud cloud;
  const auto points = *rc::gen::inRange<std::size_t>(1, 60);
  const auto metre =
      rc::gen::map(rc::gen::inRange(-50'000, 50'000), [](int mm) { return static_cast<float>(mm) * 1e-3F; });
  for (std::size_t i = 0; i < points; ++i) {
    cloud.x.push_back(*metre);
    cloud.y.push_back(*metre);
    cloud.z.push_back(*metre);
    cloud.intensity.push_back(static_cast<float>(*rc::gen::inRange(0, 256)));
    cloud.ring.push_back(*rc::gen::inRange(0, 8));
  }
  return organise(std::move(cloud)).scan;
}

}  // namespace

TEST(Kitti, PointsAreXForwardYLeftZUpAndRemission) {
  const auto decoded = kitti(floats({1.5F, -2.5F, -1.75F, 0.25F, 10.0F, 20.0F, 0.5F, 0.99F}));
  ASSERT_TRUE(decoded) << to_string(decoded.error());
  EXPECT_THAT(decoded->cloud.x, ElementsAre(1.5F, 10.0F));
  EXPECT_THAT(decoded->cloud.y, ElementsAre(-2.5F, 20.0F));
  EXPECT_THAT(decoded->cloud.z, ElementsAre(-1.75F, 0.5F));
  EXPECT_THAT(decoded->cloud.intensity, ElementsAre(0.25F, 0.99F));
  EXPECT_TRUE(decoded->cloud.ring.empty());
}

TEST(Kitti, BigEndianFloatsAreNamed) {
  const auto decoded = kitti(swapped(floats({1.5F, -2.5F, -1.75F, 0.25F, 10.0F, 20.0F, 0.5F, 0.99F})));
  ASSERT_FALSE(decoded);
  EXPECT_EQ(decoded.error().code, ErrorCode::kUnusable);
  EXPECT_THAT(decoded.error().what, HasSubstr("big-endian"));
}

TEST(Nuscenes, XRightYForwardBecomesXForwardYLeft) {
  // 3 m to the right, 20 m ahead.
  const auto decoded = nuscenes(floats({3.0F, 20.0F, -1.75F, 17.0F, 31.0F}));
  ASSERT_TRUE(decoded) << to_string(decoded.error());
  EXPECT_THAT(decoded->cloud.x, ElementsAre(20.0F));
  EXPECT_THAT(decoded->cloud.y, ElementsAre(-3.0F));
  EXPECT_THAT(decoded->cloud.z, ElementsAre(-1.75F));
  EXPECT_THAT(decoded->cloud.intensity, ElementsAre(17.0F));
  EXPECT_THAT(decoded->cloud.ring, ElementsAre(31));
}

TEST(Nuscenes, WithoutRingsItIsSomethingElse) {
  std::vector<float> values;
  for (int i = 0; i < 10; ++i) values.insert(values.end(), {3.0F, 20.0F, -1.75F, 17.0F, i < 6 ? 0.5F : 1.0F});
  const auto decoded = nuscenes(floats(values));
  ASSERT_FALSE(decoded);
  EXPECT_EQ(decoded.error().code, ErrorCode::kUnusable);
  EXPECT_THAT(decoded.error().what, HasSubstr("no ring"));
}

RC_GTEST_PROP(Nuscenes, WhatIsWrittenComesBackBitForBit, ()) {
  const TemporaryFolder folder;
  const Scan scan = some_scan();
  const auto path = folder.path() / "a.pcd.bin";
  RC_ASSERT(write_nuscenes(path, scan).has_value());
  const auto source = open(path, {.format = Format::kNuscenes});
  RC_ASSERT(source.has_value());
  const auto back = (*source)->next();
  RC_ASSERT(back.has_value() && back->has_value());
  RC_ASSERT((*back)->x == scan.x);
  RC_ASSERT((*back)->y == scan.y);
  RC_ASSERT((*back)->z == scan.z);
  RC_ASSERT((*back)->intensity == scan.intensity);
  RC_ASSERT((*back)->ring_begin == scan.ring_begin);
}

TEST(Nuscenes, AFolderThatIsNotThereCannotBeWritten) {
  const auto written = write_nuscenes("/nowhere/at/all.pcd.bin", {});
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().code, ErrorCode::kCannotWrite);
}

TEST(CheckRows, CountsWhatLooksLikePoints) {
  const std::string bytes = floats({1.0F, 2.0F, 3.0F, 300.0F, 5.0F, 1.0F, NAN, 3.0F, 0.5F, 5.5F});
  const RowCheck check = check_rows(bytes_of(bytes), 5);
  EXPECT_EQ(check.rows, 2U);
  EXPECT_EQ(check.coordinates, 1U);
  EXPECT_EQ(check.intensities, 1U);
  EXPECT_EQ(check.rings, 1U);
}

}  // namespace verge::io
