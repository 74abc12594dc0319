// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
// Every message: what is decoded encodes to the same bytes, and what cannot be is refused at its place.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "verge/sensor/ibeo/alasca_scan.hpp"
#include "verge/sensor/ibeo/health2030.hpp"
#include "verge/sensor/ibeo/idc.hpp"
#include "verge/sensor/ibeo/message.hpp"
#include "verge/sensor/ibeo/ntp.hpp"
#include "verge/sensor/ibeo/objects2221.hpp"
#include "verge/sensor/ibeo/scan2202.hpp"
#include "verge/sensor/ibeo/test_messages.hpp"
#include "verge/sensor/ibeo/vehicle2805.hpp"

namespace verge::sensor::ibeo {
namespace {

using testing::alasca_scan;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::lux_objects;
using testing::lux_scan;
using testing::patched;

using Body = std::vector<std::byte>;

Body random_bytes(std::size_t size) {
  const auto values =
      *rc::gen::container<std::vector<std::uint8_t>>(size, rc::gen::arbitrary<std::uint8_t>());
  Body bytes(size);
  for (std::size_t i = 0; i < size; ++i) bytes[i] = std::byte{values[i]};
  return bytes;
}

/// A number at an offset, big-endian.
template <class T>
Body patched_be(Body bytes, std::size_t offset, T value) {
  for (std::size_t i = 0; i < sizeof(T); ++i) {
    bytes[offset + i] = static_cast<std::byte>(value >> (8 * (sizeof(T) - 1 - i)));
  }
  return bytes;
}

template <class T>
void expect_refused(const Expected<T>& decoded, const std::string& what, const std::string& where) {
  ASSERT_FALSE(decoded) << what;
  EXPECT_EQ(decoded.error().what, what);
  EXPECT_EQ(decoded.error().where, where) << what;
  EXPECT_EQ(decoded.error().code, ErrorCode::kDamaged);
}

}  // namespace

TEST(Ntp, CountsFrom1900) {
  EXPECT_EQ(unix_ns_of(2'208'988'800ULL << 32U), 0);
  EXPECT_EQ(unix_ns_of((2'208'988'800ULL << 32U) + (1ULL << 31U)), 500'000'000);
  EXPECT_EQ(unix_ns_of(testing::kNtp), 1'348'258'004'000'000'000);
  EXPECT_EQ(unix_ns_of(~0ULL), 2'085'978'496'000'000'000);  // 2036-02-07 06:28:16
}

// L12.
TEST(Ntp, ASensorThatWasNotToldTheTimeHasNone) {
  EXPECT_EQ(unix_ns_of(0), std::nullopt);
  EXPECT_EQ(unix_ns_of(1'177'615'933'624ULL), std::nullopt);  // 274 s after it was powered
  EXPECT_EQ(unix_ns_of((2'208'988'800ULL << 32U) - 1), std::nullopt);
}

RC_GTEST_PROP(Ntp, EveryNanosecondComesBack, ()) {
  const auto ns = *rc::gen::inRange<std::int64_t>(0, 2'085'978'496'000'000'000);
  RC_ASSERT(unix_ns_of(ntp_of(ns)) == ns);
}

TEST(IbeoMessage, HeaderStandsAsInTheTable) {
  const Body message = encode_message({.previous_bytes = 0x01020304,
                                       .reserved = 0x55,
                                       .device = 6,
                                       .type = 0x2202,
                                       .ntp = 0x1122334455667788},
                                      Body(5));
  const std::vector<int> expected{0xAF, 0xFE, 0xC0, 0xC2, 1,    2,    3,    4,    0,    0,
                                  0,    5,    0x55, 6,    0x22, 0x02, 0x11, 0x22, 0x33, 0x44,
                                  0x55, 0x66, 0x77, 0x88, 0,    0,    0,    0,    0};
  ASSERT_EQ(message.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i)
    EXPECT_EQ(std::to_integer<int>(message[i]), expected[i]) << i;
  const MessageHeader header = decode_header(message);
  EXPECT_EQ(header, (MessageHeader{.previous_bytes = 0x01020304,
                                   .bytes = 5,
                                   .reserved = 0x55,
                                   .device = 6,
                                   .type = 0x2202,
                                   .ntp = 0x1122334455667788}));
}

// C5, vector 7, and L6.
TEST(LuxScan, OfAnyNumberOfPointsComesBack) {
  for (const std::size_t points : {0U, 1U, 740U, 65535U}) {
    const LuxScan scan = lux_scan(points);
    const Body body = encode_scan(scan);
    ASSERT_EQ(body.size(), 44 + 10 * points);
    const auto decoded = decode_scan(body);
    ASSERT_TRUE(decoded) << to_string(decoded.error());
    EXPECT_EQ(*decoded, scan);
    EXPECT_EQ(encode_scan(*decoded), body);
  }
}

RC_GTEST_PROP(LuxScan, AnyBytesThatDecodeEncodeToThemselves, ()) {
  const std::size_t points = *rc::gen::inRange<std::size_t>(0, 20);
  const Body body = patched(random_bytes(44 + 10 * points), 28, static_cast<std::uint16_t>(points));
  const auto decoded = decode_scan(body);
  if (decoded) RC_ASSERT(encode_scan(*decoded) == body);
  RC_ASSERT(decoded.has_value() == (load_le<std::uint16_t>(body, 22) != 0 &&
                                    load_le<std::uint64_t>(body, 14) >= load_le<std::uint64_t>(body, 6)));
}

TEST(LuxScan, FieldsStandAsInTheTable) {
  Body body(54);
  body = patched(body, 2, std::uint16_t{0x030B});
  body = patched(body, 14, std::uint64_t{99});
  body = patched(body, 22, std::uint16_t{11520});
  body = patched(body, 28, std::uint16_t{1});
  body = patched(body, 30, std::int16_t{-32});
  body = patched(body, 36, std::int16_t{365});
  body = patched(body, 42, std::uint16_t{0x0402});
  body = patched(body, 44, std::uint32_t{0xFA400823});  // layer 3, echo 2, dirt, angle -1472
  body = patched(body, 48, std::uint32_t{0x00641388});  // 5000 cm, width 100 cm
  const auto scan = decode_scan(body);
  ASSERT_TRUE(scan);
  EXPECT_EQ(scan->status, 0x030B);
  EXPECT_EQ(scan->end_ntp, 99U);
  EXPECT_EQ(scan->mounting, (Mounting{.yaw_ticks = -32, .x_cm = 365}));
  EXPECT_EQ(scan->flags, kRearMirror | kDirtLabelled);
  EXPECT_THAT(scan->points, ElementsAre(LuxPoint{.layer = 3,
                                                 .echo = 2,
                                                 .flags = kDirt,
                                                 .angle_ticks = -1472,
                                                 .range_cm = 5000,
                                                 .pulse_width_cm = 100,
                                                 .reserved = 0}));
}

// L4, L5, L7.
TEST(LuxScan, ASizeThatDoesNotFitItsPointsIsRefused) {
  const Body good = encode_scan(lux_scan(10));
  expect_refused(decode_scan(Body(0), 1000), "scan is shorter than its header", "1000");
  expect_refused(decode_scan(Body(good.begin(), good.begin() + 43)), "scan is shorter than its header", "0");
  for (const std::uint16_t points : std::initializer_list<std::uint16_t>{0, 9, 11, 65535}) {
    expect_refused(decode_scan(patched(good, 28, points), 1000), "size of a scan does not fit its points",
                   "1028");
  }
  for (const std::size_t size : {44U, 45U, 53U, 143U}) {
    expect_refused(decode_scan(Body(good.begin(), good.begin() + static_cast<std::ptrdiff_t>(size))),
                   "size of a scan does not fit its points", "28");
  }
  Body longer = good;
  longer.emplace_back();
  expect_refused(decode_scan(longer), "size of a scan does not fit its points", "28");
}

// L10, L11.
TEST(LuxScan, WithoutTicksOrWithAnEndBeforeItsStartIsRefused) {
  const Body good = encode_scan(lux_scan(10));
  expect_refused(decode_scan(patched(good, 22, std::uint16_t{0})), "a turn of a scan has no angle ticks",
                 "22");
  for (const std::uint16_t ticks : std::initializer_list<std::uint16_t>{1, 11520, 65535})
    EXPECT_TRUE(decode_scan(patched(good, 22, ticks))) << ticks;
  expect_refused(decode_scan(patched(good, 14, testing::kNtp - 1)), "scan ends before it starts", "14");
  EXPECT_TRUE(decode_scan(patched(good, 14, testing::kNtp)));
}

// C5, vector 10, and L13.
TEST(LuxObjects, OfAnyContourComeBack) {
  const std::vector<std::vector<int>> lists{{}, {0}, {1}, {-1}, {5, 0, 3}, {-1, 4, -1, 0, 1}};
  for (const std::vector<int>& contours : lists) {
    const LuxObjects list = lux_objects(contours);
    const Body body = encode_objects(list);
    const auto decoded = decode_objects(body);
    ASSERT_TRUE(decoded) << to_string(decoded.error());
    EXPECT_EQ(*decoded, list);
    EXPECT_EQ(encode_objects(*decoded), body);
  }
}

TEST(LuxObjects, AnUnknownContourMayHaveOnePoint) {
  LuxObjects list = lux_objects({-1, 2, -1});
  for (LuxObject& object : list.objects) {
    if (object.contour_unknown) object.contour = {{11, 12}};
  }
  const Body body = encode_objects(list);
  const auto decoded = decode_objects(body);
  ASSERT_TRUE(decoded);
  EXPECT_EQ(*decoded, list);
  EXPECT_EQ(encode_objects(*decoded), body);
}

TEST(LuxObjects, FieldsStandAsInTheTable) {
  Body body(10 + 58 + 4);
  body = patched(body, 8, std::uint16_t{1});
  body = patched(body, 10 + 24, std::uint16_t{180});  // width before length
  body = patched(body, 10 + 26, std::uint16_t{450});
  body = patched(body, 10 + 36, std::int16_t{-320});
  body = patched(body, 10 + 46, std::int16_t{77});
  body = patched(body, 10 + 50, std::uint16_t{5});
  body = patched(body, 10 + 56, std::uint16_t{1});
  body = patched(body, 10 + 58, std::int16_t{-9});
  const auto list = decode_objects(body);
  ASSERT_TRUE(list);
  const LuxObject& object = list->objects.at(0);
  EXPECT_EQ(object.bounding_box_width, 180);
  EXPECT_EQ(object.bounding_box_length, 450);
  EXPECT_EQ(object.box_orientation_ticks, -320);
  EXPECT_EQ(object.relative_velocity.x, 77);
  EXPECT_EQ(object.kind, ObjectClass::kCar);
  EXPECT_THAT(object.contour, ElementsAre(Pair<std::int16_t>{-9, 0}));
}

TEST(LuxObjects, AListThatDoesNotEndWithItsMessageIsRefused) {
  const Body good = encode_objects(lux_objects({5, 0, 3}));
  for (std::size_t size = 0; size < good.size(); ++size) {
    EXPECT_FALSE(decode_objects(Body(good.begin(), good.begin() + static_cast<std::ptrdiff_t>(size))))
        << size;
  }
  Body longer = good;
  longer.emplace_back();
  expect_refused(decode_objects(longer, 100), "list of objects is shorter than its message", "316");
  expect_refused(decode_objects(patched(good, 8, std::uint16_t{65535})),
                 "list of objects has more than its size allows", "8");
  expect_refused(decode_objects(patched(good, 10 + 56, std::uint16_t{60000})),
                 "contour of an object is longer than the list", "66");
}

// L15.
TEST(LuxHealth, BitsHaveTheirMeaningsAndComeBack) {
  const LuxHealth health{
      .error_1 = 0x0102, .error_2 = 0x0001, .warning_1 = 0x0010, .warning_2 = 0, .reserved = {1, 2, 3, 4}};
  const Body body = encode_health(health);
  ASSERT_EQ(body.size(), 16U);
  const auto decoded = decode_health(body);
  ASSERT_TRUE(decoded);
  EXPECT_EQ(*decoded, health);
  EXPECT_THAT(troubles_of(health), ElementsAre("motor error", "receiver too warm or too cold", "no scan data",
                                               "warning: high temperature"));
  EXPECT_THAT(troubles_of({.error_1 = 0x0300}), ElementsAre("temperature sensor defective"));
  EXPECT_THAT(troubles_of({}), IsEmpty());
  expect_refused(decode_health(Body(15), 7), "size of errors and warnings is wrong", "7");
}

RC_GTEST_PROP(VehicleState, AnyBytesEncodeToThemselves, ()) {
  const Body body = random_bytes(46);
  const auto decoded = decode_vehicle_state(body);
  RC_ASSERT(decoded.has_value());
  RC_ASSERT(encode_vehicle_state(*decoded) == body);
}

TEST(VehicleState, FieldsStandAsInTheTable) {
  Body body = patched(Body(46), 12, std::int16_t{1389});
  body = patched(body, 24, std::int32_t{-70000});
  body = patched(body, 36, std::int16_t{-50});
  body = patched(body, 40, std::int16_t{123});
  const auto state = decode_vehicle_state(body);
  ASSERT_TRUE(state);
  EXPECT_EQ(state->velocity_cm_s, 1389);
  EXPECT_EQ(state->y_cm, -70000);
  EXPECT_EQ(state->heading_difference_1e4_rad, -50);
  EXPECT_EQ(state->yaw_rate_1e4_rad_s, 123);
  expect_refused(decode_vehicle_state(Body(47), 3), "size of a vehicle state is wrong", "3");
}

TEST(FrameIndex, ComesBack) {
  const FrameIndex index{.major = 2,
                         .minor = 1,
                         .name = "seventeen letters",
                         .time_offset_ms = 77,
                         .trigger_in_new_frame = true,
                         .triggers = {{0x2202, 255}, {0x2205, 3}},
                         .entries = {{0, 0, 255}, {7468, 80, 1}}};
  const Body body = encode_frame_index(index);
  ASSERT_EQ(body.size(), 128U + 2 * 17);
  const auto decoded = decode_frame_index(body, 15000);
  ASSERT_TRUE(decoded) << to_string(decoded.error());
  EXPECT_EQ(*decoded, index);
  EXPECT_EQ(encode_frame_index(*decoded), body);
}

// L18, L19.
TEST(FrameIndex, CountsAndPlacesThatCannotBeAreRefused) {
  const FrameIndex index{.name = "x", .triggers = {{}}, .entries = {{0, 0, 255}, {7468, 80, 1}}};
  const Body good = encode_frame_index(index);
  for (const std::uint64_t count : {3ULL, 1ULL << 60U, ~0ULL}) {
    expect_refused(decode_frame_index(patched_be(good, 19, count), 15000),
                   "frame index has more entries than its size allows", "15019");
  }
  expect_refused(decode_frame_index(patched_be(good, 36, std::uint16_t{31}), 15000),
                 "frame index has too many triggers", "15036");
  expect_refused(decode_frame_index(good, 7468), "frame index points behind itself",
                 std::to_string(7468 + 145));
  expect_refused(decode_frame_index(Body(127), 1), "frame index is shorter than its header", "1");
}

// C5, vector 8.
TEST(IdcWriter, ChainsSizesAndClosesWithIndexAndTrailer) {
  IdcWriter writer;
  const Body scan = encode_scan(lux_scan(3));
  Body file;
  for (std::uint64_t i = 0; i < 3; ++i) {
    const Body bytes = writer.add({.device = 4, .type = kScanType, .ntp = testing::kNtp + (i << 31U)}, scan);
    file.insert(file.end(), bytes.begin(), bytes.end());
  }
  EXPECT_EQ(decode_header(Bytes(file).first(24)).previous_bytes, 0U);
  EXPECT_EQ(decode_header(Bytes(file).subspan(98, 24)).previous_bytes, 74U);
  const Body end = writer.close();
  const auto index_header = decode_header(Bytes(end).first(24));
  EXPECT_EQ(index_header.type, kIdcIndexType);
  const auto index = decode_frame_index(Bytes(end).subspan(24, index_header.bytes), file.size() + 24);
  ASSERT_TRUE(index) << to_string(index.error());
  EXPECT_THAT(index->entries,
              ElementsAre(IndexEntry{0, 0, 4}, IndexEntry{98, 500, 4}, IndexEntry{196, 1000, 4}));
  const auto trailer = decode_header(Bytes(end).last(24));
  EXPECT_EQ(trailer.type, kIdcTrailerType);
  EXPECT_EQ(trailer.bytes, 0U);
  EXPECT_EQ(trailer.previous_bytes, 128U + 3 * 17);
}

// C5, vector 9.
TEST(AlascaCode, IsCentimetresTo100MetresAndDecimetresBeyond) {
  EXPECT_DOUBLE_EQ(metres_of_code(10000), 100.0);
  EXPECT_DOUBLE_EQ(metres_of_code(10001), 100.1);
  EXPECT_DOUBLE_EQ(metres_of_code(-10000), -100.0);
  EXPECT_DOUBLE_EQ(metres_of_code(-10001), -100.1);
  EXPECT_DOUBLE_EQ(metres_of_code(32767), 2376.7);
  EXPECT_DOUBLE_EQ(metres_of_code(-32768), -2376.8);
}

TEST(AlascaCode, EveryCodeComesBackAndCodesRise) {
  for (int code = -32768; code <= 32767; ++code) {
    const auto c = static_cast<std::int16_t>(code);
    ASSERT_EQ(code_of_metres(metres_of_code(c)), c);
    if (code > -32768) {
      ASSERT_GT(metres_of_code(c), metres_of_code(static_cast<std::int16_t>(code - 1)));
    }
  }
}

RC_GTEST_PROP(AlascaCode, IsTheNearest, ()) {
  const double metres = *rc::gen::inRange(-23767000, 23767000) * 1e-4;
  const double back = metres_of_code(*code_of_metres(metres));
  RC_ASSERT(std::abs(back - metres) <= (std::abs(metres) <= 100.0 ? 0.005 : 0.05) + 1e-9);
}

TEST(AlascaCode, WhatNoCodeCanSayHasNone) {
  EXPECT_EQ(code_of_metres(2377.0), std::nullopt);
  EXPECT_EQ(code_of_metres(-2377.0), std::nullopt);
  EXPECT_EQ(code_of_metres(std::numeric_limits<double>::quiet_NaN()), std::nullopt);
  EXPECT_EQ(code_of_metres(std::numeric_limits<double>::infinity()), std::nullopt);
}

TEST(AlascaScan, OfAnyNumberOfPointsComesBack) {
  for (const std::size_t points : {0U, 1U, 8648U}) {
    const AlascaScan scan = alasca_scan(points);
    const Body body = encode_alasca_scan(scan);
    ASSERT_EQ(body.size(), 16 + 12 * points);
    const auto decoded = decode_alasca_scan(body);
    ASSERT_TRUE(decoded) << to_string(decoded.error());
    EXPECT_EQ(*decoded, scan);
    EXPECT_EQ(encode_alasca_scan(*decoded), body);
  }
  EXPECT_EQ(encode_alasca_message({.type = 15}, encode_alasca_scan(alasca_scan(8648))).size(), 103'808U);
}

RC_GTEST_PROP(AlascaScan, AnyBytesThatDecodeEncodeToThemselves, ()) {
  const std::size_t points = *rc::gen::inRange<std::size_t>(0, 20);
  const Body body = patched_be(random_bytes(16 + 12 * points), 14, static_cast<std::uint16_t>(points));
  const auto decoded = decode_alasca_scan(body);
  RC_ASSERT(decoded.has_value());
  RC_ASSERT(encode_alasca_scan(*decoded) == body);
}

TEST(AlascaScan, ASizeThatDoesNotFitItsPointsIsRefused) {
  const Body good = encode_alasca_scan(alasca_scan(10));
  expect_refused(decode_alasca_scan(Body(15), 50), "scan is shorter than its header", "50");
  for (const std::uint16_t points : std::initializer_list<std::uint16_t>{0, 9, 11, 8648}) {
    expect_refused(decode_alasca_scan(patched_be(good, 14, points), 50),
                   "size of a scan does not fit its points", "64");
  }
  expect_refused(decode_alasca_scan(patched_be(good, 14, std::uint16_t{8649}), 50),
                 "scan has more points than the sensor", "64");
  expect_refused(decode_alasca_scan(patched_be(Body(16 + 12 * 8649), 14, std::uint16_t{8649})),
                 "scan has more points than the sensor", "14");
}

TEST(AlascaMessage, HeaderStandsAsInTheTable) {
  const Body message = encode_alasca_message({.type = 15, .time_ms = 0x01020304}, Body(3));
  EXPECT_EQ(load_be<std::uint32_t>(message, 0), 0xAFFEC0C0U);
  EXPECT_EQ(decode_alasca_header(message), (AlascaHeader{.bytes = 3, .type = 15, .time_ms = 0x01020304}));
}

}  // namespace verge::sensor::ibeo
