// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0

// Section N: position packets of an HDL-32E. What they say of the time decides the hour and nothing else, so
// that a bad one leaves the scans as they are.
#include <cstdio>
#include <utility>

#include "tests/faults/bad_inputs.hpp"
#include "tests/faults/capture_samples.hpp"

namespace verge::faults {
namespace {

using testing::capture_of;
using testing::SensorPacket;

constexpr std::int64_t kHourNs = 3'600'000'000'000;
constexpr std::int64_t kBeginNs = 1'700'000'000'000'000'000;  // 2023-11-14, 22:13:20
constexpr std::int64_t kFullHourNs = 472'223LL * kHourNs;     // 23:00:00
constexpr std::size_t kSentenceAt = 206;
constexpr std::size_t kSentenceBytes = 306;

/// "$BODY*CHECKSUM".
std::string sentence(const std::string& body) {
  unsigned sum = 0;
  for (const char c : body) sum ^= static_cast<unsigned char>(c);
  char tail[4];
  static_cast<void>(std::snprintf(tail, sizeof tail, "*%02X", sum));
  return "$" + body + tail;
}

std::string rmc(const std::string& time, const std::string& date, const std::string& status = "A",
                const std::string& name = "GPRMC") {
  return sentence(name + "," + time + "," + status + ",3707.8178,N,12139.2690,W,010.3,188.2," + date +
                  ",013.8,E,D");
}

/// A record of a position packet with that text.
std::string position(const std::string& text, std::int64_t time_ns) {
  std::string payload(sensor::velodyne::kPositionBytes, '\0');
  payload.replace(kSentenceAt, std::min(text.size(), kSentenceBytes), text.substr(0, kSentenceBytes));
  return record_of({payload, time_ns}, {.port = 8308});
}

/// The position packet before packet `before` of a drive that begins at `begin_ns`.
std::string drive_with(const std::string& text, std::int64_t begin_ns, std::size_t before) {
  const Packets sent = packets_of({.begin_ns = begin_ns, .packets = kPackets});
  return capture_of(sent).insert(record_at(before), position(text, sent[before].time_ns));
}

/// The text in a position packet at the drive's begin: `counter` counts it, and the scans are those without.
BadInput ignored(std::string code, std::string title, const std::string& text, std::string counter) {
  return {.code = std::move(code),
          .title = std::move(title),
          .make = file("N.pcap", [text] { return drive_with(text, kBeginNs, 0); }),
          .exit = kGood,
          .used = kAllPoints,
          .counted = {{std::move(counter), 1}, {"sentences received", 1}},
          .scans = 1,
          .same_as = file("clean.pcap", [] { return capture_of(packets()); })};
}

void add_sentences(std::vector<BadInput>& all) {
  const std::string unusable = "sentences without a time";
  const std::string absent = "sentences that are not there";
  const std::string used = "sentences used";
  const std::string right = rmc("221320", "141123");
  all.push_back(ignored("N01a", "NoStar", right.substr(0, right.find('*')), unusable));
  all.push_back(ignored("N01b", "NothingBehindTheStar", right.substr(0, right.find('*') + 1), unusable));
  all.push_back(ignored("N01c", "NoDigitsBehindTheStar", right.substr(0, right.find('*')) + "*XY", unusable));
  // Another hour behind a wrong checksum.
  const std::string other = rmc("111320", "141123");
  all.push_back(ignored("N02", "ChecksumWrong", other.substr(0, other.find('*')) + "*00", unusable));
  all.push_back(ignored("N03a", "NoTerminatorAndNoSentence", std::string(kSentenceBytes, 'x'), absent));
  all.push_back(
      ignored("N03b", "NoTerminatorBehindASentence", right + std::string(kSentenceBytes, 'x'), used));
  all.push_back(
      ignored("N03c", "SentenceCutByThePacket", std::string(kSentenceBytes - 20, 'x') + right, unusable));
  all.push_back(
      ignored("N04", "StatusV", rmc("111320", "141123", "V"), "sentences of a receiver that guesses"));
  all.push_back(ignored("N05a", "NoSuchDay", rmc("111320", "290223"), unusable));
  all.push_back(ignored("N05b", "NoSuchMonthsDay", rmc("111320", "320113"), unusable));
  all.push_back(ignored("N05c", "YearBeforeThereWereSensors", rmc("111320", "060180"), unusable));
  all.push_back(ignored("N05d", "NoSuchHour", rmc("241320", "141123"), unusable));
  all.push_back(
      ignored("N07a", "WeekCounterRolledOver", rmc("221320", "300304"), "sentences 1024 weeks old"));
  all.back().warns = "1 GPS sentences are 1024 weeks old";
  all.push_back(ignored("N09a", "OtherTalker", rmc("221320", "141123", "A", "GNRMC"), used));
  all.push_back(ignored("N09b", "LowerCase", rmc("111320", "141123", "A", "gprmc"), absent));
  all.push_back(ignored("N09c", "TwoSentencesTheLastCounts", other + "\r\n" + right + "\r\n", used));
  all.push_back(ignored("N09d", "SentenceOfAnotherKind",
                        sentence("GPGGA,111320,3707.8,N,12139.2,W,1,8,1,1,M,1,M,,"), absent));
  all.push_back(ignored("N10a", "FieldsEmpty", sentence("GPRMC,,,,,,,,,,,,N"), unusable));
  all.push_back(ignored("N10b", "FieldsEmptyWithStatusV", sentence("GPRMC,,V,,,,,,,,,,N"), unusable));
  all.push_back(ignored("N10c", "FieldsMissing", sentence("GPRMC,221320,A"), unusable));
  all.push_back(ignored("N10d", "TimeWithoutDate", rmc("111320", ""), unusable));
}

/// What a sentence that is believed does to the hour.
void add_hours(std::vector<BadInput>& all) {
  // The host's clock is wrong by more than an hour and a half: the leap second is 0:00 of the next day.
  const std::int64_t right_ns = kFullHourNs + kHourNs + 5'000'000;
  all.push_back(ignored("N06", "LeapSecond", "", "sentences used"));
  const auto host_ahead = [right_ns](const std::string& text) {
    return [=] {
      Packets sent = packets_of({.begin_ns = right_ns, .packets = kPackets});
      for (SensorPacket& packet : sent) packet.time_ns += 2 * kHourNs;
      const std::string first = text.empty() ? "" : position(text, sent.front().time_ns);
      return capture_of(sent).insert(record_at(0), first);
    };
  };
  all.back().make = file("N.pcap", host_ahead(rmc("235960", "141123")));
  all.back().same_as = file("right.pcap", [right_ns] {
    return capture_of(packets_of({.begin_ns = right_ns, .packets = kPackets}));
  });
  // The sentence is of the hour before, the stamps have wrapped already; and the other way round.
  all.push_back(ignored("N08a", "SentenceOfTheHourBefore", "", "sentences used"));
  all.back().make =
      file("N.pcap", [] { return drive_with(rmc("225959", "141123"), kFullHourNs + 1'000'000, 0); });
  all.back().same_as = file("clean.pcap", [] {
    return capture_of(packets_of({.begin_ns = kFullHourNs + 1'000'000, .packets = kPackets}));
  });
  all.push_back(ignored("N08b", "SentenceOfTheNextHour", "", "sentences used"));
  all.back().make =
      file("N.pcap", [] { return drive_with(rmc("230000", "141123"), kFullHourNs - 40'000'000, 0); });
  all.back().same_as = file("clean.pcap", [] {
    return capture_of(packets_of({.begin_ns = kFullHourNs - 40'000'000, .packets = kPackets}));
  });
  // Once decided the hour stays; that GPS says another one is told.
  all.push_back(ignored("N08c", "AnotherHourLater", "", "sentences used"));
  all.back().make = file("N.pcap", [] { return drive_with(rmc("231320", "141123"), kBeginNs, 30); });
  all.back().warns = "1 GPS sentences say another hour than the one in use";
}

}  // namespace

std::vector<BadInput> bad_inputs_position() {
  std::vector<BadInput> all;
  add_sentences(all);
  add_hours(all);
  return all;
}

}  // namespace verge::faults
