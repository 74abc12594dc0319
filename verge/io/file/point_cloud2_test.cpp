// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/io/file/point_cloud2.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "verge/io/file/test_bags.hpp"
#include "verge/io/test_files.hpp"
#include "verge/scan/organise.hpp"

namespace verge::io {
namespace {

using testing::bytes_of;
using testing::cloud_message;
using testing::CloudParts;
using ::testing::DoubleNear;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::le;
using testing::simple_cloud;

constexpr std::int64_t kStamp = 1'700'000'000'500'000'000;

Expected<Decoded> decoded(const std::string& message, Wire wire = Wire::kCdr) {
  const auto cloud = read_point_cloud2(wire, bytes_of(message));
  if (!cloud) return Unexpected(cloud.error());
  return decode_point_cloud2(*cloud);
}

template <class T>
std::string in_order(T value, bool big_endian) {
  std::string bytes = le(value);
  if (big_endian) std::reverse(bytes.begin(), bytes.end());
  return bytes;
}

/// The number in one of the eight types.
std::string as_type(int value, std::uint8_t datatype, bool big_endian) {
  switch (datatype) {
    case 1:
      return in_order(static_cast<std::int8_t>(value), big_endian);
    case 2:
      return in_order(static_cast<std::uint8_t>(value), big_endian);
    case 3:
      return in_order(static_cast<std::int16_t>(value), big_endian);
    case 4:
      return in_order(static_cast<std::uint16_t>(value), big_endian);
    case 5:
      return in_order(static_cast<std::int32_t>(value), big_endian);
    case 6:
      return in_order(static_cast<std::uint32_t>(value), big_endian);
    case 7:
      return in_order(static_cast<float>(value), big_endian);
    default:
      return in_order(static_cast<double>(value), big_endian);
  }
}

Cloud some_cloud(std::size_t points) {
  Cloud cloud;
  for (std::size_t i = 0; i < points; ++i) {
    const double azimuth = 0.021 * static_cast<double>(i);
    cloud.x.push_back(static_cast<float>(10 * std::cos(azimuth)));
    cloud.y.push_back(static_cast<float>(10 * std::sin(azimuth)));
    cloud.z.push_back(static_cast<float>(static_cast<int>(i % 3) - 1));
    cloud.intensity.push_back(static_cast<float>(i));
    cloud.ring.push_back(static_cast<std::int64_t>(i % 3));
    cloud.time_s.push_back(1e-5 * static_cast<double>(i));
    cloud.label.push_back(static_cast<std::uint32_t>(i % 7));
  }
  return cloud;
}

/// A message read into a scan, as a recording's reader does it.
Scan scan_of(const std::string& message) {
  auto out = decoded(message);
  EXPECT_TRUE(out) << to_string(out.error());
  Scan scan = organise(std::move(out->cloud)).scan;
  scan.stamp_ns = out->stamp_ns;
  scan.frame_id = out->frame_id;
  return scan;
}

}  // namespace

TEST(PointCloud2, FieldsOfEveryTypeByNameInBothByteOrdersAndWires) {
  for (const Wire wire : {Wire::kRos1, Wire::kCdr}) {
    for (const bool big : {false, true}) {
      for (std::uint8_t ring_type = 1; ring_type <= 8; ++ring_type) {
        // A hole, z, ring, x as double, y as int16, intensity as uint8: at odd places, in no usual order.
        const std::size_t ring_bytes = as_type(0, ring_type, big).size();
        const auto after = static_cast<std::uint32_t>(3 + 4 + ring_bytes);
        CloudParts parts;
        parts.fields = {{"Z", 3, 7, 1},         {"ring", 7, ring_type, 1},       {"X", after, 8, 1},
                        {"y", after + 8, 3, 1}, {"intensity", after + 10, 2, 1}, {"normal", 0, 2, 3}};
        parts.point_step = after + 13;
        parts.width = 2;
        parts.row_step = 2 * parts.point_step;
        parts.big_endian = big;
        for (const int i : {1, 2}) {
          parts.data += "___" + as_type(10 * i, 7, big) + as_type(i, ring_type, big) +
                        as_type(-3 * i, 8, big) + as_type(-300 * i, 3, big) + as_type(200 + i, 2, big) + "pp";
        }
        const auto out = decoded(cloud_message(parts, wire, big && wire == Wire::kCdr), wire);
        ASSERT_TRUE(out) << to_string(out.error());
        EXPECT_THAT(out->cloud.x, ElementsAre(-3.0F, -6.0F));
        EXPECT_THAT(out->cloud.y, ElementsAre(-300.0F, -600.0F));
        EXPECT_THAT(out->cloud.z, ElementsAre(10.0F, 20.0F));
        EXPECT_THAT(out->cloud.intensity, ElementsAre(201.0F, 202.0F));
        EXPECT_THAT(out->cloud.ring, ElementsAre(1, 2));
        EXPECT_EQ(out->stamp_ns, kStamp);
        EXPECT_EQ(out->frame_id, "lidar");
      }
    }
  }
}

TEST(PointCloud2, RowsMayBePadded) {
  CloudParts parts = simple_cloud(6);
  parts.height = 2;
  parts.width = 3;
  parts.row_step = 14 * 3 + 5;
  parts.data.insert(42, "-pad-");
  const auto out = decoded(cloud_message(parts));  // the last row ends without its padding
  ASSERT_TRUE(out) << to_string(out.error());
  EXPECT_THAT(out->cloud.x, ElementsAre(1, 2, 3, 4, 5, 6));
  EXPECT_THAT(out->cloud.ring, ElementsAre(0, 1, 2, 3, 0, 1));
}

TEST(PointCloud2, RowsOrColumnsAreTheRingsOfAnOrganisedCloudWithoutThem) {
  CloudParts parts = simple_cloud(6);
  parts.fields.pop_back();
  parts.height = 2;
  parts.width = 3;
  parts.row_step = 14 * 3;
  const auto by_row = decoded(cloud_message(parts));
  ASSERT_TRUE(by_row);
  EXPECT_THAT(by_row->cloud.ring, ElementsAre(0, 0, 0, 1, 1, 1));
  EXPECT_THAT(by_row->notes, ElementsAre(HasSubstr("rows")));
  std::swap(parts.height, parts.width);
  parts.row_step = 14 * 2;
  const auto by_column = decoded(cloud_message(parts));
  ASSERT_TRUE(by_column);
  EXPECT_THAT(by_column->cloud.ring, ElementsAre(0, 1, 0, 1, 0, 1));
  parts.height = 1;
  parts.width = 6;
  parts.row_step = 14 * 6;
  EXPECT_THAT(decoded(cloud_message(parts))->cloud.ring, IsEmpty());
}

TEST(PointCloud2, TimesOfEveryUsualNameCountFromTheFirstPoint) {
  struct Case {
    std::string name;
    std::uint8_t datatype;
    std::string first, second;
    std::int64_t stamp_ns;
  };
  const std::vector<Case> cases{
      {"t", 6, le(5'000'000U), le(25'000'000U), kStamp + 5'000'000},
      {"offset_time", 6, le(0U), le(20'000'000U), kStamp},
      {"time", 7, le(-0.0625F), le(-0.0425F), kStamp - 62'500'000},
      {"timestamp", 8, le(1.7e9 + 0.25), le(1.7e9 + 0.27), 1'700'000'000'250'000'000},
      {"time_stamp", 6, le(1'000U), le(20'001'000U), kStamp + 1'000},
      {"timestamp", 8, le(1.7e18), le(1.7e18 + 20e6), 1'700'000'000'000'000'000}};
  for (const Case& c : cases) {
    CloudParts parts = simple_cloud(0);
    parts.fields.push_back({c.name, 14, c.datatype, 1});
    parts.point_step = 14 + static_cast<std::uint32_t>(c.first.size());
    parts.width = 2;
    parts.row_step = 2 * parts.point_step;
    parts.data = simple_cloud(1).data + c.first + simple_cloud(1).data + c.second;
    const auto out = decoded(cloud_message(parts));
    ASSERT_TRUE(out) << to_string(out.error());
    EXPECT_EQ(out->stamp_ns, c.stamp_ns) << c.name;
    EXPECT_THAT(out->cloud.time_s, ElementsAre(DoubleNear(0.0, 1e-12), DoubleNear(0.02, 1e-6))) << c.name;
  }
}

TEST(PointCloud2, AStampOfZeroIsNone) {
  const auto out = decoded(cloud_message(simple_cloud(3, 0)));
  ASSERT_TRUE(out);
  EXPECT_FALSE(out->stamp_ns);
}

TEST(PointCloud2, ACloudThatContradictsItselfSaysWhere) {
  struct Case {
    const char* name;
    void (*spoil)(CloudParts&);
    const char* where;
    const char* what;
  };
  // Offsets: header 4, stamp 8, "lidar" 4 + 6, gap 2: height at 24, width at 28; count at 32, first field
  // at 36.
  const std::vector<Case> cases{
      {"point_step 0", [](CloudParts& p) { p.point_step = 0; }, "36", "outside its point"},
      {"point_step 0 without fields",
       [](CloudParts& p) {
         p.point_step = 0;
         p.fields.clear();
       },
       "28", "rows"},
      {"field past step", [](CloudParts& p) { p.fields[0].offset = 11; }, "36", "outside its point"},
      {"offset 2^32 - 1", [](CloudParts& p) { p.fields[0].offset = 0xFFFFFFFF; }, "36", "outside its point"},
      {"count 2^31", [](CloudParts& p) { p.fields[0].count = 1U << 31U; }, "36", "outside its point"},
      {"type 0", [](CloudParts& p) { p.fields[0].datatype = 0; }, "36", "no known type"},
      {"type 9", [](CloudParts& p) { p.fields[0].datatype = 9; }, "36", "no known type"},
      {"rows too short", [](CloudParts& p) { p.row_step = 41; }, "28", "rows are shorter"},
      {"data too short", [](CloudParts& p) { p.data.pop_back(); }, "28", "larger than its data"},
      {"65536 x 65537 points",
       [](CloudParts& p) { p.height = 65537, p.width = 65536, p.row_step = 14 * 65536; }, "28",
       "larger than its data"},
      {"2^32 - 1 points a side", [](CloudParts& p) { p.height = p.width = p.row_step = 0xFFFFFFFF; }, "28",
       "rows are shorter"},
  };
  for (const Case& c : cases) {
    CloudParts parts = simple_cloud(3);
    c.spoil(parts);
    const auto cloud = read_point_cloud2(Wire::kCdr, bytes_of(cloud_message(parts)));
    ASSERT_FALSE(cloud) << c.name;
    EXPECT_EQ(cloud.error().code, ErrorCode::kDamaged) << c.name;
    EXPECT_EQ(cloud.error().where, c.where) << c.name << ": " << cloud.error().what;
    EXPECT_THAT(cloud.error().what, HasSubstr(c.what)) << c.name;
  }
}

TEST(PointCloud2, NoPointsAndNoCoordinatesAreErrors) {
  EXPECT_THAT(decoded(cloud_message(simple_cloud(0))).error().what, HasSubstr("0 points"));
  CloudParts parts = simple_cloud(2);
  parts.fields[2].name = "height";
  const auto out = decoded(cloud_message(parts));
  ASSERT_FALSE(out);
  EXPECT_EQ(out.error().got, "x y height ring");
}

TEST(PointCloud2, CutAtEveryByteItIsAnError) {
  for (const Wire wire : {Wire::kRos1, Wire::kCdr}) {
    const std::string message = cloud_message(simple_cloud(3), wire);
    for (std::size_t n = 0; n + 1 < message.size(); ++n) {  // the last byte, is_dense, is not read
      const std::string cut = message.substr(0, n);
      EXPECT_FALSE(read_point_cloud2(wire, bytes_of(cut))) << n;
    }
  }
}

TEST(PointCloud2, WhatIsWrittenIsTheTestsOwnEncodingByteForByte) {
  Cloud cloud;
  cloud.x = {1.0F, 2.0F};
  cloud.y = {0.5F, 0.25F};
  cloud.z = {-1.0F, 1.0F};
  cloud.ring = {0, 1};
  Scan scan = organise(cloud).scan;
  scan.stamp_ns = kStamp;
  scan.frame_id = "lidar";
  CloudParts parts = simple_cloud(0);
  parts.width = 2;
  parts.row_step = 28;
  parts.data = le(1.0F) + le(0.5F) + le(-1.0F) + le(std::uint16_t{0}) + le(2.0F) + le(0.25F) + le(1.0F) +
               le(std::uint16_t{1});
  EXPECT_EQ(write_point_cloud2(scan), cloud_message(parts));
}

RC_GTEST_PROP(PointCloud2, WritingReadingAndWritingGivesTheSameBytes, ()) {
  Cloud cloud = some_cloud(*rc::gen::inRange<std::size_t>(1, 200));
  if (*rc::gen::arbitrary<bool>()) cloud.intensity.clear();
  if (*rc::gen::arbitrary<bool>()) cloud.time_s.clear();
  if (*rc::gen::arbitrary<bool>()) cloud.label.clear();
  Scan scan = organise(cloud).scan;
  if (*rc::gen::arbitrary<bool>())
    scan.stamp_ns = *rc::gen::inRange<std::int64_t>(1, 2'000'000'000'000'000'000);
  scan.frame_id = *rc::gen::element<std::string>("lidar", "a", "velodyne_front");
  const std::string message = write_point_cloud2(scan);
  const Scan back = scan_of(message);
  RC_ASSERT(back.x == scan.x && back.y == scan.y && back.z == scan.z);
  RC_ASSERT(back.intensity == scan.intensity && back.ring_begin == scan.ring_begin);
  RC_ASSERT(back.time_offset_ns == scan.time_offset_ns && back.label == scan.label);
  RC_ASSERT(back.stamp_ns == scan.stamp_ns && back.frame_id == scan.frame_id);
  RC_ASSERT(write_point_cloud2(back) == message);
}

}  // namespace verge::io
