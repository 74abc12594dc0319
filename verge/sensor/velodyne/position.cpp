// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/sensor/velodyne/position.hpp"

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <span>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "verge/core/angle.hpp"
#include "verge/core/byte_writer.hpp"
#include "verge/sensor/velodyne/packet.hpp"

namespace verge::sensor::velodyne {
namespace {

constexpr std::size_t kStampAt = 198;
constexpr std::size_t kPpsAt = 202;
constexpr std::size_t kSentenceAt = 206;

/// 12 bits, two's complement, at the low end of a word whose high bits say what it is.
int signed12(Bytes payload, std::size_t offset) {
  const int value = load_le<std::uint16_t>(payload, offset) & 0x0FFF;
  return value >= 0x0800 ? value - 0x1000 : value;
}

InertialReading inertial_at(Bytes payload, std::size_t offset) {
  constexpr double kGravity = 9.80665;
  return {deg_to_rad(0.09766 * signed12(payload, offset)), 0.1453 * signed12(payload, offset + 2) + 25.0,
          0.001221 * kGravity * signed12(payload, offset + 4),
          0.001221 * kGravity * signed12(payload, offset + 6)};
}

std::string sentence_of(Bytes payload) {
  const Bytes field = payload.subspan(kSentenceAt);
  const auto end = std::find(field.begin(), field.end(), std::byte{0});
  std::string text;
  for (auto at = field.begin(); at != end; ++at) text.push_back(static_cast<char>(*at));
  return text;
}

template <class T>
std::optional<T> number(std::string_view text, int base = 10) {
  T value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value, base);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

std::vector<std::string_view> split(std::string_view text) {
  std::vector<std::string_view> fields;
  while (true) {
    const std::size_t comma = text.find(',');
    fields.push_back(text.substr(0, comma));
    if (comma == std::string_view::npos) return fields;
    text.remove_prefix(comma + 1);
  }
}

bool all_digits(std::string_view text) {
  return std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

/// "hhmmss" with an optional fraction, in ns of the day; second 60 is allowed.
std::optional<std::int64_t> time_of_day(std::string_view text) {
  if (text.size() < 6 || !all_digits(text.substr(0, 6))) return std::nullopt;
  const auto hour = number<std::int64_t>(text.substr(0, 2));
  const auto minute = number<std::int64_t>(text.substr(2, 2));
  const auto second = number<std::int64_t>(text.substr(4, 2));
  if (*hour > 23 || *minute > 59 || *second > 60) return std::nullopt;
  std::string_view fraction = text.substr(6);
  std::int64_t fraction_ns = 0;
  if (!fraction.empty()) {
    if (fraction.front() != '.' || !all_digits(fraction.substr(1))) return std::nullopt;
    std::int64_t unit_ns = 100'000'000;
    for (const char digit : fraction.substr(1)) {
      fraction_ns += unit_ns * (digit - '0');
      unit_ns /= 10;
    }
  }
  return ((*hour * 60 + *minute) * 60 + *second) * 1'000'000'000 + fraction_ns;
}

/// "ddmmyy" in ns since the Unix epoch.
std::optional<std::int64_t> date_of(std::string_view text) {
  if (text.size() != 6 || !all_digits(text)) return std::nullopt;
  const int two_digits = *number<int>(text.substr(4, 2));
  const std::chrono::year_month_day date{std::chrono::year{two_digits + (two_digits >= 80 ? 1900 : 2000)},
                                         std::chrono::month{*number<unsigned>(text.substr(2, 2))},
                                         std::chrono::day{*number<unsigned>(text.substr(0, 2))}};
  if (!date.ok()) return std::nullopt;
  return std::chrono::nanoseconds(std::chrono::sys_days{date}.time_since_epoch()).count();
}

/// The sentence between '$' and '*', once its checksum is right.
NmeaReading read_body(std::string_view body) {
  const std::vector<std::string_view> fields = split(body);
  if (fields.size() < 10) return {NmeaFault::kBadTime, 0, false};
  const auto time = time_of_day(fields[1]);
  const auto date = date_of(fields[9]);
  if (!time || !date) return {NmeaFault::kBadTime, 0, false};
  return {NmeaFault::kNone, *date + *time, fields[2] == "A"};
}

unsigned checksum(std::string_view body) {
  unsigned sum = 0;
  for (const char c : body) sum ^= static_cast<unsigned char>(c);
  return sum;
}

/// One sentence from behind its '$' to its line's end.
NmeaReading read_sentence(std::string_view text) {
  const std::size_t star = text.find('*');
  if (star == std::string_view::npos || text.size() < star + 3) return {NmeaFault::kNoChecksum, 0, false};
  const auto told = number<unsigned>(text.substr(star + 1, 2), 16);
  if (!told) return {NmeaFault::kNoChecksum, 0, false};
  if (checksum(text.substr(0, star)) != *told) return {NmeaFault::kBadChecksum, 0, false};
  return read_body(text.substr(0, star));
}

}  // namespace

NmeaReading read_nmea(std::string_view text) {
  NmeaReading reading;
  while (true) {
    const std::size_t begin = text.find('$');
    if (begin == std::string_view::npos) return reading;
    text.remove_prefix(begin + 1);
    const bool minimum = text.starts_with("GPRMC,") || text.starts_with("GNRMC,");
    if (minimum) reading = read_sentence(text.substr(0, text.find_first_of("\r\n$")));
  }
}

bool week_rolled_over(std::int64_t utc_ns, std::int64_t host_ns) {
  constexpr std::int64_t kWeekNs = 7LL * 24 * 3600 * 1'000'000'000;
  constexpr std::int64_t kRollNs = 1024 * kWeekNs;
  const std::int64_t behind_ns = host_ns - utc_ns;
  const std::int64_t rolls = (behind_ns + kRollNs / 2) / kRollNs;
  return rolls >= 1 && std::abs(behind_ns - rolls * kRollNs) < kWeekNs;
}

PositionPacket parse_position(Bytes payload) {
  PositionPacket packet;
  for (std::size_t unit = 0; unit < packet.inertial.size(); ++unit) {
    packet.inertial[unit] = inertial_at(payload, 14 + 8 * unit);
  }
  packet.stamp_us = load_le<std::uint32_t>(payload, kStampAt);
  const auto pps = static_cast<std::uint8_t>(payload[kPpsAt]);
  packet.pps = pps <= 3 ? static_cast<Pps>(pps) : Pps::kAbsent;
  packet.sentence = sentence_of(payload);
  packet.nmea = read_nmea(packet.sentence);
  return packet;
}

PositionBytes locked_position(std::int64_t utc_ns) {
  using std::chrono::floor;
  const std::chrono::sys_time<std::chrono::nanoseconds> time{std::chrono::nanoseconds{utc_ns}};
  const std::chrono::year_month_day date{floor<std::chrono::days>(time)};
  const std::chrono::hh_mm_ss day{floor<std::chrono::seconds>(time) - floor<std::chrono::days>(time)};
  const std::string body = fmt::format(
      "GPRMC,{:02}{:02}{:02},A,0000.0000,N,00000.0000,E,000.0,000.0,{:02}{:02}{:02},000.0,E,A",
      day.hours().count(), day.minutes().count(), day.seconds().count(), static_cast<unsigned>(date.day()),
      static_cast<unsigned>(date.month()), static_cast<int>(date.year()) % 100);
  const std::string sentence = fmt::format("${}*{:02X}\r\n", body, checksum(body));
  const auto in_hour = time - floor<std::chrono::hours>(time);
  ByteWriter writer;
  writer.zeros(kStampAt).le(static_cast<std::uint32_t>(floor<std::chrono::microseconds>(in_hour).count()));
  writer.le(static_cast<std::uint8_t>(Pps::kLocked))
      .zeros(kSentenceAt - kPpsAt - 1)
      .bytes(std::as_bytes(std::span(sentence)));
  PositionBytes bytes{};
  const std::vector<std::byte> begin = std::move(writer).take();
  std::copy(begin.begin(), begin.end(), bytes.begin());
  return bytes;
}

}  // namespace verge::sensor::velodyne
