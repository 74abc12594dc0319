// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0

// Section P: captures, pcap and pcapng.
#include <utility>

#include "tests/faults/bad_inputs.hpp"
#include "tests/faults/capture_samples.hpp"
#include "verge/io/file/pcap.hpp"

namespace verge::faults {
namespace {

using testing::capture_of;
using testing::CapturePlan;
using testing::frame_of;
using testing::ipv4;
using testing::ipv6;
using testing::ng_block;
using testing::ng_interface;
using testing::ng_packet;
using testing::ng_section;
using testing::pcap_header;
using testing::pcap_record;
using testing::SensorPacket;
using testing::u16;
using testing::u32;
using testing::udp;
using testing::UdpPlan;

std::string clean() { return capture_of(packets()); }

/// The clean capture with `bytes` in the place of what stands at `at`.
std::string with_bytes(std::size_t at, const std::string& bytes) {
  return clean().replace(at, bytes.size(), bytes);
}

/// The clean capture with a record more before record `number`.
std::string with_record(std::size_t number, const std::string& record) {
  return clean().insert(record_at(number), record);
}

std::string two_digits(std::size_t number) { return (number < 10 ? "0" : "") + std::to_string(number); }

/// All the points are used, and nothing is wrong.
BadInput good(std::string code, std::string title, std::function<std::string()> capture) {
  return {.code = std::move(code),
          .title = std::move(title),
          .make = file("P.pcap", std::move(capture)),
          .exit = kGood,
          .used = kAllPoints,
          .scans = 1};
}

/// The points of `records` records are used; then comes the damage.
BadInput damaged(std::string code, std::string title, std::function<std::string()> capture, std::string says,
                 std::size_t where, std::size_t records) {
  return {.code = std::move(code),
          .title = std::move(title),
          .make = file("P.pcap", std::move(capture)),
          .exit = kDamaged,
          .says = std::move(says),
          .where = std::to_string(where),
          .used = records * kPacketPoints,
          .scans = 1};
}

BadInput unusable(std::string code, std::string title, std::function<std::string()> capture, std::string says,
                  std::string where = "0") {
  return {.code = std::move(code),
          .title = std::move(title),
          .make = file("P.pcap", std::move(capture)),
          .exit = kUnusable,
          .says = std::move(says),
          .where = std::move(where)};
}

void add_file_headers(std::vector<BadInput>& all) {
  all.push_back(unusable(
      "P01a", "WrongMagic", [] { return with_bytes(0, "xxxx"); }, "not a capture"));
  all.push_back(unusable(
      "P01b", "WrongMagicWhenPcapIsForced", [] { return with_bytes(0, "xxxx"); }, "not a capture"));
  all.back().format = "pcap";
  all.push_back(good("P02", "SwappedMagic", [] { return capture_of(packets(), {.big_endian = true}); }));
  all.push_back(good("P03a", "NanosecondMagic", [] { return capture_of(packets(), {.nanoseconds = true}); }));
  all.push_back(good("P03b", "SwappedNanosecondMagic",
                     [] { return capture_of(packets(), {.big_endian = true, .nanoseconds = true}); }));
  for (std::size_t size = 4; size < kCaptureHeader; ++size) {
    all.push_back(unusable(
        "P04c" + two_digits(size), "FileHeaderCut", [size] { return pcap_header().substr(0, size); },
        "file header is cut"));
  }
}

void add_cut_records(std::vector<BadInput>& all) {
  constexpr std::size_t kLast = record_at(kPackets - 1);
  for (std::size_t left = 1; left < kRecordHeader; ++left) {
    all.push_back(damaged(
        "P05c" + two_digits(left), "RecordHeaderCut", [left] { return clean().substr(0, kLast + left); },
        "record header is cut", kLast, kPackets - 1));
  }
  char variant = 'a';
  for (const std::size_t left : {kRecordHeader, kRecordHeader + 1, kRecordHeader + kHeaders, kRecord - 1}) {
    all.push_back(damaged(
        std::string("P06") + variant++, "RecordBodyCut", [left] { return clean().substr(0, kLast + left); },
        "record is cut", kLast + 8, kPackets - 1));
  }
  for (const auto& [letter, record] : {std::pair{'a', 30U}, {'b', 59U}}) {
    all.push_back(damaged(
        std::string("P07") + letter, "LengthOfAllOnes",
        [at = record_at(record) + 8] { return with_bytes(at, std::string(4, '\xFF')); }, "4294967295",
        record_at(record) + 8, record));
  }
  all.push_back(damaged(
      "P07c", "LengthJustBeyondTheLimit", [] { return with_bytes(record_at(30) + 8, u32(262'145, false)); },
      "need <= 262144", record_at(30) + 8, 30));
  all.push_back(unusable(
      "P07d", "LengthOfAllOnesAtFirst", [] { return with_bytes(kCaptureHeader + 8, std::string(4, '\xFF')); },
      "no data packet"));
  for (const auto& [letter, record] : {std::pair{'a', 0U}, {'b', 30U}, {'c', 60U}}) {
    all.push_back(good(std::string("P08") + letter, "EmptyRecord",
                       [number = record] { return with_record(number, pcap_record("", 1)); }));
    all.back().counted = {{"records that are not UDP", 1}, {"records received", kPackets + 1}};
  }
}

void add_cut_frames(std::vector<BadInput>& all) {
  const auto cut_from = [](std::size_t first, std::size_t end) {
    std::string capture = pcap_header();
    const Packets sent = packets();
    for (std::size_t i = 0; i < sent.size(); ++i) {
      const std::string frame = frame_of(ipv4(udp(sent[i].payload)));
      const bool cut = i >= first && i < end;
      capture += pcap_record(cut ? frame.substr(0, 96) : frame, sent[i].time_ns, {},
                             static_cast<std::uint32_t>(frame.size()));
    }
    return capture;
  };
  all.push_back(unusable(
      "P09a", "CapturedWith96BytesAFrame", [cut_from] { return cut_from(0, kPackets); },
      "the capture was cut to 96 bytes"));
  all.push_back(good("P09b", "OneFrameCut", [cut_from] { return cut_from(30, 31); }));
  all.back().used = kAllPoints - kPacketPoints;
  all.back().counted = {{"records cut", 1}};
  all.back().warns = "1 records are cut short";
}

void add_links(std::vector<BadInput>& all) {
  const std::vector<std::pair<std::string, std::uint32_t>> links{
      {"Ethernet", 1}, {"LinuxCooked", 113}, {"LinuxCooked2", 276}, {"RawIp", 101},
      {"Null", 0},     {"Loop", 108},        {"RawIpv4", 228}};
  char variant = 'a';
  for (const auto& [title, link] : links) {
    all.push_back(good(std::string("P10") + variant++, title,
                       [number = link] { return capture_of(packets(), {.link_type = number}); }));
  }
  for (const auto& [title, tags] : {std::pair{"Vlan", 1}, {"QinQ", 2}}) {
    all.push_back(good(std::string("P10") + variant++, title, [number = tags] {
      return capture_with(packets(),
                          [number](const std::string& p) { return frame_of(ipv4(udp(p)), 1, number); });
    }));
  }
  all.push_back(unusable(
      "P10z", "UnknownLink147", [] { return capture_of(packets(), {.link_type = 147}); }, "link type 147",
      "20"));
}

void add_ip(std::vector<BadInput>& all) {
  all.push_back(good("P11a", "Ipv4Options",
                     [] { return capture_of(packets(), {}, {.options = std::string(40, '\x01')}); }));
  all.push_back(good("P11b", "Ipv6", [] {
    return capture_with(packets(), [](const std::string& p) { return frame_of(ipv6(udp(p))); });
  }));
  all.push_back(good("P11c", "Ipv6WithAnExtensionHeader", [] {
    const std::string hop = std::string("\x11\x00", 2) + std::string(6, '\0');
    return capture_with(packets(), [hop](const std::string& p) { return frame_of(ipv6(hop + udp(p), 0)); });
  }));
}

/// The clean capture with packet 30 in three fragments, given in that order.
std::string fragmented(const std::vector<std::size_t>& order) {
  const SensorPacket packet = packets()[30];
  const std::string datagram = udp(packet.payload);
  const std::string parts[] = {ipv4(datagram.substr(0, 480), {}, 0x2000),
                               ipv4(datagram.substr(480, 480), {}, 0x2000 | 60),
                               ipv4(datagram.substr(960), {}, 120)};
  std::string records;
  for (const std::size_t part : order) records += pcap_record(frame_of(parts[part]), packet.time_ns);
  return clean().replace(record_at(30), kRecord, records);
}

void add_fragments(std::vector<BadInput>& all) {
  const std::vector<std::pair<std::string, std::vector<std::size_t>>> orders{
      {"InOrder", {0, 1, 2}}, {"Reversed", {2, 1, 0}}, {"Mixed", {1, 2, 0}}, {"OneTwice", {0, 0, 1, 2}}};
  char variant = 'a';
  for (const auto& [title, order] : orders) {
    all.push_back(good(std::string("P12") + variant++, "Fragments" + title,
                       [which = order] { return fragmented(which); }));
    all.back().counted = {{"records that are fragments", order.size() - 1}};
  }
  const std::vector<std::vector<std::size_t>> missing{{1, 2}, {0, 2}, {0, 1}};
  for (const auto& order : missing) {
    const std::string capture = fragmented(order);
    all.push_back(damaged(
        std::string("P12") + variant++, "FragmentMissing", [capture] { return capture; },
        "fragments of datagrams are missing", capture.size(), kPackets - 1));
  }
}

void add_udp(std::vector<BadInput>& all) {
  all.push_back(good("P13a", "UdpLongerThanIp",
                     [] { return with_record(30, record_of(packets()[30], {.length_off = 100})); }));
  all.back().counted = {{"records malformed", 1}};
  all.push_back(good("P13b", "UdpShorterThanIp", [] {
    const SensorPacket packet = packets()[30];
    return clean().replace(record_at(30), kRecord,
                           pcap_record(frame_of(ipv4(udp(packet.payload) + "tail")), packet.time_ns));
  }));
  all.back().warns = "1 datagrams are shorter than their IP packets say";
  all.push_back(good("P13c", "UdpShorterThanItsHeader",
                     [] { return with_record(30, record_of(packets()[30], {.length_off = -1208})); }));
  all.back().counted = {{"records malformed", 1}};
  all.push_back(
      good("P14a", "ChecksumWrong", [] { return capture_of(packets(), {}, {.checksum = 0xBEEF}); }));
  all.back().warns = "60 datagrams have a wrong checksum";
  all.push_back(good("P14b", "ChecksumOfZeroIsNone", &clean));
  all.push_back(good("P14c", "ChecksumRight", [] {
    std::string capture = io::PcapWriter::file_header();
    for (const SensorPacket& p : packets()) {
      capture +=
          io::PcapWriter::record(std::as_bytes(std::span(p.payload.data(), p.payload.size())), p.time_ns, {});
    }
    return capture;
  }));
}

void add_times(std::vector<BadInput>& all) {
  constexpr std::int64_t kHourNs = 3'600'000'000'000;
  const auto back = [](std::size_t first, std::size_t end) {
    Packets sent = packets();
    for (std::size_t i = first; i < end; ++i) sent[i].time_ns -= kHourNs;
    return capture_of(sent);
  };
  for (const auto& [letter, end] : {std::pair{'a', std::size_t{31}}, {'b', kPackets}}) {
    all.push_back(good(std::string("P15") + letter, letter == 'a' ? "OneAnHourBack" : "FromThereAnHourBack",
                       [back, last = end] { return back(30, last); }));
    all.back().warns = "1 records are older than those before them";
    all.back().same_as = file("clean.pcap", &clean);
  }
  all.push_back(good("P16", "FractionOf4000Seconds",
                     [] { return with_bytes(record_at(10) + 4, u32(4'000'000'000U, false)); }));
  // The seconds are believed, so that the record also seems newer than the next one: one line names both.
  all.back().warns = "1 records have a fraction of a second that is more than a second; 1 records are older";
  all.back().same_as = file("clean.pcap", &clean);
}

std::string two_sensors() {
  std::string capture = pcap_header();
  for (const SensorPacket& packet : packets()) {
    for (const std::uint32_t source : {0xC0A801C9U, 0xC0A801CAU})
      capture += record_of(packet, {.source = source});
  }
  return capture;
}

void add_senders(std::vector<BadInput>& all) {
  const auto two = file("P17.pcap", &two_sensors);
  all.push_back(
      {"P17a", "TwoSensors", two, kUsage, "choose --sensor-ip (got 192.168.1.201, 192.168.1.202", "0"});
  all.push_back({"P17b", "TwoSensorsAndNoSuchChoice", two, kUsage,
                 "no sensor 10.0.0.1 sends (got 192.168.1.201, 192.168.1.202", "0"});
  all.back().sensor_ip = "10.0.0.1";
  all.push_back(good("P17c", "TwoSensorsAndAChoice", &two_sensors));
  all.back().sensor_ip = "192.168.1.202";
  all.back().counted = {{"records from another sensor", kPackets}};
  all.push_back(unusable(
      "P18a", "DataOnAnotherPort", [] { return capture_of(packets(), {}, {.port = 2369}); },
      "no data packet on port 2368; saw 2369: 60"));
  all.push_back(unusable(
      "P18b", "DataOnTwoOtherPorts",
      [] { return capture_of(packets(), {}, {.port = 2369}) + record_of(packets()[0], {.port = 7502}); },
      "no data packet on port 2368; saw 2369: 60, 7502: 1"));
  all.push_back(unusable(
      "P21", "PositionPacketsAlone",
      [] {
        std::string capture = pcap_header();
        for (int i = 0; i < 5; ++i) capture += record_of({std::string(512, '\0'), i}, {.port = 8308});
        return capture;
      },
      "no data packet on port 2368; saw 8308: 5"));
}

constexpr std::size_t kNgPacket = 32 + kRecord - kRecordHeader;  ///< A block that holds a frame.

std::string ng_head() { return ng_section() + ng_interface(); }

/// Blocks of the packets [first, end).
std::string ng_packets(std::size_t first = 0, std::size_t end = kPackets, bool big = false) {
  std::string blocks;
  const Packets sent = packets();
  for (std::size_t i = first; i < end; ++i)
    blocks += ng_packet(frame_of(ipv4(udp(sent[i].payload))), sent[i].time_ns, big);
  return blocks;
}

void add_blocks(std::vector<BadInput>& all) {
  const std::size_t end = ng_head().size() + kPackets * kNgPacket;
  all.push_back(good("P19a", "Pcapng", [] { return ng_head() + ng_packets(); }));
  char variant = 'b';
  for (const std::uint32_t length : {0U, 4U, 8U, 13U, 0x7FFFFFFCU, 0xFFFFFFFCU}) {
    all.push_back(damaged(
        std::string("P19") + variant++, "BlockLength" + std::to_string(length),
        [length] {
          return ng_head() + ng_packets() + u32(6, false) + u32(length, false) + std::string(40, '\0');
        },
        "block length is not possible", end + 4, kPackets));
    all.push_back(unusable(
        std::string("P19") + variant++, "BlockLengthAtFirst" + std::to_string(length),
        [length] {
          return ng_head() + u32(6, false) + u32(length, false) + std::string(40, '\0') + ng_packets();
        },
        "block length is not possible", std::to_string(ng_head().size() + 4)));
  }
  all.push_back(damaged(
      "P19p", "TwoLengthsOfABlockDiffer",
      [] {
        std::string capture = ng_head() + ng_packets() + ng_packets(0, 1);
        capture[capture.size() - 4] ^= 4;
        return capture;
      },
      "two lengths differ", end + kNgPacket - 4, kPackets));
  all.push_back(damaged(
      "P19q", "BlockHeaderCut", [] { return ng_head() + ng_packets() + "1234567"; }, "block header is cut",
      end, kPackets));
}

/// An interface whose options are these.
std::string with_option(const std::string& option) {
  return ng_section() + ng_interface(option) + ng_packets();
}

void add_sections(std::vector<BadInput>& all) {
  all.push_back(good("P19r", "SecondSection",
                     [] { return ng_head() + ng_packets(0, 30) + ng_head() + ng_packets(30); }));
  all.push_back(good("P19s", "BigEndianSection", [] {
    return ng_section(true) + ng_interface({}, true) + ng_packets(0, kPackets, true);
  }));
  all.push_back(unusable(
      "P19t", "SectionInsideASection",
      [] {
        return ng_block(0x0A0D0D0A, u32(0x1A2B3C4D, false) + u16(1, false) + u16(0, false) +
                                        std::string(8, '\xFF') + ng_section()) +
               ng_packets();
      },
      "", ""));
  all.push_back(unusable(
      "P19u", "NoInterfaceBlock", [] { return ng_section() + ng_packets(); }, "", ""));
  all.push_back(unusable(
      "P19v", "OptionPastItsBlock", [] { return with_option(u16(9, false) + u16(60'000, false)); }, "", ""));
  all.push_back(unusable(
      "P19w", "ResolutionOf10ToTheMinus127",
      [] { return with_option(u16(9, false) + u16(1, false) + std::string("\x7F\0\0\0", 4)); }, "", ""));
  all.push_back(unusable(
      "P19x", "ResolutionOf2ToTheMinus127",
      [] { return with_option(u16(9, false) + u16(1, false) + std::string("\xFF\0\0\0", 4)); }, "", ""));
  const std::size_t end = ng_head().size() + kPackets * kNgPacket;
  const auto too_long = [](std::uint32_t length) {
    return ng_block(6,
                    std::string(12, '\0') + u32(length, false) + u32(length, false) + std::string(40, '\0'));
  };
  all.push_back(damaged(
      "P20a", "CapturedLengthBeyondItsBlock",
      [too_long] { return ng_head() + ng_packets() + too_long(5000); }, "captured length exceeds its block",
      end + 20, kPackets));
  all.push_back(damaged(
      "P20b", "CapturedLengthOfAllOnes",
      [too_long] { return ng_head() + ng_packets() + too_long(0xFFFFFFFF); },
      "captured length exceeds its block", end + 20, kPackets));
  all.push_back(damaged(
      "P20c", "PacketBlockWithoutItsHeader",
      [] { return ng_head() + ng_packets() + ng_block(6, "12345678"); }, "captured length exceeds its block",
      end + 20, kPackets));
}

}  // namespace

std::vector<BadInput> bad_inputs_pcap() {
  std::vector<BadInput> all;
  add_file_headers(all);
  add_cut_records(all);
  add_cut_frames(all);
  add_links(all);
  add_ip(all);
  add_fragments(all);
  add_udp(all);
  add_times(all);
  add_senders(all);
  add_blocks(all);
  add_sections(all);
  return all;
}

}  // namespace verge::faults
