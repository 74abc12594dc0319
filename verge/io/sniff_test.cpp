// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/io/sniff.hpp"

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "verge/io/test_files.hpp"

namespace verge::io {
namespace {

using testing::bytes_of;
using testing::floats;
using ::testing::HasSubstr;
using testing::kitti_rings;

Expected<Format> sniffed(const std::string& bytes, const std::string& name,
                         std::optional<Format> bin = std::nullopt) {
  Input input = Input::of(bytes_of(bytes), name);
  return sniff(input, bin);
}

/// nuScenes rows with rings 0..3.
std::string nuscenes(std::size_t points) {
  std::vector<float> values;
  for (std::size_t i = 0; i < points; ++i) {
    values.insert(values.end(),
                  {-1.5F - 0.25F * static_cast<float>(i), 3.7F, -1.2F, 12.0F, static_cast<float>(i % 4)});
  }
  return floats(values);
}

}  // namespace

TEST(Sniff, ContentGoesBeforeTheName) {
  const std::string ply = "ply\nformat ascii 1.0\n";
  const std::string pcd = "# .PCD v0.7\nVERSION 0.7\n";
  for (const char* name : {"a", "a.bin", "a.pcd", "a.ply", "a.csv", "a.pcd.bin"}) {
    EXPECT_EQ(sniffed(ply, name).value(), Format::kPly) << name;
    EXPECT_EQ(sniffed(pcd, name).value(), Format::kPcd) << name;
    EXPECT_EQ(sniffed("VERSION .7\nFIELDS x y z\n", name).value(), Format::kPcd) << name;
    EXPECT_EQ(sniffed("# made by hand\nFIELDS x y z\n", name).value(), Format::kPcd) << name;
    EXPECT_EQ(sniffed("number,level,distance,x,y,z\n", name).value(), Format::kCsv) << name;
    EXPECT_EQ(sniffed("1;2;3.5;1;2;3\n", name).value(), Format::kCsv) << name;
    EXPECT_EQ(sniffed(kitti_rings(4, 60), name).value(), Format::kKitti) << name;
    EXPECT_EQ(sniffed(nuscenes(60), name).value(), Format::kNuscenes) << name;
  }
}

TEST(Sniff, ANameThatLiesIsSeen) {
  EXPECT_TRUE(name_lies("a.pcd", Format::kPly));
  EXPECT_TRUE(name_lies("a.bin", Format::kPcd));
  EXPECT_TRUE(name_lies("a.csv", Format::kKitti));
  EXPECT_FALSE(name_lies("a.pcd.bin", Format::kKitti));
  EXPECT_FALSE(name_lies("a.pcd", Format::kPcd));
  EXPECT_FALSE(name_lies("stdin", Format::kPcd));
}

TEST(Sniff, WhereContentSaysNothingTheSizeDoes) {
  EXPECT_EQ(sniffed(std::string(32, '\0'), "a.bin").value(), Format::kKitti);
  EXPECT_EQ(sniffed(std::string(40, '\0'), "a.bin").value(), Format::kNuscenes);
}

TEST(Sniff, ThenTheNameThenTheNeighbours) {
  const std::string both(160, '\0');
  EXPECT_EQ(sniffed(both, "a.pcd.bin").value(), Format::kNuscenes);
  EXPECT_EQ(sniffed(both, "LIDAR_TOP/a.bin").value(), Format::kNuscenes);
  EXPECT_EQ(sniffed(both, "sequences/00/velodyne/000000.bin").value(), Format::kKitti);
  EXPECT_EQ(sniffed(both, "drive/velodyne_points/data/000000.bin").value(), Format::kKitti);
  EXPECT_EQ(sniffed(both, "a.bin", Format::kNuscenes).value(), Format::kNuscenes);
}

TEST(Sniff, OnlyWhereNothingDecidesTheUserHasTo) {
  const auto both = sniffed(std::string(160, '\0'), "a.bin");
  ASSERT_FALSE(both);
  EXPECT_EQ(both.error().code, ErrorCode::kUsage);
  EXPECT_THAT(both.error().what, HasSubstr("kitti and nuscenes"));
}

TEST(Sniff, ACutFileIsJudgedByWhatItWas) {
  // 60 nuScenes points less 4 bytes are no multiple of 20; less 16 bytes might be taken for KITTI.
  const std::string bytes = nuscenes(64);
  EXPECT_EQ(sniffed(bytes.substr(0, bytes.size() - 4), "a.bin").value(), Format::kNuscenes);
  EXPECT_EQ(sniffed(bytes.substr(0, 1264), "a.bin").value(), Format::kNuscenes);
}

TEST(Sniff, PackedFilesAreNamed) {
  EXPECT_THAT(sniffed("\x1F\x8B\x08 and more", "a.pcd").error().what, HasSubstr("gzip"));
  EXPECT_THAT(sniffed("\x28\xB5\x2F\xFD and more", "a.bin").error().what, HasSubstr("zstd"));
  EXPECT_THAT(sniffed("BZh91AY&SY", "a").error().what, HasSubstr("bzip2"));
}

TEST(Sniff, WhatFitsNothingSaysWhatWasTried) {
  const auto format = sniffed("Dear reader, this is a letter.\n", "letter");
  ASSERT_FALSE(format);
  EXPECT_EQ(format.error().code, ErrorCode::kUnusable);
  EXPECT_THAT(to_string(format.error()), HasSubstr("kitti, nuscenes, pcd, ply, csv, las"));
}

}  // namespace verge::io
