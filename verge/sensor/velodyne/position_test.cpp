// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/sensor/velodyne/position.hpp"

#include <array>
#include <cstdio>
#include <cstring>

#include <gtest/gtest.h>

#include "verge/core/angle.hpp"
#include "verge/sensor/velodyne/packet.hpp"
#include "verge/sensor/velodyne/revolutions.hpp"

namespace verge::sensor::velodyne {
namespace {

/// "$body*checksum".
std::string sentence(const std::string& body) {
  unsigned sum = 0;
  for (const char c : body) sum ^= static_cast<unsigned char>(c);
  char tail[4];
  static_cast<void>(std::snprintf(tail, sizeof tail, "*%02X", sum));
  return "$" + body + tail;
}

std::string rmc(const std::string& time, const std::string& status, const std::string& date,
                const std::string& talker = "GP") {
  return sentence(talker + "RMC," + time + "," + status + ",3707.8178,N,12139.2690,W,010.3,188.2," + date +
                  ",013.8,E,D");
}

PositionBytes packet_with(const std::string& text) {
  PositionBytes bytes{};
  std::memcpy(bytes.data() + 206, text.data(), std::min<std::size_t>(text.size(), 306));
  return bytes;
}

constexpr std::int64_t kSecondNs = 1'000'000'000;
constexpr std::int64_t k20150723 = 1'437'609'600 * kSecondNs;  // 2015-07-23, 00:00

TEST(VelodyneNmea, ASentenceOfARealSensor) {
  const NmeaReading reading =
      read_nmea("$GPRMC,214106,A,3707.8178,N,12139.2690,W,010.3,188.2,230715,013.8,E,D*05\r\n");
  EXPECT_EQ(reading.fault, NmeaFault::kNone);
  EXPECT_TRUE(reading.locked);
  EXPECT_EQ(reading.utc_ns, k20150723 + (21 * 3600 + 41 * 60 + 6) * kSecondNs);
}

TEST(VelodyneNmea, N1WithoutAChecksumItDoesNotCount) {
  EXPECT_EQ(read_nmea("$GPRMC,214106,A,3707.8,N,121.2,W,010.3,188.2,230715,013.8,E,D").fault,
            NmeaFault::kNoChecksum);
  EXPECT_EQ(read_nmea("$GPRMC,214106*").fault, NmeaFault::kNoChecksum);
  EXPECT_EQ(read_nmea("$GPRMC,214106*5").fault, NmeaFault::kNoChecksum);
  EXPECT_EQ(read_nmea("$GPRMC,214106*XY").fault, NmeaFault::kNoChecksum);
}

TEST(VelodyneNmea, N2AWrongChecksumIsIgnoredAndCounted) {
  std::string text = rmc("214106", "A", "230715");
  text[8] = '3';
  EXPECT_EQ(read_nmea(text).fault, NmeaFault::kBadChecksum);
  RevolutionDecoder decoder;
  decoder.add(packet_with(text), 0);
  EXPECT_EQ(decoder.counters().nmea_ignored, 1U);
  EXPECT_EQ(decoder.counters().positions, 1U);
}

TEST(VelodyneNmea, N3WithoutATerminatorTheTextEndsWithThePacket) {
  const PositionPacket packet = parse_position(packet_with(std::string(400, 'x')));
  EXPECT_EQ(packet.sentence.size(), 306U);
  EXPECT_EQ(packet.nmea.fault, NmeaFault::kNoSentence);
}

TEST(VelodyneNmea, N4StatusVIsNotLocked) {
  const NmeaReading reading = read_nmea(rmc("214106", "V", "230715"));
  EXPECT_EQ(reading.fault, NmeaFault::kNone);
  EXPECT_FALSE(reading.locked);
}

TEST(VelodyneNmea, N5DatesThatAreNoneAndTheCentury) {
  EXPECT_EQ(read_nmea(rmc("000000", "A", "290223")).fault, NmeaFault::kBadTime);
  EXPECT_EQ(read_nmea(rmc("000000", "A", "320113")).fault, NmeaFault::kBadTime);
  EXPECT_EQ(read_nmea(rmc("000000", "A", "010180")).utc_ns, 315'532'800 * kSecondNs);    // 1980
  EXPECT_EQ(read_nmea(rmc("000000", "A", "010179")).utc_ns, 3'439'756'800 * kSecondNs);  // 2079
}

TEST(VelodyneNmea, N6TheLeapSecondIsTheNextMinutesFirst) {
  EXPECT_EQ(read_nmea(rmc("235960", "A", "230715")).utc_ns, k20150723 + 86'400 * kSecondNs);
  EXPECT_EQ(read_nmea(rmc("235961", "A", "230715")).fault, NmeaFault::kBadTime);
}

TEST(VelodyneNmea, N7AWeekCounterThatRolledOver) {
  constexpr std::int64_t kRollNs = 1024LL * 7 * 86'400 * kSecondNs;
  EXPECT_TRUE(week_rolled_over(k20150723 - kRollNs, k20150723));
  EXPECT_TRUE(week_rolled_over(k20150723 - 2 * kRollNs, k20150723));
  EXPECT_FALSE(week_rolled_over(k20150723, k20150723));
  EXPECT_FALSE(week_rolled_over(k20150723 - kRollNs / 2, k20150723));
  RevolutionDecoder decoder;
  decoder.add(packet_with(rmc("214106", "A", "230715")), k20150723 + kRollNs);
  EXPECT_EQ(decoder.counters().nmea_rolled_over, 1U);
}

TEST(VelodyneNmea, N9OtherTalkersLowerCaseAndTwoSentences) {
  EXPECT_EQ(read_nmea(rmc("214106", "A", "230715", "GN")).fault, NmeaFault::kNone);
  EXPECT_EQ(read_nmea("$gprmc,214106,a,,,,,,,230715,,*00").fault, NmeaFault::kNoSentence);
  EXPECT_EQ(read_nmea(sentence("GPGGA,214106,3707.8,N,121.2,W,1,08,0.9,10,M,,M,,")).fault,
            NmeaFault::kNoSentence);
  const NmeaReading both =
      read_nmea(rmc("214106", "A", "230715") + "\r\n" + rmc("214107", "A", "230715") + "\r\n");
  EXPECT_EQ(both.utc_ns, k20150723 + (21 * 3600 + 41 * 60 + 7) * kSecondNs);
  std::string lower = rmc("214106", "A", "230715");
  for (std::size_t i = lower.size() - 2; i < lower.size(); ++i)
    lower[i] = static_cast<char>(std::tolower(lower[i]));
  EXPECT_EQ(read_nmea(lower).fault, NmeaFault::kNone) << "the checksum's digits may be lower case";
}

TEST(VelodyneNmea, N10EmptyFieldsGiveNoTime) {
  EXPECT_EQ(read_nmea(rmc("", "A", "230715")).fault, NmeaFault::kBadTime);
  EXPECT_EQ(read_nmea(rmc("214106", "A", "")).fault, NmeaFault::kBadTime);
  EXPECT_EQ(read_nmea(sentence("GPRMC,,,,,,,,,,,")).fault, NmeaFault::kBadTime);
  EXPECT_EQ(read_nmea(sentence("GPRMC,214106")).fault, NmeaFault::kBadTime);
}

TEST(VelodyneNmea, FractionsOfASecondCountToTheNanosecond) {
  EXPECT_EQ(read_nmea(rmc("000000.25", "A", "230715")).utc_ns, k20150723 + kSecondNs / 4);
  EXPECT_EQ(read_nmea(rmc("000000.0000000019", "A", "230715")).utc_ns, k20150723 + 1);
}

TEST(VelodynePosition, TheManualsStamp) {
  PositionBytes bytes{};
  bytes[198] = std::byte{0x7C};
  bytes[199] = std::byte{0xBD};
  bytes[200] = std::byte{0x9C};
  bytes[201] = std::byte{0x91};
  bytes[202] = std::byte{2};
  const PositionPacket packet = parse_position(bytes);
  EXPECT_EQ(packet.stamp_us, 2'442'968'444U);  // 40 min 42.968 s
  EXPECT_EQ(packet.pps, Pps::kLocked);
}

TEST(VelodynePosition, InertialValuesAreTwelveBitsOfTwosComplement) {
  PositionBytes bytes{};
  const auto put = [&](std::size_t at, unsigned value) {
    bytes[at] = static_cast<std::byte>(value & 0xFFU);
    bytes[at + 1] = static_cast<std::byte>(value >> 8U);
  };
  put(14, 0xF064);  // the high four bits say what it is
  put(22, 0x0FFF);
  put(16, 0x0800);
  put(34, 0x07FF);
  const PositionPacket packet = parse_position(bytes);
  EXPECT_NEAR(rad_to_deg(packet.inertial[0].gyro_rad_s), 100 * 0.09766, 1e-9);
  EXPECT_NEAR(rad_to_deg(packet.inertial[1].gyro_rad_s), -0.09766, 1e-9);
  EXPECT_NEAR(packet.inertial[0].temperature_c, 25.0 - 2048 * 0.1453, 1e-9);
  EXPECT_NEAR(packet.inertial[2].acceleration_x_mps2, 2047 * 0.001221 * 9.80665, 1e-9);
}

TEST(LockedPosition, SaysTheTimeThatItWasMadeFor) {
  for (const std::int64_t utc_ns :
       {315'532'800'000'000'000, 1'767'225'599'999'999'999, 3'471'292'799'000'001'000}) {
    const PositionPacket packet = parse_position(locked_position(utc_ns));
    EXPECT_EQ(packet.nmea.fault, NmeaFault::kNone);
    EXPECT_EQ(packet.nmea.utc_ns, utc_ns / 1'000'000'000 * 1'000'000'000);
    EXPECT_TRUE(packet.nmea.locked);
    EXPECT_EQ(packet.pps, Pps::kLocked);
    EXPECT_EQ(packet.stamp_us, utc_ns / 1000 % 3'600'000'000);
  }
}

}  // namespace
}  // namespace verge::sensor::velodyne
