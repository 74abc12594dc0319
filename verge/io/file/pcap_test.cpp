// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/io/file/pcap.hpp"

#include <algorithm>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "verge/io/file/test_captures.hpp"
#include "verge/io/test_files.hpp"
#include "verge/sensor/velodyne/encoder.hpp"

namespace verge::io {
namespace {

using testing::bytes_of;
using testing::capture_of;
using testing::CapturePlan;
using testing::frame_of;
using ::testing::HasSubstr;
using testing::ipv4;
using testing::ipv6;
using testing::pcap_header;
using testing::pcap_record;
using testing::sensor_packets;
using testing::SensorPacket;
using testing::udp;
using testing::UdpPlan;

/// What a recording gives.
struct Outcome {
  std::vector<Decoded> scans;
  std::vector<Error> errors;
  std::vector<std::string> warnings;
  std::map<std::string, std::uint64_t> counts;
  [[nodiscard]] std::size_t points() const {
    std::size_t sum = 0;
    for (const Decoded& scan : scans) sum += scan.cloud.x.size();
    return sum;
  }
};

void expect_sums(const std::vector<Counter>& counters) {
  const auto sum = [&](std::string_view first, std::string_view last) {
    const auto is = [](std::string_view name) { return [name](const Counter& c) { return c.name == name; }; };
    const auto head = std::find_if(counters.begin(), counters.end(), is(first));
    const auto end = std::find_if(head, counters.end(), is(last)) + 1;
    std::uint64_t parts = 0;
    for (auto part = head + 1; part != end; ++part) parts += part->count;
    EXPECT_EQ(head->count, parts) << first;
  };
  sum("records received", "records malformed");
  sum("packets received", "packets too late");
  sum("blocks received", "blocks out of turn");
  sum("measurements received", "measurements of the same echo");
}

Outcome run(const std::string& capture, RecordingOptions options = {}) {
  Outcome out;
  options.log = [&out](LogLevel level, std::string_view text) {
    if (level == LogLevel::kWarning) out.warnings.emplace_back(text);
  };
  auto recording = open_pcap(Input::of(bytes_of(capture), "drive.pcap"), options);
  if (!recording) {
    out.errors.push_back(recording.error());
    return out;
  }
  while (true) {
    auto next = (*recording)->next();
    if (!next) {
      out.errors.push_back(next.error());
      if (out.errors.size() > 10) break;
      continue;
    }
    if (!*next) break;
    out.scans.push_back(std::move(**next));
  }
  for (const Counter& counter : (*recording)->counters()) out.counts[counter.name] = counter.count;
  expect_sums((*recording)->counters());
  return out;
}

constexpr std::size_t kPackets = 60;
constexpr std::size_t kPoints = kPackets * 384;

void expect_all(const Outcome& outcome, const std::string& what) {
  EXPECT_TRUE(outcome.errors.empty())
      << what << ": " << (outcome.errors.empty() ? "" : to_string(outcome.errors[0]));
  EXPECT_EQ(outcome.points(), kPoints) << what;
}

void expect_error(const Outcome& outcome, ErrorCode code, const std::string& says) {
  ASSERT_EQ(outcome.errors.size(), 1U) << says;
  EXPECT_EQ(outcome.errors[0].code, code) << to_string(outcome.errors[0]);
  EXPECT_THAT(to_string(outcome.errors[0]), HasSubstr(says));
}

TEST(Pcap, ARecordingGivesItsRevolutions) {
  const Outcome outcome = run(capture_of(sensor_packets(400)));
  EXPECT_TRUE(outcome.errors.empty());
  ASSERT_EQ(outcome.scans.size(), 3U);
  EXPECT_EQ(outcome.scans[0].stamp_ns, 1'700'000'000'000'000'000);
  EXPECT_TRUE(outcome.scans[0].notes.empty());
  ASSERT_EQ(outcome.scans[2].notes.size(), 1U);
  EXPECT_THAT(outcome.scans[2].notes[0], HasSubstr("21 % complete"));
  EXPECT_EQ(outcome.counts.at("records received"), 400U);
}

TEST(Pcap, P1WrongMagic) {
  expect_error(run(std::string(100, 'x')), ErrorCode::kUnusable, "not a capture");
  expect_error(run(""), ErrorCode::kUnusable, "too short");
  expect_error(run("abc"), ErrorCode::kUnusable, "too short");
}

TEST(Pcap, P2P3SwappedAndNanosecondMagics) {
  for (const bool big : {false, true}) {
    for (const bool nano : {false, true}) {
      const Outcome outcome =
          run(capture_of(sensor_packets(kPackets), {.big_endian = big, .nanoseconds = nano}));
      expect_all(outcome, big ? "big" : "little");
      EXPECT_EQ(outcome.scans[0].stamp_ns, 1'700'000'000'000'000'000);
    }
  }
}

TEST(Pcap, P4FileHeaderCut) {
  for (std::size_t length = 4; length < 24; ++length) {
    expect_error(run(pcap_header().substr(0, length)), ErrorCode::kUnusable, "header is cut");
  }
}

TEST(Pcap, P5P6ARecordCutAnywhereCostsThatRecordAlone) {
  const std::string whole = capture_of(sensor_packets(kPackets));
  const std::size_t record = (whole.size() - 24) / kPackets;
  for (std::size_t left = 1; left < record; left += left < 20 ? 1 : 97) {
    const Outcome outcome = run(whole.substr(0, whole.size() - record + left));
    expect_error(outcome, ErrorCode::kDamaged, left < 16 ? "record header is cut" : "record is cut");
    EXPECT_EQ(outcome.points(), kPoints - 384);
    EXPECT_EQ(outcome.counts.at("records malformed"), 1U);
    const std::size_t at = whole.size() - record + (left < 16 ? 0 : 8);
    EXPECT_EQ(outcome.errors[0].where, std::to_string(at));
  }
}

TEST(Pcap, P7ALengthBeyondTheLimitStopsThere) {
  std::string capture = capture_of(sensor_packets(kPackets));
  capture += std::string(8, '\0') + std::string(8, '\xFF') + std::string(1000, 'x');
  const Outcome outcome = run(capture);
  expect_error(outcome, ErrorCode::kDamaged, "4294967295");
  EXPECT_EQ(outcome.points(), kPoints);
}

TEST(Pcap, P8AnEmptyRecordIsCounted) {
  const Outcome outcome = run(capture_of(sensor_packets(kPackets)) + pcap_record("", 0));
  expect_all(outcome, "empty record");
  EXPECT_EQ(outcome.counts.at("records that are not UDP"), 1U);
}

TEST(Pcap, P9ACaptureThatCutEachFrame) {
  std::string capture = pcap_header();
  for (const SensorPacket& packet : sensor_packets(kPackets)) {
    const std::string frame = frame_of(ipv4(udp(packet.payload)));
    capture += pcap_record(frame.substr(0, 96), packet.time_ns, {}, static_cast<std::uint32_t>(frame.size()));
  }
  expect_error(run(capture), ErrorCode::kUnusable, "cut to 96 bytes");
}

TEST(Pcap, P10LinkTypes) {
  for (const std::uint32_t link : {1U, 113U, 276U, 101U, 0U, 228U}) {
    expect_all(run(capture_of(sensor_packets(kPackets), {.link_type = link})), std::to_string(link));
  }
  expect_error(run(capture_of(sensor_packets(kPackets), {.link_type = 147})), ErrorCode::kUnusable, "147");
  for (const int tags : {1, 2}) {
    std::string capture = pcap_header();
    for (const SensorPacket& packet : sensor_packets(kPackets)) {
      capture += pcap_record(frame_of(ipv4(udp(packet.payload)), 1, tags), packet.time_ns);
    }
    expect_all(run(capture), "VLAN");
  }
}

TEST(Pcap, P11Ipv4OptionsAndIpv6) {
  expect_all(run(capture_of(sensor_packets(kPackets), {}, {.options = std::string(40, '\x01')})), "options");
  std::string plain = pcap_header();
  std::string extended = pcap_header();
  for (const SensorPacket& packet : sensor_packets(kPackets)) {
    plain += pcap_record(frame_of(ipv6(udp(packet.payload))), packet.time_ns);
    const std::string hop = std::string("\x11\x00", 2) + std::string(6, '\0');
    extended += pcap_record(frame_of(ipv6(hop + udp(packet.payload), 0)), packet.time_ns);
  }
  expect_all(run(plain), "IPv6");
  expect_all(run(extended), "IPv6 with a hop-by-hop header");
}

/// The first packet in three fragments, given in that order (3 = none).
std::string fragmented(const std::vector<int>& order) {
  std::string capture = pcap_header();
  const auto packets = sensor_packets(kPackets);
  const std::string datagram = udp(packets[0].payload);
  const std::string parts[] = {ipv4(datagram.substr(0, 480), {}, 0x2000),
                               ipv4(datagram.substr(480, 480), {}, 0x2000 | 60),
                               ipv4(datagram.substr(960), {}, 120)};
  for (const int part : order) capture += pcap_record(frame_of(parts[part]), packets[0].time_ns);
  for (std::size_t i = 1; i < packets.size(); ++i) {
    capture += pcap_record(frame_of(ipv4(udp(packets[i].payload))), packets[i].time_ns);
  }
  return capture;
}

TEST(Pcap, P12FragmentsArePutTogetherInAnyOrder) {
  for (const std::vector<int>& order : {std::vector<int>{0, 1, 2}, {2, 1, 0}, {1, 0, 2}, {0, 0, 1, 2}}) {
    expect_all(run(fragmented(order)), "fragments");
  }
  const Outcome outcome = run(fragmented({0, 2}));
  expect_error(outcome, ErrorCode::kDamaged, "fragments of datagrams are missing");
  EXPECT_EQ(outcome.points(), kPoints - 384);
  EXPECT_EQ(outcome.counts.at("records that are fragments"), 2U);
}

TEST(Pcap, P12FragmentsOfManyDatagramsStayBounded) {
  std::string capture = capture_of(sensor_packets(kPackets));
  for (std::uint32_t source = 1; source <= 500; ++source) {
    const UdpPlan plan{.source = source};
    capture += pcap_record(frame_of(ipv4(std::string(8, 'x'), plan, 0x2000 | 8000)), 0);
  }
  const Outcome outcome = run(capture);
  expect_error(outcome, ErrorCode::kDamaged, "500 datagrams");
  EXPECT_EQ(outcome.points(), kPoints);
}

TEST(Pcap, P13P14LengthsAndChecksumsThatDiffer) {
  std::string capture = capture_of(sensor_packets(kPackets));
  const SensorPacket packet = sensor_packets(1)[0];
  capture += pcap_record(frame_of(ipv4(udp(packet.payload, {.length_off = 100}))), packet.time_ns);
  const Outcome outcome = run(capture);
  expect_all(outcome, "UDP longer than IP");
  EXPECT_EQ(outcome.counts.at("records malformed"), 1U);
  const Outcome checksums = run(capture_of(sensor_packets(kPackets), {}, {.checksum = 0xBEEF}));
  expect_all(checksums, "bad checksum");
  EXPECT_EQ(checksums.warnings,
            std::vector{fmt::format("drive.pcap: {} datagrams have a wrong checksum", kPackets)});
}

TEST(Pcap, P15P16OddTimesOfTheCaptureMoveNothing) {
  auto packets = sensor_packets(kPackets);
  packets[30].time_ns -= 3'600'000'000'000;
  const Outcome back = run(capture_of(packets));
  expect_all(back, "an hour back");
  EXPECT_EQ(back.warnings,
            std::vector<std::string>{"drive.pcap: 1 records are older than those before them"});
  std::string capture = capture_of(sensor_packets(kPackets));
  const std::size_t record = (capture.size() - 24) / kPackets;
  capture.replace(24 + 10 * record + 4, 4, testing::u32(4'000'000'000U, false));
  const Outcome odd = run(capture);
  expect_all(odd, "fraction of 4000 s");
  EXPECT_EQ(odd.warnings, std::vector<std::string>{
                              "drive.pcap: 1 records have a fraction of a second that is more than a second; "
                              "1 records are older than those before them"});
}

TEST(Pcap, P17TwoSensorsNeedAChoice) {
  const auto packets = sensor_packets(kPackets);
  std::string capture = pcap_header();
  for (const SensorPacket& packet : packets) {
    for (const std::uint32_t source : {0xC0A801C9U, 0xC0A801CAU}) {
      const UdpPlan plan{.source = source};
      capture += pcap_record(frame_of(ipv4(udp(packet.payload, plan), plan)), packet.time_ns);
    }
  }
  expect_error(run(capture), ErrorCode::kUsage, "choose --sensor-ip");
  expect_error(run(capture), ErrorCode::kUsage, "192.168.1.201, 192.168.1.202");
  RecordingOptions options;
  options.sensor_ip = "192.168.1.202";
  const Outcome chosen = run(capture, options);
  expect_all(chosen, "chosen");
  EXPECT_EQ(chosen.counts.at("records from another sensor"), kPackets);
  options.sensor_ip = "10.0.0.1";
  expect_error(run(capture, options), ErrorCode::kUsage, "no sensor 10.0.0.1 sends");
}

TEST(Pcap, P18DataOnAnotherPort) {
  expect_error(run(capture_of(sensor_packets(kPackets), {}, {.port = 2369})), ErrorCode::kUnusable,
               "no data packet on port 2368; saw 2369: 60");
}

TEST(Pcap, P19P20BlocksOfAPcapngThatAreNotSound) {
  const auto packets = sensor_packets(kPackets);
  std::string good = testing::ng_section() + testing::ng_interface();
  for (const SensorPacket& packet : packets)
    good += testing::ng_packet(frame_of(ipv4(udp(packet.payload))), packet.time_ns);
  expect_all(run(good), "pcapng");
  for (const std::uint32_t length : {0U, 4U, 8U, 13U, 0xFFFFFFFCU}) {
    const Outcome outcome =
        run(good + testing::u32(6, false) + testing::u32(length, false) + std::string(40, '\0'));
    expect_error(outcome, ErrorCode::kDamaged, "block length");
    EXPECT_EQ(outcome.points(), kPoints);
  }
  std::string uneven = good;
  uneven[uneven.size() - 4] ^= 4;
  expect_error(run(uneven), ErrorCode::kDamaged, "two lengths differ");
  const std::string too_long =
      testing::ng_block(6, std::string(12, '\0') + testing::u32(5000, false) + std::string(40, '\0'));
  expect_error(run(good + too_long), ErrorCode::kDamaged, "captured length exceeds its block");
}

TEST(Pcap, P19SectionsAndInterfaces) {
  const auto packets = sensor_packets(kPackets);
  std::string first;
  std::string second;
  for (std::size_t i = 0; i < packets.size(); ++i) {
    (i < 30 ? first : second) +=
        testing::ng_packet(frame_of(ipv4(udp(packets[i].payload))), packets[i].time_ns);
  }
  const std::string head = testing::ng_section() + testing::ng_interface();
  expect_all(run(head + first + head + second), "a second section");
  std::string big = testing::ng_section(true) + testing::ng_interface({}, true);
  for (const SensorPacket& packet : packets)
    big += testing::ng_packet(frame_of(ipv4(udp(packet.payload))), packet.time_ns, true);
  expect_all(run(big), "big-endian section");
  EXPECT_EQ(run(testing::ng_section() + first).errors.at(0).code, ErrorCode::kUnusable)
      << "no interface block";
  // if_tsresol of 10^-127 s; an option longer than its block.
  const std::string resolution =
      testing::u16(9, false) + testing::u16(1, false) + std::string("\x7F\0\0\0", 4);
  const std::string option = testing::u16(9, false) + testing::u16(60'000, false);
  for (const std::string& odd : {resolution, option}) {
    const Outcome outcome = run(testing::ng_section() + testing::ng_interface(odd) + first);
    EXPECT_FALSE(outcome.errors.empty() && outcome.points() == 0);
  }
}

TEST(Pcap, P21PositionPacketsAlone) {
  std::string capture = pcap_header();
  const UdpPlan plan{.port = 8308};
  for (int i = 0; i < 5; ++i)
    capture += pcap_record(frame_of(ipv4(udp(std::string(512, '\0'), plan), plan)), i);
  expect_error(run(capture), ErrorCode::kUnusable, "saw 8308: 5");
}

TEST(Pcap, AModelThatIsToldAndIsNotThere) {
  RecordingOptions options;
  options.model = "vlp16";
  expect_error(run(capture_of(sensor_packets(kPackets)), options), ErrorCode::kUnusable,
               "60 of 60 packets are of another model");
  options.model = "vlp17";
  expect_error(run(capture_of(sensor_packets(kPackets)), options), ErrorCode::kUsage,
               "no such Velodyne model");
}

TEST(Pcap, ACalibrationComesFromItsFile) {
  const testing::TemporaryFolder folder;
  std::string text = "lasers:\n";
  for (int i = 0; i < 32; ++i) {
    text += "- {laser_id: " + std::to_string(i) + ", vert_correction: " + std::to_string(0.01 * i) +
            ", dist_correction: 1.0}\n";
  }
  RecordingOptions options;
  options.calibration = folder.write("32.yaml", text);
  const Outcome outcome = run(capture_of(sensor_packets(kPackets)), options);
  expect_all(outcome, "calibrated");
  EXPECT_FLOAT_EQ(outcome.scans[0].cloud.z[0], 0.0F);
  EXPECT_FLOAT_EQ(outcome.scans[0].cloud.x[0], -11.0F);
  options.calibration = folder.path() / "none.yaml";
  expect_error(run(capture_of(sensor_packets(kPackets)), options), ErrorCode::kCannotOpen, "none.yaml");
}

TEST(Pcap, CutAnywhereItTellsOneErrorAfterTheScans) {
  const std::string whole = capture_of(sensor_packets(4));
  for (std::size_t length = 24; length < whole.size(); length += 13) {
    const Outcome outcome = run(whole.substr(0, length));
    ASSERT_LE(outcome.errors.size(), 1U) << length;
    const std::size_t record = (whole.size() - 24) / 4;
    ASSERT_EQ(outcome.points(), (length - 24) / record * 384) << length;
  }
}

TEST(PcapWriter, WhatIsWrittenIsReadAgain) {
  const testing::TemporaryFolder folder;
  const auto path = folder.path() / "out.pcap";
  const auto packets = sensor_packets(kPackets);
  std::string expected = PcapWriter::file_header();
  {
    auto writer = PcapWriter::create(*AtomicFile::create(path));
    ASSERT_TRUE(writer);
    for (const SensorPacket& packet : packets) {
      ASSERT_TRUE(writer->write(bytes_of(packet.payload), packet.time_ns));
      expected += PcapWriter::record(bytes_of(packet.payload), packet.time_ns, {});
    }
    ASSERT_TRUE(writer->commit());
  }
  auto input = Input::open(path, {});
  ASSERT_TRUE(input);
  const auto bytes = input->read(0, input->size());
  EXPECT_EQ(std::string(reinterpret_cast<const char*>(bytes->data()), bytes->size()), expected);
  const Outcome outcome = run(expected);
  expect_all(outcome, "written");
  EXPECT_EQ(outcome.counts.at("records from the sensor"), kPackets);
}

TEST(PcapWriter, ADecodedRecordingWritesTheSamePacketsAgain) {
  namespace velodyne = sensor::velodyne;
  const Outcome first = run(capture_of(sensor_packets(180)));
  ASSERT_EQ(first.scans.size(), 1U);
  velodyne::Encoder encoder(velodyne::Model::kHdl32e);
  const std::int64_t begin_ns = *first.scans[0].stamp_ns;
  encoder.add(first.scans[0].cloud, begin_ns,
              {.begin_ns = begin_ns, .begin_azimuth_rad = 3.14159265358979, .rate_hz = 10.0},
              begin_ns + 180LL * 552'960);
  const auto sent = encoder.take();
  const auto packets = sensor_packets(180);
  ASSERT_EQ(sent.size(), packets.size());
  for (std::size_t i = 0; i < sent.size(); ++i) {
    ASSERT_EQ(std::string(reinterpret_cast<const char*>(sent[i].bytes.data()), sent[i].bytes.size()),
              packets[i].payload)
        << i;
  }
}

TEST(PcapReal, PublicCapturesDecode) {
  const auto data = testing::data_folder();
  if (!data) GTEST_SKIP() << "VERGE_DATA is not set";
  for (const auto& [name, packets] : {std::pair{"atwallshort.pcap", 306U}, {"sampleShort.pcap", 291U}}) {
    auto input = Input::open(*data / "velodyne-packets" / name, {});
    ASSERT_TRUE(input);
    auto recording = open_pcap(*std::move(input), {});
    ASSERT_TRUE(recording) << to_string(recording.error());
    std::size_t errors = 0;
    std::size_t points = 0;
    while (true) {
      const auto next = (*recording)->next();
      if (!next) {
        ++errors;
        EXPECT_EQ(next.error().code, ErrorCode::kDamaged);
        continue;
      }
      if (!*next) break;
      points += (*next)->cloud.x.size();
    }
    EXPECT_EQ(errors, 1U) << "the last record is cut";
    EXPECT_GT(points, 80'000U);
    std::map<std::string, std::uint64_t> counts;
    for (const Counter& counter : (*recording)->counters()) counts[counter.name] = counter.count;
    EXPECT_EQ(counts.at("packets used"), packets);
    EXPECT_EQ(counts.at("records malformed"), 1U);
    EXPECT_EQ(counts.at("blocks out of turn"), 0U);
    expect_sums((*recording)->counters());
  }
}

}  // namespace
}  // namespace verge::io
