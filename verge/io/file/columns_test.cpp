// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/io/file/columns.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "verge/io/test_files.hpp"

namespace verge::io {
namespace {

using ::testing::AnyOf;
using ::testing::DoubleNear;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

std::optional<std::size_t> field_of(const RoleFields& roles, Role role) {
  return roles[static_cast<std::size_t>(role)];
}

/// The values as the file would store them, and the column over them.
template <class T>
std::string stored(const std::vector<T>& values, bool big_endian) {
  std::string bytes;
  for (const T value : values) {
    std::string one(sizeof(T), '\0');
    std::memcpy(one.data(), &value, sizeof(T));
    if (big_endian) std::reverse(one.begin(), one.end());
    bytes += one;
  }
  return bytes;
}

template <class T>
std::vector<float> as_intensity(const std::vector<T>& values, Scalar type, bool big_endian) {
  const std::string bytes = stored(values, big_endian);
  CloudBuilder builder(values.size());
  builder.add(Role::kIntensity, {testing::bytes_of(bytes), 0, sizeof(T), type, big_endian});
  return std::move(builder).take().cloud.intensity;
}

}  // namespace

TEST(Roles, GoByTheNamesThatDriversUse) {
  const std::vector<std::string> ouster{"x",    "y",       "z",    "intensity", "t", "reflectivity",
                                        "ring", "ambient", "range"};
  const RoleFields roles = assign_roles(ouster);
  EXPECT_EQ(field_of(roles, Role::kIntensity), 3U);  // before reflectivity
  EXPECT_EQ(field_of(roles, Role::kTime), 4U);
  EXPECT_EQ(field_of(roles, Role::kRing), 6U);
  for (const char* ring : {"ring", "channel", "line", "row", "level", "Ring", "scalar_Ring"}) {
    EXPECT_EQ(field_of(assign_roles(std::vector<std::string>{ring}), Role::kRing), 0U) << ring;
  }
  for (const char* time : {"t", "time", "timestamp", "timestamps", "time_stamp", "offset_time", "stamps"}) {
    EXPECT_EQ(field_of(assign_roles(std::vector<std::string>{time}), Role::kTime), 0U) << time;
  }
  for (const char* intensity : {"intensity", "i", "reflectivity", "scalar_Intensity"}) {
    EXPECT_EQ(field_of(assign_roles(std::vector<std::string>{intensity}), Role::kIntensity), 0U) << intensity;
  }
  EXPECT_FALSE(field_of(assign_roles(std::vector<std::string>{"rings", "ix", "_"}), Role::kRing));
}

TEST(Column, EveryTypeComesOutInBothOrdersOfBytes) {
  for (const bool big : {false, true}) {
    EXPECT_THAT(as_intensity<std::int8_t>({-128, 127}, Scalar::kI8, big), ElementsAre(-128.0F, 127.0F));
    EXPECT_THAT(as_intensity<std::uint8_t>({0, 255}, Scalar::kU8, big), ElementsAre(0.0F, 255.0F));
    EXPECT_THAT(as_intensity<std::int16_t>({-32768, 258}, Scalar::kI16, big), ElementsAre(-32768.0F, 258.0F));
    EXPECT_THAT(as_intensity<std::uint16_t>({65535, 258}, Scalar::kU16, big), ElementsAre(65535.0F, 258.0F));
    EXPECT_THAT(as_intensity<std::int32_t>({-70000, 1}, Scalar::kI32, big), ElementsAre(-70000.0F, 1.0F));
    EXPECT_THAT(as_intensity<std::uint32_t>({70000, 1}, Scalar::kU32, big), ElementsAre(70000.0F, 1.0F));
    EXPECT_THAT(as_intensity<std::int64_t>({-1, 1 << 20}, Scalar::kI64, big), ElementsAre(-1.0F, 1048576.0F));
    EXPECT_THAT(as_intensity<std::uint64_t>({0, 1 << 20}, Scalar::kU64, big), ElementsAre(0.0F, 1048576.0F));
    EXPECT_THAT(as_intensity<float>({-0.5F, 1e30F}, Scalar::kF32, big), ElementsAre(-0.5F, 1e30F));
    EXPECT_THAT(as_intensity<double>({-0.5, 1e30}, Scalar::kF64, big), ElementsAre(-0.5F, 1e30F));
  }
}

TEST(Column, ADoubleThatNoFloatHoldsIsInfinite) {
  const auto values = as_intensity<double>({1e300, -1e300, 3e38}, Scalar::kF64, false);
  EXPECT_THAT(values, ElementsAre(INFINITY, -INFINITY, 3e38F));
}

TEST(Rings, WhatIsNoIntegerDropsItsPoint) {
  CloudBuilder builder(5);
  const std::vector<double> ones(5, 1.0);
  for (const Role role : {Role::kX, Role::kY, Role::kZ}) builder.add(role, ones, Scalar::kF64);
  builder.add(Role::kRing, std::vector<double>{0, -3, 2.5, NAN, 1e12}, Scalar::kF64);
  const Decoded decoded = std::move(builder).take();
  EXPECT_EQ(decoded.cloud.ring[1], -3);
  for (const std::size_t good : {0U, 1U}) EXPECT_EQ(decoded.cloud.x[good], 1.0F);
  for (const std::size_t bad : {2U, 3U, 4U}) EXPECT_TRUE(std::isnan(decoded.cloud.x[bad]));
  EXPECT_THAT(decoded.notes, ElementsAre("3 of 5 points have no valid ring and are dropped"));
}

TEST(Times, IntegersAreNanosecondsOfTheScan) {
  Decoded out;
  set_times(std::vector<std::int64_t>{0, 1'000'000, 99'000'000}, out);
  EXPECT_FALSE(out.stamp_ns);
  EXPECT_THAT(out.cloud.time_s, ElementsAre(0.0, DoubleNear(0.001, 1e-12), DoubleNear(0.099, 1e-12)));
}

TEST(Times, IntegersSince1970AreExact) {
  Decoded out;
  set_times(std::vector<std::int64_t>{1'700'000'000'000'000'017, 1'700'000'000'000'000'016, 0}, out);
  EXPECT_EQ(out.stamp_ns, 1'700'000'000'000'000'016);
  EXPECT_THAT(out.cloud.time_s, ElementsAre(DoubleNear(1e-9, 1e-15), 0.0, 0.0));  // 0: nothing came back
}

TEST(Times, DoublesTellTheirUnitByTheirSize) {
  for (const double unit : {1.0, 1e3, 1e6, 1e9}) {
    Decoded out;
    set_times(std::vector<double>{1.7e9 * unit + 0.05 * unit, 1.7e9 * unit, 0.0}, Scalar::kF64, out);
    ASSERT_TRUE(out.stamp_ns) << unit;
    EXPECT_EQ(*out.stamp_ns, 1'700'000'000'000'000'000) << unit;
    EXPECT_THAT(out.cloud.time_s, ElementsAre(DoubleNear(0.05, 1e-6), 0.0, 0.0)) << unit;
  }
}

// Found by fuzzing: seconds of the year 3075 did not fit 64 bits of nanoseconds.
TEST(Times, AnySizeFitsSomeUnit) {
  for (double greatest = 1.0; greatest < 9e18; greatest *= 1.7) {
    Decoded out;
    set_times(std::vector<double>{greatest, greatest}, Scalar::kF64, out);
    EXPECT_THAT(out.cloud.time_s, Each(AnyOf(0.0, greatest))) << greatest;
    if (out.stamp_ns) {
      EXPECT_GT(*out.stamp_ns, 0) << greatest;
    }
  }
}

TEST(Times, SmallFloatsAreSecondsOfTheScan) {
  for (const Scalar type : {Scalar::kF32, Scalar::kF64}) {
    Decoded out;
    set_times(std::vector<double>{-0.1, 0.0, NAN}, type, out);
    EXPECT_FALSE(out.stamp_ns);
    EXPECT_THAT(out.cloud.time_s, ElementsAre(-0.1, 0.0, 0.0));
  }
}

TEST(Times, AbsoluteFloatsAreTooCoarse) {
  Decoded out;
  set_times(std::vector<double>{1.7e9, 1.7e9}, Scalar::kF32, out);
  EXPECT_THAT(out.cloud.time_s, IsEmpty());
  EXPECT_FALSE(out.stamp_ns);
  EXPECT_EQ(out.notes.size(), 1U);
}

TEST(Times, HugeOnesAreNone) {
  Decoded out;
  set_times(std::vector<double>{1e300, 1e19, -1e300, 0.5}, Scalar::kF64, out);
  EXPECT_FALSE(out.stamp_ns);
  EXPECT_THAT(out.cloud.time_s, ElementsAre(0.0, 0.0, 0.0, 0.5));
}

}  // namespace verge::io
