// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/sensor/velodyne/clock.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace verge::sensor::velodyne {
namespace {

constexpr std::int64_t kSecondNs = 1'000'000'000;
constexpr std::int64_t kHourNs = 3600 * kSecondNs;
constexpr std::int64_t kHour = 472'222 * kHourNs;  // a full hour of 2023
constexpr std::int64_t kPacketNs = 552'960;

std::uint32_t stamp_of(std::int64_t time_ns) { return static_cast<std::uint32_t>(time_ns % kHourNs / 1000); }

TEST(VelodyneClock, TheHourIsTheOneNearestToTheReference) {
  struct Row {
    std::int64_t reference_s, stamp_s, time_s;  // after kHour
  };
  constexpr Row kRows[] = {
      {0, 0, 0},       {0, 1, 1},          {0, 3599, -1},   {0, 1799, 1799},    {0, 1801, -1799},
      {1, 3599, -1},   {600, 0, 0},        {600, 3599, -1}, {600, 2399, 2399},  {600, 2401, -1199},
      {1800, 0, 0},    {1800, 3599, 3599}, {1801, 0, 3600}, {1799, 3599, 3599}, {3000, 3599, 3599},
      {3000, 0, 3600}, {3599, 0, 3600},    {3599, 1, 3601}, {3599, 3599, 3599}, {3599, 1798, 1798 + 3600}};
  for (const Row& row : kRows) {
    const HourTime time = time_of_hour(static_cast<std::uint32_t>(row.stamp_s * 1'000'000),
                                       kHour + row.reference_s * kSecondNs);
    EXPECT_EQ((time.time_ns - kHour) / kSecondNs, row.time_s) << row.reference_s << " " << row.stamp_s;
  }
}

TEST(VelodyneClock, HalfAnHourFromTheReferenceIsAmbiguous) {
  EXPECT_TRUE(time_of_hour(1'800'000'000U, kHour).ambiguous);
  EXPECT_TRUE(time_of_hour(1'799'500'000U, kHour).ambiguous);
  EXPECT_FALSE(time_of_hour(1'790'000'000U, kHour).ambiguous);
}

TEST(VelodyneClock, StampsBeyondTheHourCountOn) {  // V10; 3600060000 was seen (ros-drivers/velodyne#218)
  EXPECT_EQ(time_of_hour(3'600'060'000U, kHour + kHourNs).time_ns, kHour + kHourNs + 60'000'000);
}

RC_GTEST_PROP(VelodyneClock, TimeGoesOnOverTheHourWhateverTheHostsClock, ()) {  // B5 6
  const auto error_ns = *rc::gen::inRange<std::int64_t>(-1799 * kSecondNs, 1799 * kSecondNs);
  const auto phase_ns = *rc::gen::inRange<std::int64_t>(0, 60 * kSecondNs);
  StampClock clock;
  std::int64_t before_ns = 0;
  for (int packet = 0; packet < 200; ++packet) {
    const std::int64_t true_ns = kHour + kHourNs - phase_ns + packet * (kSecondNs / 3);
    const auto reading = clock.read(stamp_of(true_ns), true_ns + error_ns, kPacketNs);
    RC_ASSERT(reading.time_ns == true_ns / 1000 * 1000);
    RC_ASSERT(reading.time_ns > before_ns);
    RC_ASSERT(!reading.estimated && !reading.jumped);
    before_ns = reading.time_ns;
  }
}

TEST(VelodyneClock, AStampThatMakesNoSenseIsReplacedByWhatIsExpected) {
  StampClock clock;
  EXPECT_EQ(clock.read(stamp_of(kHour), kHour, kPacketNs).time_ns, kHour);
  for (const std::uint32_t stamp : {0xFFFFFFFFU, 1'234'567'890U}) {
    const auto reading = clock.read(stamp, kHour + kPacketNs, kPacketNs);
    EXPECT_TRUE(reading.estimated);
    EXPECT_GT(reading.time_ns, kHour);
    EXPECT_LT(reading.time_ns, kHour + 3 * kPacketNs);
  }
}

TEST(VelodyneClock, TwoStampsThatAgreeAreAClockThatWasSet) {
  StampClock clock;
  static_cast<void>(clock.read(stamp_of(kHour + 100 * kSecondNs), kHour + 100 * kSecondNs, kPacketNs));
  const std::int64_t set_ns = kHour + 900 * kSecondNs;
  EXPECT_TRUE(clock.read(stamp_of(set_ns), kHour + 100 * kSecondNs, kPacketNs).estimated);
  const auto second = clock.read(stamp_of(set_ns + kPacketNs), kHour + 100 * kSecondNs, kPacketNs);
  EXPECT_TRUE(second.jumped);
  EXPECT_EQ(second.time_ns, (set_ns + kPacketNs) / 1000 * 1000);
}

TEST(VelodyneClock, ACaptureClockThatGoesBackAnHourMovesNothing) {  // P15
  StampClock clock;
  static_cast<void>(clock.read(stamp_of(kHour + kSecondNs), kHour + kSecondNs, kPacketNs));
  const auto reading = clock.read(stamp_of(kHour + 2 * kSecondNs), kHour + kSecondNs - kHourNs, kPacketNs);
  EXPECT_EQ(reading.time_ns, kHour + 2 * kSecondNs);
}

TEST(VelodyneClock, OneRecordAnHourOffMovesNothingBehindIt) {  // P15
  for (const std::int64_t off_ns : {-kHourNs, kHourNs, -24 * kHourNs}) {
    StampClock clock;
    for (int i = 0; i < 10; ++i) {
      const std::int64_t time_ns = kHour + i * kPacketNs;
      const auto reading = clock.read(stamp_of(time_ns), time_ns + (i == 5 ? off_ns : 0), kPacketNs);
      EXPECT_EQ(reading.time_ns, time_ns / 1000 * 1000) << i << ", " << off_ns;
      EXPECT_FALSE(reading.jumped);
    }
  }
}

TEST(VelodyneClock, GpsGivesTheHourBeforeTheFirstPacketAndDisputesItAfter) {  // N8
  StampClock clock;
  const std::int64_t host_ns = kHour - 2 * kHourNs;
  clock.set_reference(kHour + 10 * kSecondNs, host_ns);
  EXPECT_EQ(clock.read(stamp_of(kHour + 10 * kSecondNs), host_ns, kPacketNs).time_ns, kHour + 10 * kSecondNs);
  clock.set_reference(kHour + 11 * kSecondNs, host_ns + kSecondNs);
  EXPECT_FALSE(clock.hour_disputed());
  clock.set_reference(kHour + kHourNs, host_ns + kSecondNs);
  EXPECT_TRUE(clock.hour_disputed());
}

TEST(VelodyneClock, AcrossTheFullHourGpsMayLagBehindTheStamp) {  // N8: text of :59:59, stamp of the new hour
  StampClock clock;
  clock.set_reference(kHour - kSecondNs, kHour);
  EXPECT_EQ(clock.read(300'000, kHour, kPacketNs).time_ns, kHour + 300'000'000);
}

TEST(VelodyneClock, WithoutAClockJitterIsSmoothed) {
  StampClock clock;
  std::int64_t before_ns = 0;
  for (int packet = 0; packet < 1000; ++packet) {
    const std::int64_t jitter_ns = packet % 2 == 0 ? 100'000 : -100'000;
    const auto reading = clock.read_received(kHour + packet * 384'600 + jitter_ns, 384'612);
    if (packet > 0) {
      EXPECT_GT(reading.time_ns - before_ns, 300'000);
    }
    if (packet > 100) {
      EXPECT_NEAR(static_cast<double>(reading.time_ns - kHour - packet * 384'600), 0.0, 30'000.0);
    }
    before_ns = reading.time_ns;
  }
}

}  // namespace
}  // namespace verge::sensor::velodyne
