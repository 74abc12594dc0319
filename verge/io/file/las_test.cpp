// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/io/file/las.hpp"

#include <cmath>
#include <cstring>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "verge/io/file/gps_time.hpp"
#include "verge/io/file/las_header.hpp"
#include "verge/io/file/test_las.hpp"
#include "verge/io/test_files.hpp"
#include "verge/scan/organise.hpp"

namespace verge::io {
namespace {

using testing::bytes_of;
using ::testing::DoubleNear;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::LasFile;
using testing::TemporaryFolder;
using testing::vlr;

Expected<Decoded> las(const std::string& bytes) {
  Input input = Input::of(bytes_of(bytes), "a.las");
  return read_las(input);
}
Expected<Decoded> las(const LasFile& file) { return las(file.bytes()); }

void expect_refused(const LasFile& file, const std::string& where, const std::string& what) {
  const auto decoded = las(file);
  ASSERT_FALSE(decoded) << what;
  EXPECT_EQ(decoded.error().where, where) << to_string(decoded.error());
  EXPECT_THAT(to_string(decoded.error()), HasSubstr(what));
}

/// Scan of a cloud that has everything.
Scan full_scan() {
  Cloud cloud;
  for (int ring = 0; ring < 3; ++ring) {
    for (int i = 0; i < 20; ++i) {
      const double azimuth = 0.3 * i - 3.0;
      cloud.x.push_back(static_cast<float>((10 + ring) * std::cos(azimuth)));
      cloud.y.push_back(static_cast<float>((10 + ring) * std::sin(azimuth)));
      cloud.z.push_back(static_cast<float>(ring) - 1.7F);
      cloud.intensity.push_back(static_cast<float>(i * 5));
      cloud.ring.push_back(ring);
      cloud.time_s.push_back(1.7e9 + 0.001 * i);
      cloud.echo.push_back(static_cast<std::uint8_t>(i % 3));
      cloud.label.push_back(static_cast<std::uint32_t>(i));
    }
  }
  return organise(std::move(cloud)).scan;
}

}  // namespace

TEST(Las, EveryVersionAndPointFormatIsRead) {
  for (const int minor : {0, 1, 2, 3, 4}) {
    for (std::uint8_t format = 0; format <= 10; ++format) {
      const auto decoded = las(LasFile(minor, format, 3).put(107, std::uint32_t{3}));
      ASSERT_TRUE(decoded) << to_string(decoded.error());
      EXPECT_THAT(decoded->cloud.x, ElementsAre(0.0F, 1.0F, 2.0F)) << minor << " " << int{format};
      EXPECT_THAT(decoded->cloud.y, Each(-2.0F));
      EXPECT_THAT(decoded->cloud.z, Each(0.5F));
      EXPECT_EQ(decoded->cloud.time_s.size(), has_gps_time(format) ? 3U : 0U) << int{format};
      EXPECT_THAT(decoded->cloud.ring, IsEmpty());
      EXPECT_EQ(decoded->T_world_sensor, std::nullopt);
    }
  }
}

TEST(Las, FieldsOfOldRecordsStandAsInTheTable) {
  const auto decoded = las(LasFile(2, 3, 2)
                               .point(0, 12, std::uint16_t{40000})
                               .point(0, 14, std::uint8_t{0b00'011'010})  // second of three returns
                               .point(0, 15, std::uint8_t{0b0010'0010})   // class 2, synthetic
                               .point(0, 20, 7.5)
                               .point(1, 20, 7.25));
  ASSERT_TRUE(decoded);
  EXPECT_THAT(decoded->cloud.intensity, ElementsAre(40000.0F, 0.0F));
  EXPECT_THAT(decoded->cloud.echo, ElementsAre(1, 0));
  EXPECT_THAT(decoded->cloud.label, ElementsAre(2U, 0U));
  EXPECT_THAT(decoded->cloud.time_s, ElementsAre(0.25, 0.0));
  EXPECT_EQ(decoded->stamp_ns, std::nullopt);  // seconds of an unknown week
}

TEST(Las, FieldsOfNewRecordsStandAsInTheTable) {
  const auto decoded = las(LasFile(4, 6, 2)
                               .put(6, std::uint16_t{1})
                               .point(0, 14, std::uint8_t{0xFE})  // return 14 of 15
                               .point(0, 16, std::uint8_t{200})
                               .point(0, 22, 400'000'000.5)
                               .point(1, 22, 400'000'000.0));
  ASSERT_TRUE(decoded);
  EXPECT_THAT(decoded->cloud.echo, ElementsAre(13, 0));
  EXPECT_THAT(decoded->cloud.label, ElementsAre(200U, 0U));
  EXPECT_THAT(decoded->cloud.time_s, ElementsAre(0.5, 0.0));
  // GPS 1400000000 = 2024-05-18 16:53:20, 18 leap seconds ahead of UTC.
  EXPECT_EQ(decoded->stamp_ns, 1'715'964'782'000'000'000);
}

TEST(Las, WithheldPointsAreLeftOutAndCounted) {
  const auto old = las(LasFile(2, 0, 3).point(1, 15, std::uint8_t{0x80}));
  ASSERT_TRUE(old);
  EXPECT_THAT(old->cloud.x, ElementsAre(0.0F, 2.0F));
  EXPECT_THAT(old->notes, ElementsAre("1 points marked as withheld are left out"));
  const auto recent = las(LasFile(4, 7, 3).point(2, 15, std::uint8_t{0x04}));
  ASSERT_TRUE(recent);
  EXPECT_THAT(recent->cloud.x, ElementsAre(0.0F, 1.0F));
}

// LAS 1.0 and 1.1 have reserved bytes where 1.2 says what its times are, and 1.0 a class of 8 bits.
TEST(Las, WhatOldVersionsDoNotHaveIsNotReadFromTheirBytes) {
  const auto first = las(LasFile(0, 1, 2).put(6, std::uint16_t{0xFFFF}).point(0, 15, std::uint8_t{0xE2}));
  ASSERT_TRUE(first);
  EXPECT_THAT(first->cloud.label, ElementsAre(0xE2U, 0U));
  EXPECT_EQ(first->stamp_ns, std::nullopt);
  const auto second = las(LasFile(1, 1, 2).put(6, std::uint16_t{0xFFFF}).point(0, 15, std::uint8_t{0xE2}));
  ASSERT_TRUE(second);
  EXPECT_THAT(second->cloud.label, ElementsAre(0U));  // 0x80: withheld
  EXPECT_EQ(second->stamp_ns, std::nullopt);
}

TEST(Las, ColoursThatAreNotReadAreTold) {
  for (std::uint8_t format = 0; format <= 10; ++format) {
    const auto decoded = las(LasFile(4, format, 3));
    ASSERT_TRUE(decoded);
    const bool told = !decoded->notes.empty();
    // The formats whose tables have red, green and blue.
    const bool coloured =
        std::string("2 3 5 7 8 10 ").find(std::to_string(format) + " ") != std::string::npos && format != 0;
    EXPECT_EQ(told, coloured) << int{format};
  }
}

TEST(Las, WorldCoordinatesGetAnOrigin) {
  const auto decoded = las(LasFile(2, 0, 2).put(155, 691'000.25).put(163, 5'336'000.0).put(171, 500.0));
  ASSERT_TRUE(decoded);
  EXPECT_THAT(decoded->cloud.x, ElementsAre(0.25F, 1.25F));
  EXPECT_THAT(decoded->cloud.y, Each(0.0F));
  EXPECT_THAT(decoded->cloud.z, Each(-0.5F));  // 500.5 rounds to 501
  ASSERT_TRUE(decoded->T_world_sensor);
  EXPECT_EQ(decoded->T_world_sensor->translation, (Vec3{691'000, 5'335'998, 501}));
  EXPECT_THAT(decoded->notes, ElementsAre("origin (691000, 5335998, 501) m is taken off the coordinates"));
}

// A1 to A3, A10, A11.
TEST(Las, HeadersThatCannotBeAreRefused) {
  const LasFile good(4, 6, 3);
  expect_refused(LasFile(good).text(0, "LASX"), "0", "is no LAS file (need 'LASF' at its begin)");
  expect_refused(LasFile(good).put(25, std::uint8_t{5}), "24", "got 1.5, need 1.0 to 1.4");
  expect_refused(LasFile(good).put(24, std::uint16_t{2}), "24", "got 2.0, need 1.0 to 1.4");
  for (const std::uint16_t size : std::initializer_list<std::uint16_t>{0, 1, 227, 374, 65535}) {
    expect_refused(LasFile(good).put(94, size), "94", "size of the header is wrong");
  }
  expect_refused(LasFile(good).put(104, std::uint8_t{0x80 + 6}), "104", "compressed LAS is not supported");
  expect_refused(LasFile(good).put(104, std::uint8_t{11}), "104",
                 "point format is unknown (got 11, need 0 to 10)");
  for (const double scale :
       {0.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    expect_refused(LasFile(good).put(139, scale), "139", "scale of a coordinate cannot be");
  }
  expect_refused(LasFile(good).put(171, std::numeric_limits<double>::infinity()), "171",
                 "offset of a coordinate");
}

// A4 to A6, A12.
TEST(Las, PointsThatAreNotInTheFileAreRefused) {
  const LasFile good(4, 6, 3);
  for (const std::uint32_t offset : {0U, 374U, 466U, 0xFFFFFFFFU}) {
    expect_refused(LasFile(good).put(96, offset), "96", "points do not lie in the file");
  }
  for (const std::uint64_t count : {4ULL, 1ULL << 32U, 1ULL << 62U, ~0ULL}) {
    expect_refused(LasFile(good).put(247, count), "247", "asks for more data than the file holds");
  }
  expect_refused(LasFile(2, 1, 3).put(107, 0xFFFFFFFFU), "107", "asks for more data than the file holds");
  for (const std::uint16_t length : std::initializer_list<std::uint16_t>{0, 1, 29}) {
    expect_refused(LasFile(good).put(105, length), "105", "point record is shorter than its format");
  }
  const auto empty = las(LasFile(2, 0, 0));
  ASSERT_FALSE(empty);
  EXPECT_EQ(empty.error().code, ErrorCode::kDamaged);
  EXPECT_EQ(to_string(empty.error()), "a.las:107: has 0 points");
  EXPECT_TRUE(las(good));                                                   // no number for old readers
  EXPECT_TRUE(las(LasFile(good).put(247, std::uint64_t{0}).put(107, 3U)));  // and none for new ones
}

TEST(Las, TwoNumbersOfPointsAreTold) {
  const auto decoded = las(LasFile(4, 1, 3).put(107, 2U));
  ASSERT_TRUE(decoded);
  EXPECT_EQ(decoded->cloud.x.size(), 3U);
  EXPECT_THAT(decoded->notes,
              ElementsAre("number of points stands as 3 and, for old readers, as 2: 3 it is"));
}

// A7 to A9, A13.
TEST(Las, VariableLengthRecordsStayBeforeThePoints) {
  const std::string empty = vlr("LASF_Projection", 34735, 0, 0);
  EXPECT_TRUE(las(LasFile(2, 0, 3, empty).put(100, 1U)));
  std::string waveform = vlr("LASF_Spec", 100, 26, 26);
  waveform.replace(54 + 2, 4, "\x01\x00\x00\x80", 4);
  EXPECT_TRUE(las(LasFile(3, 4, 3, waveform).put(100, 1U)));
  std::string extra = vlr("LASF_Spec", 4, 192, 192);
  extra[54 + 2] = 10;  // a double that no record has room for
  EXPECT_TRUE(las(LasFile(4, 6, 3, empty + extra).put(100, 2U)));

  expect_refused(LasFile(2, 0, 3, vlr("x", 1, 10, 11)).put(100, 1U), "247",
                 "variable length record reaches into the points");
  expect_refused(LasFile(2, 0, 3, vlr("x", 1, 10, 65535)).put(100, 1U), "247", "got 65535 B, need <= 10 B");
  expect_refused(LasFile(2, 0, 3, vlr("x", 1, 60, 60)).put(100, 2U), "341",
                 "variable length record reaches into the points");
  for (const std::uint32_t count : {2U, 0x7FFFFFFFU, 0xFFFFFFFFU}) {
    expect_refused(LasFile(2, 0, 3, empty).put(100, count), "100", "do not fit before the points");
  }
}

TEST(Las, CutAtAnyByteItIsRefused) {
  const std::string bytes = LasFile(4, 7, 5, vlr("x", 1, 10, 10)).put(100, 1U).bytes();
  for (std::size_t size = 0; size < bytes.size(); ++size) EXPECT_FALSE(las(bytes.substr(0, size))) << size;
}

TEST(Las, WithAnyBitOfTheHeaderFlippedNothingBreaks) {
  const std::string good = LasFile(4, 6, 5, vlr("x", 1, 10, 10)).put(100, 1U).bytes();
  for (std::size_t at = 0; at < 375 + 54; ++at) {
    for (unsigned bit = 0; bit < 8; ++bit) {
      std::string bytes = good;
      bytes[at] = static_cast<char>(static_cast<unsigned char>(bytes[at]) ^ (1U << bit));
      const auto decoded = las(bytes);
      if (!decoded) continue;
      EXPECT_LE(decoded->cloud.x.size(), 5U) << at;
    }
  }
}

TEST(WriteLas, EverythingThatFitsComesBack) {
  const TemporaryFolder folder;
  const Scan scan = full_scan();
  const auto path = folder.path() / "a.las";
  std::vector<std::string> said;
  ASSERT_TRUE(write_las(path, scan, [&](LogLevel, std::string_view text) { said.emplace_back(text); }));
  EXPECT_THAT(said, ElementsAre(HasSubstr("intensity is multiplied by 257")));
  auto input = Input::open(path, {});
  ASSERT_TRUE(input);
  auto decoded = read_las(*input);
  ASSERT_TRUE(decoded) << to_string(decoded.error());
  EXPECT_THAT(decoded->notes, IsEmpty());
  EXPECT_NEAR(static_cast<double>(*decoded->stamp_ns), static_cast<double>(*scan.stamp_ns), 250.0);
  const Scan back = organise(std::move(decoded->cloud)).scan;
  ASSERT_EQ(back.size(), scan.size());
  EXPECT_EQ(back.ring_begin, scan.ring_begin);
  EXPECT_EQ(back.echo, scan.echo);
  EXPECT_EQ(back.label, scan.label);
  for (std::size_t i = 0; i < scan.size(); ++i) {
    EXPECT_NEAR(back.x[i], scan.x[i], 5.1e-5);
    EXPECT_NEAR(back.y[i], scan.y[i], 5.1e-5);
    EXPECT_NEAR(back.z[i], scan.z[i], 5.1e-5);
    EXPECT_EQ(back.intensity[i], 257.0F * scan.intensity[i]);
    EXPECT_NEAR(back.time_offset_ns[i], scan.time_offset_ns[i], 250.0);
  }
}

TEST(WriteLas, WhatWasWrittenIsWrittenAgainToTheSameBytes) {
  const TemporaryFolder folder;
  const auto write_and_read = [&](const Scan& scan, const std::string& name) {
    EXPECT_TRUE(write_las(folder.path() / name, scan));
    auto input = Input::open(folder.path() / name, {});
    return std::string(reinterpret_cast<const char*>(input->head(input->size())->data()), input->size());
  };
  const Scan scan = full_scan();
  const std::string once = write_and_read(scan, "1.las");
  EXPECT_EQ(write_and_read(scan, "2.las"), once);
  auto decoded = las(once);
  ASSERT_TRUE(decoded);
  const auto stamp = decoded->stamp_ns;
  Scan back = organise(std::move(decoded->cloud)).scan;
  back.stamp_ns = stamp;
  EXPECT_EQ(write_and_read(back, "3.las"), once);
}

TEST(WriteLas, IntensitiesAreScaledTo16Bits) {
  const TemporaryFolder folder;
  const auto written = [&](std::vector<float> intensity) {
    Cloud cloud;
    cloud.x = {1.0F, 2.0F};
    cloud.y = cloud.z = {0.0F, 0.0F};
    cloud.intensity = std::move(intensity);
    cloud.ring = {0, 1};
    Scan scan = organise(std::move(cloud)).scan;
    EXPECT_TRUE(write_las(folder.path() / "i.las", scan));
    auto input = Input::open(folder.path() / "i.las", {});
    return read_las(*input)->cloud.intensity;
  };
  EXPECT_THAT(written({0.5F, 1.0F}), ElementsAre(32768.0F, 65535.0F));
  EXPECT_THAT(written({2.0F, 255.0F}), ElementsAre(514.0F, 65535.0F));
  EXPECT_THAT(written({2.0F, 256.0F}), ElementsAre(2.0F, 256.0F));
  EXPECT_THAT(written({-3.0F, 1e9F}), ElementsAre(0.0F, 65535.0F));
}

TEST(WriteLas, WithoutAStampTimesAreSecondsFromTheFirstPoint) {
  const TemporaryFolder folder;
  Scan scan = full_scan();
  scan.stamp_ns.reset();
  ASSERT_TRUE(write_las(folder.path() / "t.las", scan));
  auto input = Input::open(folder.path() / "t.las", {});
  const auto decoded = read_las(*input);
  EXPECT_EQ(decoded->stamp_ns, std::nullopt);
  EXPECT_THAT(decoded->cloud.time_s[1], DoubleNear(0.001, 1e-6));
}

TEST(WriteLas, WhatDoesNotFitIsToldOrRefused) {
  const TemporaryFolder folder;
  Scan scan = full_scan();
  scan.label[3] = 252;
  scan.label[4] = 300;
  scan.echo[5] = 20;
  scan.pulse_width.assign(scan.size(), 1.0F);
  std::vector<std::string> said;
  ASSERT_TRUE(write_las(folder.path() / "a.las", scan,
                        [&](LogLevel, std::string_view text) { said.emplace_back(text); }));
  EXPECT_THAT(said, ElementsAre(HasSubstr("257"), HasSubstr("1 labels above 255 become class 0"),
                                HasSubstr("1 echoes above 14"), HasSubstr("pulse widths are left out")));
  scan.x[0] = 3e5F;
  const auto far = write_las(folder.path() / "b.las", scan);
  ASSERT_FALSE(far);
  EXPECT_EQ(far.error().code, ErrorCode::kUsage);
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "b.las"));
  Scan many;
  many.ring_begin.assign(258, 0);
  EXPECT_FALSE(write_las(folder.path() / "c.las", many));
}

TEST(GpsTime, LeapSecondsAreThoseOfTheBulletins) {
  EXPECT_EQ(unix_ns_of_adjusted_gps(-1e9), 315'964'800'000'000'000);
  // 2016-12-31 23:59:59 and 2017-01-01 00:00:00 UTC are two GPS seconds apart.
  EXPECT_DOUBLE_EQ(adjusted_gps_of(1'483'228'800'000'000'000) - adjusted_gps_of(1'483'228'799'000'000'000),
                   2.0);
  EXPECT_DOUBLE_EQ(adjusted_gps_of(1'483'228'800'000'000'000), 1'167'264'018.0 - 1e9);
  EXPECT_EQ(unix_ns_of_adjusted_gps(std::numeric_limits<double>::quiet_NaN()), std::nullopt);
  EXPECT_EQ(unix_ns_of_adjusted_gps(1e18), std::nullopt);
}

RC_GTEST_PROP(GpsTime, EveryTimeComesBackToAQuarterOfAMicrosecond, ()) {
  const auto ns = *rc::gen::inRange<std::int64_t>(315'964'800'000'000'000, 4'000'000'000'000'000'000);
  const auto back = unix_ns_of_adjusted_gps(adjusted_gps_of(ns));
  RC_ASSERT(back.has_value());
  RC_ASSERT(std::abs(*back - ns) <= 250);
}

}  // namespace verge::io
